// The mean ratio of cells of each kind: one where they are ideal, less where not, negative inside out.
#include <gtest/gtest.h>

#include <cmath>

#include "mesh/box.hpp"
#include "mesh/cell_quality.hpp"

namespace dygita {
namespace {

TEST(CellQuality, of_an_equilateral_prism_is_one_and_its_mirror_image_is_inside_out) {
  const double height = std::sqrt(3.0) / 2.0;
  Points x(3, 6);
  x << 0, 0.5, 1, 0, 0.5, 1,       //
      0, height, 0, 0, height, 0,  //
      0, 0, 0, 1, 1, 1;
  // Nodes 1 and 2 of the reference cell lie along its second and first axis.
  EXPECT_NEAR(shape_of_cell(CellType::prism6, x), 1.0, 1e-12);
  x.row(2) *= -1.0;
  EXPECT_NEAR(shape_of_cell(CellType::prism6, x), -1.0, 1e-12);
}

TEST(CellQuality, of_the_cells_of_a_cube_is_that_of_their_kind) {
  const auto worst = [](CellType type) { return worst_shape(*box_mesh(Vec3::Zero(), Vec3::Ones(), {2, 2, 2}, type)); };
  EXPECT_NEAR(worst(CellType::hex8), 1.0, 1e-12);
  EXPECT_NEAR(worst(CellType::hex27), 1.0, 1e-12);
  for (const CellType type :
       {CellType::prism6, CellType::prism15, CellType::prism18, CellType::tet4, CellType::tet10}) {
    EXPECT_GT(worst(type), 0.6);
    EXPECT_LT(worst(type), 1.0);
  }
}

}  // namespace
}  // namespace dygita
