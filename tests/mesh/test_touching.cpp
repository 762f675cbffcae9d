// Facets of two bodies that touch, found without names.
#include <gtest/gtest.h>

#include <cmath>

#include "mesh/box.hpp"
#include "mesh/touching.hpp"

namespace dygita {
namespace {

// A tube of one layer of n bricks around z, 5 high, from inner to outer radius.
MeshPtr tube(double inner, double outer, int n, double turned = 0.0) {
  auto mesh = std::make_shared<Mesh>();
  mesh->nodes.resize(3, 4 * n);
  CellBlock block{CellType::hex8, {}};
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * M_PI * (i + turned) / n;
    for (int k = 0; k < 4; ++k) {
      const double r = k % 2 == 0 ? inner : outer;
      mesh->nodes.col(4 * i + k) = Vec3(r * std::cos(angle), r * std::sin(angle), k < 2 ? 0.0 : 5.0);
    }
    const int j = (i + 1) % n;
    for (const int node : {4 * i, 4 * i + 1, 4 * j + 1, 4 * j, 4 * i + 2, 4 * i + 3, 4 * j + 3, 4 * j + 2})
      block.nodes.push_back(node);
  }
  mesh->blocks = {block};
  return mesh;
}

struct Blocks {
  MeshPtr mesh_1, mesh_2;
  Vec3 place;  // of the second

  Touching touching(std::optional<double> within = {}) const {
    return find_touching({*mesh_1, Vec3::Zero()}, {*mesh_2, place}, within);
  }
};

double facets_area(const Mesh& mesh, const std::vector<Facet>& facets) {
  double area = 0.0;
  for (const Facet& facet : facets) area += facet_area_vector(mesh.nodes, facet).norm();
  return area;
}

TEST(Touching, plane_faces_are_found_with_matching_and_other_meshes) {
  for (const CellType type : {CellType::hex8, CellType::tet4, CellType::tet10, CellType::hex20, CellType::hex27})
    for (const auto& cells : {std::array{4, 4, 2}, std::array{5, 3, 2}}) {
      const Blocks b{box_mesh(Vec3::Zero(), {8, 8, 2}, {8, 8, 2}, CellType::hex8),
                     box_mesh(Vec3::Zero(), {4, 4, 2}, cells, type),
                     {2, 2, 2}};
      const Touching t = b.touching();
      EXPECT_NEAR(t.area, 16.0, 1e-9) << cells[0];
      EXPECT_EQ(t.n_surfaces, 1);
      EXPECT_NEAR(facets_area(*b.mesh_2, t.facets_2), 16.0, 1e-9) << "the lower side, nothing else";
      EXPECT_NEAR(facets_area(*b.mesh_1, t.facets_1), 16.0, 1e-9) << "facets beside it do not take part";
      EXPECT_LT(std::max(std::abs(t.least_gap), std::abs(t.most_gap)), 1e-9);
    }
}

TEST(Touching, faces_that_are_apart_are_found_within_what_is_said_only) {
  Blocks b{box_mesh(Vec3::Zero(), {8, 8, 2}, {8, 8, 2}), box_mesh(Vec3::Zero(), {4, 4, 2}, {3, 3, 2}), {2, 2, 2.02}};
  EXPECT_TRUE(b.touching().is_empty()) << "a hundredth of the facet is 0.01";
  const Touching t = b.touching(0.03);
  EXPECT_NEAR(t.area, 16.0, 1e-9);
  EXPECT_NEAR(t.least_gap, 0.02, 1e-12);
  EXPECT_NEAR(t.most_gap, 0.02, 1e-12);
  b.place[2] = 1.97;  // an interference
  EXPECT_TRUE(b.touching(0.02).is_empty());
  EXPECT_NEAR(b.touching(0.04).most_gap, -0.03, 1e-12);
}

// Whatever the numbers of facets and however they are turned: the round faces touch and nothing else does.
TEST(Touching, a_shaft_in_its_hole_is_found_and_one_with_clearance_is_not) {
  for (const auto& [n_1, n_2] : {std::pair{12, 12}, std::pair{12, 48}, std::pair{40, 12}, std::pair{16, 24}})
    for (const double turned : {0.0, 0.3, 0.5}) {
      const double h = 10.0 * 2.0 * M_PI / std::max(n_1, n_2);
      const Blocks fit{tube(5, 10, n_1), tube(10, 20, n_2, turned), Vec3::Zero()};
      const Touching t = fit.touching();
      EXPECT_NEAR(t.area, 2 * M_PI * 10 * 5, 0.06 * 2 * M_PI * 10 * 5) << n_1 << ' ' << n_2 << ' ' << turned;
      EXPECT_EQ(t.n_surfaces, 1);
      EXPECT_EQ(t.facets_1.size(), static_cast<size_t>(n_1));
      EXPECT_EQ(t.facets_2.size(), static_cast<size_t>(n_2));
      // Clearance of M6 in 6.6, on this scale.
      const Blocks loose{tube(5, 10, n_1), tube(11, 20, n_2, turned), Vec3::Zero()};
      EXPECT_TRUE(loose.touching().is_empty()) << n_1 << ' ' << n_2 << ' ' << turned << ' ' << h;
      EXPECT_EQ(loose.touching(1.1).facets_1.size(), static_cast<size_t>(n_1));
    }
}

TEST(Touching, facets_that_are_taken_are_left_alone) {
  const Blocks b{box_mesh(Vec3::Zero(), {8, 8, 2}, {8, 8, 2}), box_mesh(Vec3::Zero(), {4, 4, 2}, {4, 4, 2}), {2, 2, 2}};
  const Touching all = b.touching();
  FacetKeys taken;
  for (size_t i = 0; i < 6; ++i) taken.insert(facet_key(all.facets_2[i]));
  const Touching rest = find_touching({*b.mesh_1, Vec3::Zero()}, {*b.mesh_2, b.place}, {}, {}, taken);
  EXPECT_NEAR(rest.area, 10.0, 1e-9);
  EXPECT_EQ(rest.facets_2.size(), 10u);
}

// A foot that covers less than a thousandth of the facet below it.
TEST(Touching, a_small_part_on_a_large_facet_is_found) {
  const Blocks b{box_mesh(Vec3::Zero(), {400, 400, 40}, {1, 1, 1}),
                 box_mesh(Vec3::Zero(), {10, 10, 10}, {2, 2, 2}),
                 {200, 200, 40}};
  const Touching t = b.touching();
  EXPECT_NEAR(t.area, 100.0, 1e-9);
  EXPECT_EQ(t.facets_1.size(), 1u);
  EXPECT_EQ(t.facets_2.size(), 4u);
  const Blocks beside{b.mesh_1, b.mesh_2, {400 - 1e-4, 0, 40}};  // a sliver: nothing, on either side
  EXPECT_TRUE(beside.touching().facets_1.empty());
  EXPECT_TRUE(beside.touching().facets_2.empty());
}

TEST(Touching, the_distance_of_bodies_is_told_with_its_place) {
  const MeshPtr mesh = box_mesh(Vec3::Zero(), {4, 4, 2}, {2, 2, 1});
  const Separation s = separation({*mesh, Vec3::Zero()}, {*mesh, Vec3(7, 3, 6)});  // corner to corner: 3 and 4
  EXPECT_NEAR(s.distance, 5.0, 1e-12);
  EXPECT_NEAR(s.place_1[0], 4.0, 1e-12);
  EXPECT_NEAR(s.place_2[0], 7.0, 1e-12);
  EXPECT_NEAR(separation({*mesh, Vec3::Zero()}, {*mesh, Vec3(1.3, 0.7, 3.5)}).distance, 1.5, 1e-12);
}

}  // namespace
}  // namespace dygita
