// Facets of two bodies that touch, found without names.
#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>

#include "meeting/round_surfaces.hpp"
#include "meeting/touching.hpp"
#include "meeting/true_gaps.hpp"
#include "mesh/box.hpp"

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

// The round faces of two tubes of 12 and more facets around: their surfaces are apart by the difference of the radii,
// whatever the chords do.
TrueGaps gaps_of_tubes(double clearance, int n_1, int n_2, double turned, double within) {
  const MeshPtr shaft = tube(5, 10, n_1), hole = tube(10 + clearance, 20, n_2, turned);
  const Touching t = find_touching({*shaft, Vec3::Zero()}, {*hole, Vec3::Zero()}, 2.0);
  return true_gaps({shaft.get(), t.facets_1, Vec3::Zero(), ""}, {hole.get(), t.facets_2, Vec3::Zero(), ""}, within);
}

TEST(TrueGaps, of_round_faces_are_those_of_their_surfaces) {
  for (const auto& [n_1, n_2] : {std::pair{12, 12}, {12, 48}, {40, 12}, {16, 24}, {48, 40}})
    for (const double turned : {0.0, 0.3, 0.5}) {
      SCOPED_TRACE(fmt::format("{} in {}, turned by {}", n_1, n_2, turned));
      const TrueGaps fit = gaps_of_tubes(0.0, n_1, n_2, turned, 0.01);
      EXPECT_NEAR(fit.mean, 0.0, 0.05 * fit.bend);
      EXPECT_FALSE(fit.is_told());
      for (const double clearance : {0.3, -0.1}) {
        const TrueGaps gap = gaps_of_tubes(clearance, n_1, n_2, turned, 0.4);
        EXPECT_NEAR(gap.mean, clearance, 0.02 + 0.03 * gap.bend);
        EXPECT_TRUE(gap.is_told());
      }
    }
}

// A round foot (radius 10, 15 degrees of it, two facets) on a plane: its nodes are where they are, and between them it
// is round.
TEST(TrueGaps, of_a_round_face_on_a_plane_are_those_of_its_arc) {
  const MeshPtr wheel = tube(5, 10, 24, 0.5), floor = box_mesh({-4, -4, -1}, {8, 8, 1}, {5, 5, 1});
  Mesh upright = *wheel;  // its axis along y, lowest line between two facets at z = 0
  for (int i = 0; i < upright.n_nodes(); ++i) {
    const Vec3 x = wheel->nodes.col(i);
    upright.nodes.col(i) = Vec3(-x[1], x[2] - 2.5, 10 - x[0]);
  }
  std::vector<Facet> round, plane;
  for (const Facet& facet : boundary_facets(upright)) {
    const Vec3 normal = facet_area_vector(upright.nodes, facet).normalized();
    if (normal[2] < -0.7) round.push_back(facet);
  }
  for (const Facet& facet : boundary_facets(*floor))
    if (facet_area_vector(floor->nodes, facet).normalized()[2] > 0.9) plane.push_back(facet);
  const TrueGaps gaps = true_gaps({&upright, round, Vec3::Zero(), ""}, {floor.get(), plane, Vec3::Zero(), ""}, 1e-3);
  const double half = 10 * std::sin(M_PI / 24), height = 10 - 10 * std::cos(M_PI / 24);  // of a facet; of its arc
  EXPECT_TRUE(gaps.is_told());
  EXPECT_NEAR(gaps.bend, height, 0.02 * height);
  EXPECT_NEAR(gaps.area, 2 * half * 5, 0.02 * 2 * half * 5) << "the facet below";
  EXPECT_NEAR(gaps.mean, height / 3, 0.02 * height) << "of a parabola";
  EXPECT_NEAR(gaps.most, gaps.mean, 1e-9) << "more is not certain";
  EXPECT_GT(gaps.touching, 0.3 * gaps.area);
}

// Between planes nothing is in doubt.
TEST(TrueGaps, of_planes_are_told_to_the_last_digit) {
  const MeshPtr lower = box_mesh({0, 0, -1}, {4, 4, 1}, {4, 4, 1}), upper = box_mesh({0, 0, 0}, {4, 4, 1}, {3, 5, 1});
  const auto face = [](const Mesh& mesh, double up) {
    PlacedFace placed{&mesh, {}, Vec3::Zero(), ""};
    for (const Facet& facet : boundary_facets(mesh))
      if (facet_area_vector(mesh.nodes, facet).normalized()[2] * up > 0.9) placed.facets.push_back(facet);
    return placed;
  };
  for (const double gap : {0.0, 1e-5, 0.01, -0.02}) {
    PlacedFace above = face(*upper, -1);
    above.place = {0, 0, gap};
    const TrueGaps gaps = true_gaps(face(*lower, 1), above, 0.03);
    EXPECT_EQ(gaps.is_told(), std::abs(gap) > 1e-3) << gap;
    EXPECT_NEAR(gaps.area, 16.0, 1e-12);
    for (const double told : {gaps.mean, gaps.least, gaps.most}) EXPECT_NEAR(told, gap, 1e-12);
    EXPECT_NEAR(gaps.apart, gap > 1e-3 ? 16.0 : 0.0, 1e-12);
    EXPECT_NEAR(gaps.into, gap < -1e-3 ? 16.0 : 0.0, 1e-12);
  }
}

PlacedFace face_where(const Mesh& mesh, const std::function<bool(const Vec3& middle, const Vec3& normal)>& is_in) {
  PlacedFace face{&mesh, {}, Vec3::Zero(), ""};
  for (const Facet& facet : boundary_facets(mesh)) {
    Vec3 middle = Vec3::Zero();
    for (const int node : facet.corners()) middle += mesh.nodes.col(node) / static_cast<double>(facet.corners().size());
    if (is_in(middle, facet_area_vector(mesh.nodes, facet).normalized())) face.facets.push_back(facet);
  }
  return face;
}

// Wherever the nodes are, and whatever lies between them.
TEST(RoundSurfaces, of_cylinders_and_balls_are_known_between_the_nodes) {
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  const Vec3 shift(3, -40, 7);
  const auto around = [](const Vec3& x) { return Vec3(x[0], x[1], 0.0); };
  Mesh shaft = *tube(5, 10, 16), hole = *tube(10.001, 20, 11, 0.3);
  const auto turned = [&](Mesh& mesh) {
    for (int i = 0; i < mesh.n_nodes(); ++i) mesh.nodes.col(i) = turn * mesh.nodes.col(i) + shift;
  };
  PlacedFace outside = face_where(shaft, [&](const Vec3& x, const Vec3& n) { return n.dot(around(x)) > 5.0; });
  PlacedFace inside = face_where(hole, [&](const Vec3& x, const Vec3& n) { return n.dot(around(x)) < -5.0; });
  turned(shaft);
  turned(hole);
  const auto one = RoundSurface::through(outside), other = RoundSurface::through(inside);
  ASSERT_TRUE(one && other);
  EXPECT_NEAR(one->radius(), 10.0, 1e-9);
  EXPECT_NEAR(other->radius(), 10.001, 1e-9);
  EXPECT_NEAR(one->even_gap(*other).value_or(0.0), 1e-3, 1e-9);
  EXPECT_NEAR(other->even_gap(*one).value_or(0.0), 1e-3, 1e-9);
  const Vec3 x = turn * Vec3(9.3, 2.1, 1.7) + shift, out = turn * Vec3(0.8, 0.6, 0.0);
  const double there = one->along(x, out).value_or(0.0);
  EXPECT_NEAR(around(turn.transpose() * (x + there * out - shift)).norm(), 10.0, 1e-9);
  EXPECT_NEAR(one->normal(x).dot(turn * around(Vec3(9.3, 2.1, 0)).normalized()), 1.0, 1e-12);
  EXPECT_LT(other->normal(x).dot(one->normal(x)), -0.999) << "out of the body, into the hole";

  Mesh ball = *box_mesh({-1, -1, -1}, {2, 2, 2}, {6, 6, 6});
  for (int i = 0; i < ball.n_nodes(); ++i) {  // what lies at z > 0.5 rises to a cap
    Vec3 node = ball.nodes.col(i);
    if (node[2] > 0.9) ball.nodes(2, i) = std::sqrt(25.0 - node.head<2>().squaredNorm()) - 4.0;
  }
  const PlacedFace cap =
      face_where(ball, [](const Vec3& middle, const Vec3& n) { return n[2] > 0.8 && middle[2] > 0.0; });
  const auto sphere = RoundSurface::through(cap);
  ASSERT_TRUE(sphere);
  EXPECT_NEAR(sphere->radius(), 5.0, 1e-9);
  EXPECT_NEAR(sphere->along(Vec3(0.1, 0.05, 0.9), Vec3::UnitZ()).value_or(0.0), std::sqrt(25 - 0.0125) - 4.9, 1e-9);
}

// A plate whose edges are chamfered, and a waved one.
TEST(RoundSurfaces, are_no_chamfers_and_no_waves) {
  const auto bent = [](int n, const std::function<double(double)>& height) {
    auto mesh = std::make_shared<Mesh>(*box_mesh({0, 0, -1}, {12, 2, 1}, {n, 2, 1}));
    for (int i = 0; i < mesh->n_nodes(); ++i)
      if (mesh->nodes(2, i) > -0.5) mesh->nodes(2, i) = height(mesh->nodes(0, i));
    return mesh;
  };
  const auto top = [](const Mesh& mesh) {
    return face_where(mesh, [](const Vec3&, const Vec3& n) { return n[2] > 0.5; });
  };
  const MeshPtr chamfered = bent(12, [](double x) { return -0.4 * std::max(0.0, 1.0 - std::min(x, 12.0 - x)); });
  const MeshPtr waved = bent(12, [](double x) { return 0.05 * std::sin(x); });
  const MeshPtr few = bent(3, [](double x) { return -0.1 * std::max(0.0, 1.0 - std::min(x, 12.0 - x)); });
  Mesh narrow = *few;  // chamfers a quarter as wide as what is between them: concyclic all the same
  for (int i = 0; i < narrow.n_nodes(); ++i) {
    const double x = narrow.nodes(0, i);
    narrow.nodes(0, i) = x < 1.0 ? 3.0 : x > 11.0 ? 9.0 : x;
  }
  EXPECT_FALSE(RoundSurface::through(top(*chamfered)));
  EXPECT_FALSE(RoundSurface::through(top(*waved)));
  EXPECT_FALSE(RoundSurface::through(top(narrow)));
  EXPECT_TRUE(RoundSurface::through(top(*bent(3, [](double x) { return std::sqrt(900.0 - (x - 6) * (x - 6)); }))));
  const auto flat = RoundSurface::through(top(*bent(4, [](double x) { return 0.1 * x; })));
  ASSERT_TRUE(flat);
  EXPECT_EQ(flat->radius(), 0.0);
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
