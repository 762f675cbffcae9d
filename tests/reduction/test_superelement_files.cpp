// Matrices and page of a superelement.
#include <gtest/gtest.h>

#include "reduction/superelement_files.hpp"

namespace dygita::superelement_files_tests {
namespace {

TEST(MatrixMarket, has_the_lower_triangle_by_columns) {
  Mat m(2, 2);
  m << 1, 0.1, 0.1, -0.0;
  EXPECT_EQ(matrix_market_text(m, "of a test"),
            "%%MatrixMarket matrix array real symmetric\n% of a test\n2 2\n1\n0.10000000000000001\n0\n");
}

TEST(SuperelementFiles, are_matrices_and_a_page_that_names_their_rows) {
  auto mesh = std::make_shared<Mesh>();
  auto part = std::make_shared<Substructure>();
  part->name = "flange";
  part->mesh = mesh;
  mesh->nodes = Points::Zero(3, 3);
  mesh->nodes(0, 1) = mesh->nodes(1, 2) = 1.0;
  mesh->faces["top"] = {Facet(FacetType::tri3, {0, 1, 2})};
  const SuperelementRequest request{"element", {}, {}};
  Superelement element;
  element.on = {Face{part, "top"}};
  element.rows = {{0, -1, 5, Vec3(1, 2, 1e-19)}, {-1, -1, 0, Vec3::Zero()}};
  element.mass = element.stiffness = Mat::Identity(2, 2);
  element.fixed_frequencies = Vec::Constant(1, 1234.5);
  element.frequencies = element.damping_ratios = Vec::Constant(2, 0.5);
  element.valid_to = 600.0;
  element.step = "tighten";
  const auto files = superelement_files("p", request, element);
  ASSERT_EQ(files.size(), 4u);
  EXPECT_EQ(files[0].first, "_mass.mtx");
  EXPECT_EQ(files[1].first, "_stiffness.mtx");
  EXPECT_EQ(files[2].first, ".json");
  EXPECT_EQ(files[3].first, ".md");
  const std::string& page = files[3].second;
  EXPECT_NE(page.find("| 1 | flange.top | all | rz | 1 | 2 | 0 |\n"), std::string::npos) << page;
  EXPECT_NE(page.find("| 2 | 1234.5 |\n"), std::string::npos) << page;
  EXPECT_NE(page.find("**To be used up to 600 Hz**"), std::string::npos) << page;
  element.damping = Mat::Identity(2, 2);
  EXPECT_EQ(superelement_files("p", request, element)[2].first, "_damping.mtx");
}

}  // namespace
}  // namespace dygita::superelement_files_tests
