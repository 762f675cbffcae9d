#include <gtest/gtest.h>

#include "fem/cell_rotation.hpp"
#include "fem/meshes.hpp"

namespace dygita::test {
namespace {

// Of all cells, and of those alone whose nodes move far enough apart for the largest that is asked for.
TEST(CellDeformation, is_found_without_the_cells_that_cannot_reach_it) {
  std::vector<Mesh> meshes{distorted_mixed_box()};
  for (const CellType type : cell_types) meshes.push_back(box_of(type, Vec3(1.0, 0.3, 0.7), {3, 2, 4}));
  for (const Mesh& mesh : meshes) {
    const double length = gradient_length(mesh);
    ASSERT_GT(length, 0.0);
    Points displacement = 1e-4 * Points::Random(3, mesh.n_nodes());
    for (int i = 0; i < mesh.n_nodes(); i += 7) displacement.col(i) *= 10.0;  // some cells deform more than others
    const CellDeformation all = largest_deformation(mesh, displacement);
    const auto found = [&](double gradient) { return largest_deformation(mesh, displacement, gradient * length); };
    EXPECT_EQ(found(all.strain.value).strain.value, all.strain.value);
    EXPECT_EQ(found(all.strain.value).strain.place, all.strain.place);
    EXPECT_EQ(found(std::tan(all.rotation.value)).rotation.value, all.rotation.value);
    EXPECT_EQ(found(1e3).strain.value, 0.0);
  }
}

// A turn by a small angle: nodes of a cell differ by as much as its gradient times where they are.
TEST(CellDeformation, of_a_turn_is_the_turn) {
  const Mesh mesh = box_of(CellType::hex8, Vec3(1.0, 1.0, 1.0), {2, 2, 2});
  const double turn = 1e-3;
  Points displacement = Points::Zero(3, mesh.n_nodes());
  displacement.row(0) = -turn * mesh.nodes.row(1);
  displacement.row(1) = turn * mesh.nodes.row(0);
  const CellDeformation found = largest_deformation(mesh, displacement, turn * gradient_length(mesh));
  EXPECT_NEAR(found.rotation.value, turn, 1e-9);
  EXPECT_NEAR(found.strain.value, 0.0, 1e-12);
  // Cubes of edge a: eight gradients of sqrt(3)/(4 a).
  EXPECT_NEAR(gradient_length(mesh), 0.5 / (2.0 * std::sqrt(3.0)), 1e-12);
}

}  // namespace
}  // namespace dygita::test
