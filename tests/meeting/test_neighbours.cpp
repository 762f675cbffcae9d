// Bodies near each other: touching, overlapping, apart.
#include <gtest/gtest.h>

#include <cmath>

#include "meeting/neighbours.hpp"
#include "mesh/box.hpp"

namespace dygita {
namespace {

PlacedBody block(const Vec3& size, const std::array<int, 3>& cells, const Vec3& place) {
  static std::vector<MeshPtr> kept;
  kept.push_back(box_mesh(Vec3::Zero(), size, cells));
  return {kept.back().get(), place};
}

// A tube or a rod of one layer of n wedges or bricks around z, from inner to outer radius.
MeshPtr ring(double inner, double outer, int n, double turned) {
  auto mesh = std::make_shared<Mesh>();
  mesh->nodes.resize(3, 4 * n);
  CellBlock block{CellType::hex8, {}};
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * std::acos(-1.0) * (i + turned) / n;
    for (int k = 0; k < 4; ++k) {
      const double r = k % 2 == 0 ? inner : outer;
      mesh->nodes.col(4 * i + k) = Vec3(r * std::cos(angle), r * std::sin(angle), k < 2 ? 0.0 : 1.0);
    }
    const int j = (i + 1) % n;
    for (const int node : {4 * i, 4 * i + 1, 4 * j + 1, 4 * j, 4 * i + 2, 4 * i + 3, 4 * j + 3, 4 * j + 2})
      block.nodes.push_back(node);
  }
  mesh->blocks = {block};
  return mesh;
}

TEST(Neighbours, that_touch_are_told_with_area_and_place) {
  const PlacedBody lower = block({4, 4, 1}, {4, 4, 1}, {0, 0, 0});
  for (const auto& cells : {std::array{2, 2, 1}, std::array{3, 5, 1}}) {  // with the same nodes, and without
    const Neighbours n = find_neighbours(lower, block({2, 2, 1}, cells, {1, 1, 1}), 0.1);
    ASSERT_TRUE(n.touch);
    EXPECT_NEAR(n.touch->area, 4.0, 1e-12);
    EXPECT_NEAR(n.touch->place[2], 1.0, 1e-12);
    EXPECT_FALSE(n.intrusion);
  }
  // Half a cell over the edge: it touches on a part of its face.
  const Neighbours over = find_neighbours(lower, block({2, 2, 1}, {2, 2, 1}, {3.5, 1, 1}), 0.1);
  ASSERT_TRUE(over.touch);
  EXPECT_NEAR(over.touch->area, 1.0, 1e-12);
}

TEST(Neighbours, side_by_side_or_apart_do_not_touch) {
  const PlacedBody one = block({2, 2, 2}, {2, 2, 2}, {0, 0, 0});
  EXPECT_FALSE(find_neighbours(one, block({2, 2, 2}, {2, 2, 2}, {2, 2, 0}), 0.1).touch) << "an edge";
  const Neighbours near = find_neighbours(one, block({2, 2, 2}, {2, 2, 2}, {0, 0, 2.05}), 0.1);
  EXPECT_FALSE(near.touch);
  EXPECT_FALSE(near.intrusion);
  EXPECT_TRUE(near.are_near());
  const Neighbours apart = find_neighbours(one, block({2, 2, 2}, {2, 2, 2}, {0, 0, 2.5}), 0.1);
  EXPECT_FALSE(apart.are_near());
}

// M8 in a hole of 9 mm, with so few facets around that their chords cross: the round faces are apart all the same.
TEST(Neighbours, a_shank_in_a_hole_with_clearance_does_not_touch) {
  for (const int n : {8, 12, 16})
    for (const double turned : {0.0, 0.25, 0.5}) {
      const MeshPtr shank = ring(2.0, 4.0, n, 0.0), hole = ring(4.5, 9.0, n, turned), fit = ring(4.0, 9.0, n, turned);
      const PlacedBody body{shank.get(), Vec3::Zero()};
      EXPECT_FALSE(find_neighbours(body, {hole.get(), Vec3::Zero()}, 0.1).touch) << n << ' ' << turned;
      EXPECT_TRUE(n < 12 || find_neighbours(body, {fit.get(), Vec3::Zero()}, 0.1).touch) << n << ' ' << turned;
    }
}

TEST(Neighbours, that_overlap_are_told_with_depth_and_extent) {
  const PlacedBody lower = block({20, 20, 20}, {1, 1, 1}, {0, 0, 0});
  const Neighbours aligned = find_neighbours(lower, block({20, 20, 20}, {1, 1, 1}, {0, 0, 16}), 1.0);
  ASSERT_TRUE(aligned.intrusion);
  EXPECT_NEAR(aligned.intrusion->depth, 4.0, 1e-9);
  EXPECT_NEAR(aligned.intrusion->extent.low[2], 16.0, 1e-9);
  EXPECT_NEAR(aligned.intrusion->extent.high[2], 20.0, 1e-9);

  const Neighbours whole = find_neighbours(lower, block({2, 2, 2}, {3, 3, 3}, {9, 9, 9}), 1.0);
  ASSERT_TRUE(whole.intrusion) << "a body within the other";
  EXPECT_NEAR(whole.intrusion->depth, 2.0, 1e-9) << "its own size: the surface is farther away";

  const Neighbours shallow =
      find_neighbours(block({20, 20, 20}, {4, 4, 4}, {0, 0, 0}), block({20, 20, 20}, {4, 4, 4}, {0, 0, 19.9}), 1.0);
  ASSERT_TRUE(shallow.intrusion) << "a fiftieth of a cell";
  EXPECT_NEAR(shallow.intrusion->depth, 0.1, 1e-9);
}

TEST(Neighbours, whose_chords_cross_on_a_curved_face_do_not_overlap) {
  const MeshPtr tube = ring(1.0, 2.0, 24, 0.0), rod = ring(0.2, 1.0, 16, 0.3);
  EXPECT_FALSE(find_neighbours({tube.get(), Vec3::Zero()}, {rod.get(), Vec3::Zero()}, 0.05).intrusion);
  // Nodes of the finer one are before the middles of the other's chords, where facets are parallel.
  for (const auto& [n_tube, n_rod] : {std::pair{8, 64}, {64, 8}, {12, 36}}) {
    const MeshPtr around = ring(1.0, 2.0, n_tube, 0.0), within = ring(0.2, 1.0, n_rod, 0.0);
    EXPECT_FALSE(find_neighbours({around.get(), Vec3::Zero()}, {within.get(), Vec3::Zero()}, 0.05).intrusion)
        << n_tube << " cells around " << n_rod;
  }
  const MeshPtr thick = ring(0.2, 1.3, 16, 0.3);
  const Neighbours pressed = find_neighbours({tube.get(), Vec3::Zero()}, {thick.get(), Vec3::Zero()}, 0.05);
  ASSERT_TRUE(pressed.intrusion);
  EXPECT_NEAR(pressed.intrusion->depth, 0.3, 0.05);
}

TEST(Neighbours, no_longer_ask_for_what_an_interface_joins) {
  PlacedBody lower = block({2, 2, 1}, {2, 2, 1}, {0, 0, 0}), upper = block({2, 2, 1}, {2, 2, 1}, {0, 0, 1});
  for (const auto& [body, face] : {std::pair{&lower, "zmax"}, {&upper, "zmin"}})
    for (const Facet& facet : body->mesh->faces.at(face)) {
      body->joined.insert(facet_key(facet));
      body->joined_nodes.insert(facet.nodes().begin(), facet.nodes().end());
    }
  const Neighbours n = find_neighbours(lower, upper, 0.1);
  EXPECT_FALSE(n.touch);
  EXPECT_FALSE(n.are_near());
}

TEST(Neighbours, have_before_each_node_the_place_of_the_other_it_would_pass_through) {
  const PlacedBody lower = block({2, 2, 1}, {1, 1, 1}, {0, 0, 0}),
                   upper = block({1, 1, 1}, {1, 1, 1}, {0.5, 0.25, 1.05});
  const Neighbours n = find_neighbours(lower, upper, 0.1);
  EXPECT_TRUE(n.nodes_1.empty()) << "the lower one's nodes have nothing above them";
  ASSERT_EQ(n.nodes_2.size(), 4u);
  for (const NearNode& near : n.nodes_2) {
    EXPECT_NEAR(near.gap, 0.05, 1e-12);
    EXPECT_TRUE(near.normal.isApprox(Vec3::UnitZ()));
    Vec3 below = Vec3::Zero();
    for (size_t a = 0; a < near.facet.nodes().size(); ++a) below += near.weights[a] * lower.at(near.facet.nodes()[a]);
    EXPECT_TRUE(below.isApprox(upper.at(near.node) - Vec3(0, 0, 0.05)));
  }
}

}  // namespace
}  // namespace dygita
