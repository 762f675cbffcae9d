#include <gtest/gtest.h>

#include "meeting/mortar.hpp"
#include "mesh/box.hpp"
#include "mesh/expect_input_error.hpp"

namespace dygita {
namespace {

PlacedFace face(const MeshPtr& mesh, const std::string& name, const std::string& body = "part",
                const Vec3& place = Vec3::Zero()) {
  return {mesh.get(), mesh->faces.at(name), place, body + "." + name};
}

void expect_nodes_coincide(const Facing& facing, const PlacedFace& side_1, const PlacedFace& side_2) {
  ASSERT_EQ(facing.side_1.n_points(), facing.side_2.n_points());
  for (int i = 0; i < facing.n_points(); ++i) {
    const Vec3 x_1 = side_1.mesh->nodes.col(facing.side_1.main_node(i)) + side_1.place;
    const Vec3 x_2 = side_2.mesh->nodes.col(facing.side_2.main_node(i)) + side_2.place;
    EXPECT_LT((x_1 - x_2).norm(), 1e-6) << i;
  }
}

TEST(Facing, of_two_equal_faces_joins_every_node_and_points_from_1_to_2) {
  const MeshPtr lower = box_mesh({0, 0, 0}, {2, 3, 1}, {4, 3, 2}), upper = box_mesh({0, 0, 1}, {2, 3, 5}, {4, 3, 7});
  const PlacedFace side_1 = face(lower, "zmax", "lower"), side_2 = face(upper, "zmin", "upper");
  const Facing facing = *match_faces(side_1, side_2);
  EXPECT_EQ(facing.facets_1.size(), 12u);
  EXPECT_EQ(static_cast<size_t>(facing.n_points()), 20u);
  EXPECT_NEAR(facing.areas.sum(), 6.0, 1e-14);
  for (int i = 0; i < facing.normals.cols(); ++i) EXPECT_TRUE(facing.normals.col(i).isApprox(Vec3::UnitZ()));
  expect_nodes_coincide(facing, side_1, side_2);

  const Facing reversed = *match_faces(side_2, side_1);
  EXPECT_TRUE(reversed.normals.col(0).isApprox(-Vec3::UnitZ()));
}

TEST(Facing, follows_the_places_of_the_bodies) {
  const MeshPtr box = box_mesh({0, 0, 0}, {1, 1, 1}, {3, 3, 3});
  const PlacedFace side_1 = face(box, "xmax", "left", {10, 0, 0}), side_2 = face(box, "xmin", "right", {11, 0, 0});
  const Facing facing = *match_faces(side_1, side_2);
  EXPECT_EQ(facing.facets_1.size(), 9u);
  EXPECT_TRUE(facing.normals.col(7).isApprox(Vec3::UnitX()));
  expect_nodes_coincide(facing, side_1, side_2);
}

TEST(Facing, of_faces_that_overlap_in_part_is_their_common_region) {
  const MeshPtr table = box_mesh({0, 0, 0}, {4, 4, 1}, {4, 4, 1}), punch = box_mesh({1, 1, 1}, {2, 5, 1}, {2, 5, 1});
  const Facing facing = *match_faces(face(table, "zmax"), face(punch, "zmin"));
  EXPECT_EQ(facing.facets_1.size(), 6u);  // x from 1 to 3, y from 1 to 4
  EXPECT_EQ(static_cast<size_t>(facing.n_points()), 12u);
  EXPECT_NEAR(facing.areas.sum(), 6.0, 1e-14);
  EXPECT_NEAR(facing.areas.minCoeff(), 0.25, 1e-15);
}

TEST(Facing, accepts_coordinates_that_differ_by_rounding_and_refuses_larger_differences) {
  const MeshPtr box = box_mesh({0, 0, 0}, {1, 1, 1}, {4, 4, 4});
  EXPECT_EQ(match_faces(face(box, "zmax"), face(box, "zmin", "other", {1e-9, -1e-9, 1 + 1e-9}))->facets_1.size(), 16u);
  EXPECT_FALSE(match_faces(face(box, "zmax"), face(box, "zmin", "other", {0, 0, 1 + 1e-5})));
}

TEST(Facing, finds_the_shared_corner_facet_of_faces_far_from_the_origin) {
  const MeshPtr box = box_mesh({0, 0, 0}, {1, 1, 1}, {4, 4, 4});
  const Vec3 far(-1000, 2000, -3000);
  const Facing facing = *match_faces(face(box, "zmax", "a", far), face(box, "zmin", "b", far + Vec3(0.75, 0.75, 1)));
  EXPECT_EQ(facing.facets_1.size(), 1u);
  EXPECT_NEAR(facing.areas.sum(), 1.0 / 16, 1e-14);
}

TEST(Facing, of_faces_with_other_divisions_is_none) {
  const MeshPtr lower = box_mesh({0, 0, 0}, {1, 1, 1}, {2, 2, 1}), upper = box_mesh({0, 0, 1}, {1, 1, 1}, {3, 3, 1});
  EXPECT_FALSE(match_faces(face(lower, "zmax", "lower"), face(upper, "zmin", "upper")));
}

TEST(Facing, that_matches_on_one_part_and_overlaps_without_matching_on_another_is_none) {
  // Same divisions along x; along y the second face is shifted by half a cell but for its first row.
  Mesh shifted = *box_mesh({0, 0, 1}, {1, 1, 1}, {2, 4, 1});
  for (int i = 0; i < shifted.n_nodes(); ++i)
    if (shifted.nodes(1, i) > 0.3 && shifted.nodes(1, i) < 0.9) shifted.nodes(1, i) += 0.125;
  const MeshPtr lower = box_mesh({0, 0, 0}, {1, 1, 1}, {2, 4, 1});
  const PlacedFace upper{&shifted, shifted.faces.at("zmin"), Vec3::Zero(), "upper.zmin"};
  EXPECT_FALSE(match_faces(face(lower, "zmax", "lower"), upper));
}

TEST(Facing, of_faces_half_a_cell_apart_in_their_plane_is_none) {
  const MeshPtr box = box_mesh({0, 0, 0}, {1, 1, 1}, {2, 2, 2});
  EXPECT_FALSE(match_faces(face(box, "zmax", "a"), face(box, "zmin", "b", {0.25, 0, 1})));
}

TEST(Facing, of_faces_that_share_only_an_edge_finds_no_facet) {
  const MeshPtr box = box_mesh({0, 0, 0}, {1, 1, 1}, {2, 2, 2});
  const PlacedFace one = face(box, "zmax", "a"), other = face(box, "zmin", "b", {1, 0, 1});
  EXPECT_FALSE(match_faces(one, other));
  expect_input_error([&] { Meeting(one, other, {}); }, {"do not meet", "0 m apart"});
}

TEST(Facing, of_faces_apart_is_refused_with_their_distance) {
  const MeshPtr box = box_mesh({0, 0, 0}, {1, 1, 1}, {2, 2, 2});
  const PlacedFace one = face(box, "zmax", "a"), other = face(box, "zmin", "b", {4, 5, 1});
  expect_input_error([&] { Meeting(one, other, {}); }, {"'a.zmax'", "'b.zmin'", "do not meet", "5 m apart"});
}

TEST(Facing, of_bodies_that_lie_in_one_another_is_refused) {
  const MeshPtr tall = box_mesh({0, 0, 0}, {1, 1, 2}, {2, 2, 2}), low = box_mesh({0, 0, 1}, {1, 1, 1}, {2, 2, 2});
  expect_input_error([&] { match_faces(face(tall, "zmax", "tall"), face(low, "zmax", "low")); },
                     {"'tall.zmax'", "'low.zmax'", "same side", "4 facets"});
}

// The lateral faces of a round bar and of the hole around it, with `n` facets on a turn.
Mesh ring(int n, double radius_in, double radius_out) {
  Mesh mesh;
  mesh.nodes.resize(3, 4 * n);
  CellBlock block{CellType::hex8, {}};
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::acos(-1.0) * i / n;
    for (int k = 0; k < 2; ++k) {
      mesh.nodes.col(4 * i + 2 * k) << radius_in * std::cos(angle), radius_in * std::sin(angle), k;
      mesh.nodes.col(4 * i + 2 * k + 1) << radius_out * std::cos(angle), radius_out * std::sin(angle), k;
    }
    const int j = (i + 1) % n;
    for (int k = 0; k < 2; ++k)
      for (const int node : {4 * i, 4 * i + 1, 4 * j + 1, 4 * j}) block.nodes.push_back(node + 2 * k);
  }
  mesh.blocks.push_back(block);
  for (const Facet& facet : boundary_facets(mesh.blocks)) {
    const double radius = mesh.nodes.col(facet.nodes()[0]).head<2>().norm();
    const double opposite = mesh.nodes.col(facet.nodes()[2]).head<2>().norm();
    if (std::abs(radius - opposite) < 1e-9)
      mesh.faces[radius > (radius_in + radius_out) / 2 ? "out" : "in"].push_back(facet);
  }
  check_mesh(mesh, "ring");
  return mesh;
}

TEST(Facing, of_a_bush_in_a_hole_follows_the_curved_face) {
  const Mesh bush = ring(24, 1, 2), hole = ring(24, 2, 3);
  const Facing facing = *match_faces({&bush, bush.faces.at("out"), Vec3::Zero(), "bush.out"},
                                     {&hole, hole.faces.at("in"), Vec3::Zero(), "hole.in"});
  EXPECT_EQ(facing.facets_1.size(), 24u);
  EXPECT_NEAR(facing.areas.sum(), 24 * 2 * 2 * std::sin(std::acos(-1.0) / 24), 1e-13);
  for (int i = 0; i < facing.n_points(); ++i) {
    const Vec3 x = bush.nodes.col(facing.side_1.main_node(i));
    EXPECT_NEAR(facing.normals.col(static_cast<long>(i)).dot(Vec3(x[0], x[1], 0).normalized()), 1, 1e-13);
  }
}

TEST(Facing, of_a_bush_in_a_hole_with_other_divisions_is_none) {
  const Mesh bush = ring(24, 1, 2), hole = ring(20, 2, 3);
  EXPECT_FALSE(match_faces({&bush, bush.faces.at("out"), Vec3::Zero(), "bush.out"},
                           {&hole, hole.faces.at("in"), Vec3::Zero(), "hole.in"}));
}

// Every facet against every other would not end within the limit that each test has.
TEST(Facing, of_faces_with_a_hundred_thousand_facets_ends) {
  const MeshPtr box = box_mesh({0, 0, 0}, {1, 1, 0.01}, {320, 320, 1});
  EXPECT_EQ(match_faces(face(box, "zmax", "a"), face(box, "zmin", "b", {0, 0, 0.01}))->facets_1.size(), 102400u);
}

}  // namespace
}  // namespace dygita
