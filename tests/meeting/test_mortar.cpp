// Points between faces whose meshes do not match: rows, areas, and what they must keep.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <numbers>

#include "meeting/facet_map.hpp"
#include "meeting/mortar.hpp"
#include "mesh/box.hpp"
#include "mesh/expect_input_error.hpp"
#include "mesh/shape_functions.hpp"

namespace dygita {
namespace {

PlacedFace face(const Mesh& mesh, const std::string& name, const Vec3& place = Vec3::Zero()) {
  return {&mesh, mesh.faces.at(name), place, "part." + name};
}

Facing points_between(const PlacedFace& side_1, const PlacedFace& side_2, const MeetingOptions& options = {}) {
  const Meeting meeting(side_1, side_2, options);
  EXPECT_FALSE(meeting.matches());
  return meeting.facing({});
}

double pseudo_random(int i) {
  const double x = std::sin(12.9898 * i + 4.1) * 43758.5453;
  return 2.0 * (x - std::floor(x)) - 1.0;
}

// Nodes inside the faces across z moved in their planes, by a share of the cell.
Mesh distorted(Mesh mesh, double amount, int seed) {
  const Vec3 low = mesh.nodes.rowwise().minCoeff(), high = mesh.nodes.rowwise().maxCoeff();
  for (int i = 0; i < mesh.n_nodes(); ++i)
    for (int d = 0; d < 2; ++d) {
      const bool is_inside = (mesh.nodes.col(i) - low).head<2>().minCoeff() > 1e-9 &&
                             (high - mesh.nodes.col(i)).head<2>().minCoeff() > 1e-9;
      if (is_inside) mesh.nodes(d, i) += amount * pseudo_random(seed + 2 * i + d);
    }
  return mesh;
}

// Each hexahedron of a box as six tetrahedra.
Mesh in_tetrahedra(const Mesh& box) {
  constexpr int corners[6][4] = {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
  Mesh mesh;
  mesh.nodes = box.nodes;
  CellBlock block{CellType::tet4, {}};
  for (int i = 0; i < box.blocks[0].n_cells(); ++i)
    for (const auto& tet : corners)
      for (const int a : tet) block.nodes.push_back(box.blocks[0].cell(i)[a]);
  mesh.blocks = {block};
  const double low = mesh.nodes.row(2).minCoeff(), high = mesh.nodes.row(2).maxCoeff();
  for (const Facet& facet : boundary_facets(mesh.blocks)) {
    double sum = 0.0;
    for (const int node : facet.nodes()) sum += mesh.nodes(2, node) / 3.0;
    if (std::abs(sum - low) < 1e-9) mesh.faces["zmin"].push_back(facet);
    if (std::abs(sum - high) < 1e-9) mesh.faces["zmax"].push_back(facet);
  }
  return mesh;
}

Mesh box(int n, double z) { return *box_mesh(Vec3(0, 0, z), Vec3(1, 1, 0.5), {n, n, 1}); }

// What forces and linear fields ask of the rows of a plane interface.
void expect_balanced(const Facing& facing, const PlacedFace& side_1, const PlacedFace& side_2, double tolerance) {
  for (const auto& [trace, side] : {std::pair{&facing.side_1, &side_1}, {&facing.side_2, &side_2}}) {
    const Points x = side->mesh->nodes.colwise() + side->place;
    for (int i = 0; i < facing.n_points(); ++i) {
      double sum = 0.0;
      for (int k = 0; k < trace->n_shares(i); ++k) sum += trace->share(i, k).weight;
      EXPECT_NEAR(sum, 1.0, tolerance);
      EXPECT_LT((trace->at(i, x) - facing.places.col(i)).norm(), tolerance) << i;
    }
  }
}

// A constant pressure on the points is the consistent load of both faces.
void expect_consistent_loads(const Facing& facing, const SideTrace& trace, const PlacedFace& side, double tolerance) {
  Points force = Points::Zero(3, side.mesh->n_nodes());
  for (int i = 0; i < facing.n_points(); ++i) trace.spread(i, facing.areas[i] * Vec3::UnitZ(), force);
  const FaceNodes expected = face_nodes(*side.mesh, side.facets);
  for (size_t i = 0; i < expected.nodes.size(); ++i)
    EXPECT_NEAR(force(2, expected.nodes[i]), expected.weights[static_cast<Eigen::Index>(i)], tolerance);
}

// By hand: one square on two halves of it.
TEST(FacetMap, has_the_functions_that_the_table_of_facets_declares) {
  for (const FacetShape& shape : facet_shapes)
    for (int i = 0; i < 20; ++i) {
      const Vec2 xi(pseudo_random(2 * i), pseudo_random(2 * i + 1));
      const ShapeFunctions& declared = shape_functions(shape.type);
      const Vec3 at(xi[0], xi[1], 0.0);
      EXPECT_LT((facet_values(shape.type, xi) - declared.values(at)).cwiseAbs().maxCoeff(), 1e-14);
      EXPECT_LT((facet_slopes(shape.type, xi) - declared.slopes(at).leftCols<2>()).cwiseAbs().maxCoeff(), 1e-14);
    }
}

TEST(FacetMap, finds_the_point_of_a_curved_facet_that_is_projected_on_a_place) {
  for (const FacetShape& shape : facet_shapes) {
    Points x(3, static_cast<Eigen::Index>(shape.shape.nodes.size()));
    for (int a = 0; a < x.cols(); ++a)
      x.col(a) = vector_of(shape.shape.nodes[static_cast<size_t>(a)]) +
                 0.05 * Vec3(pseudo_random(3 * a), pseudo_random(3 * a + 1), pseudo_random(3 * a + 2));
    const FacetMap map(shape.type, x, Vec3::Zero(), Eigen::Matrix<double, 3, 2>::Identity());
    for (int i = 0; i < 20; ++i) {
      const Vec2 xi = 0.3 * Vec2(1 + pseudo_random(2 * i), 1 + pseudo_random(2 * i + 1));
      const Vec3 at = x * shape_functions(shape.type).values({xi[0], xi[1], 0.0});
      EXPECT_LT((map.inverse(at.head<2>()) - xi).norm(), 1e-13);
    }
  }
}

// A facet around 80 degrees of a cylinder, seen along its radius at one edge: no point of it is projected on places
// beyond the other edge, where Newton's iteration diverges if nothing bounds it.
TEST(FacetMap, finds_the_nearest_point_where_none_of_a_curved_facet_is_projected_on_a_place) {
  for (const FacetType type : {FacetType::tri6, FacetType::quad8, FacetType::quad9}) {
    const FacetShape& shape = facet_shape(type);
    const bool is_triangle = type == FacetType::tri6;
    Points x(3, static_cast<Eigen::Index>(shape.shape.nodes.size()));
    for (int a = 0; a < x.cols(); ++a) {
      const Vec3 at = vector_of(shape.shape.nodes[static_cast<size_t>(a)]);
      const double angle = 80.0 / 180.0 * std::numbers::pi * (is_triangle ? at[0] : 0.5 * (1.0 + at[0]));
      x.col(a) = Vec3(std::cos(angle), std::sin(angle), at[1]);
    }
    Eigen::Matrix<double, 3, 2> along;
    along << 0, 0, 1, 0, 0, 1;
    const FacetMap map(type, x, Vec3::Zero(), along);
    const auto projected = [&](const Vec2& xi) -> Vec2 { return along.transpose() * x * facet_values(type, xi); };
    for (const double y : {1.02, 1.1, 1.3, 2.0})
      for (const double z : {0.0, 0.1, 0.3}) {
        const Vec2 p(y, z), xi = map.inverse(p);
        EXPECT_LE(xi.cwiseAbs().maxCoeff(), 1.6 + 1e-12);
        EXPECT_LE(facet_values(type, xi).cwiseAbs().maxCoeff(), 8.0);
        double least = 1e300;
        for (double r = is_triangle ? 0.0 : -1.0; r <= 1.0; r += 0.02)
          for (double s = is_triangle ? 0.0 : -1.0; s <= 1.0; s += 0.02)
            least = std::min(least, (projected({r, s}) - p).norm());
        EXPECT_LE((projected(xi) - p).norm(), 1.05 * least + 1e-3) << y << " " << z;
      }
  }
}

TEST(Mortar, of_a_square_on_two_rectangles_has_the_rows_of_the_dual_functions) {
  const Mesh lower = *box_mesh(Vec3(0, 0, 0), Vec3(1, 1, 1), {1, 1, 1});
  const Mesh upper = *box_mesh(Vec3(0, 0, 1), Vec3(1, 1, 1), {2, 1, 1});
  const Facing facing = points_between(face(lower, "zmax"), face(upper, "zmin"));
  EXPECT_EQ(facing.carrier, 1);
  ASSERT_EQ(facing.n_points(), 4);
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(facing.areas[i], 0.25, 1e-15);
    ASSERT_TRUE(facing.side_1.is_of_one_node(i));
    EXPECT_EQ(facing.side_1.share(i, 0).weight, 1.0);
    const Vec3 at = lower.nodes.col(facing.side_1.main_node(i));
    for (int k = 0; k < facing.side_2.n_shares(i); ++k) {
      const Vec3 x = upper.nodes.col(facing.side_2.share(i, k).node);
      const double along = std::abs(x[0] - at[0]);
      EXPECT_NEAR(facing.side_2.share(i, k).weight,
                  std::abs(x[1] - at[1]) > 0.5 ? 0.0
                  : along < 0.25               ? 0.75
                  : along < 0.75               ? 0.5
                                               : -0.25,
                  1e-14);
    }
  }
}

TEST(Mortar, keeps_forces_moments_linear_fields_and_constant_pressures_of_distorted_faces) {
  for (const bool is_lower_tet : {false, true})
    for (const bool is_upper_tet : {false, true})
      for (const auto& [n_lower, n_upper] : {std::pair{3, 4}, {4, 3}, {2, 7}}) {
        SCOPED_TRACE(testing::Message() << n_lower << ' ' << n_upper << is_lower_tet << is_upper_tet);
        Mesh lower = distorted(box(n_lower, 0.0), 0.15 / n_lower, 1),
             upper = distorted(box(n_upper, 0.5), 0.15 / n_upper, 99);
        if (is_lower_tet) lower = in_tetrahedra(lower);
        if (is_upper_tet) upper = in_tetrahedra(upper);
        const PlacedFace side_1 = face(lower, "zmax"), side_2 = face(upper, "zmin");
        for (const Carrier carrier : {Carrier::automatic, Carrier::first, Carrier::second}) {
          const Facing facing = points_between(side_1, side_2, {0.0, carrier, false});
          EXPECT_NEAR(facing.areas.sum(), 1.0, 1e-12);
          expect_balanced(facing, side_1, side_2, 1e-10);
          expect_consistent_loads(facing, facing.side_1, side_1, 1e-10);
          expect_consistent_loads(facing, facing.side_2, side_2, 1e-10);
          EXPECT_TRUE((facing.normals.row(2).array() > 1 - 1e-12).all());
        }
      }
}

// Every type of cells on every other; those of order two keep their nodes in the middle of straight edges, so that
// their faces are the same places as those of linear ones.
TEST(Mortar, keeps_forces_moments_linear_fields_and_constant_pressures_between_all_types_of_cells) {
  for (const CellShape& lower : cell_shapes)
    for (const CellShape& upper : cell_shapes)
      for (const int n_upper : {3, 2}) {
        const int n_lower = 2;
        SCOPED_TRACE(testing::Message() << lower.name << " on " << upper.name << ' ' << n_upper);
        const Mesh low = *box_mesh(Vec3(0, 0, 0), Vec3(1, 1, 0.5), {n_lower, n_lower, 1}, lower.type);
        const Mesh up = *box_mesh(Vec3(0, 0, 0.5), Vec3(1, 1, 0.5), {n_upper, n_upper, 1}, upper.type);
        const PlacedFace side_1 = face(low, "zmax"), side_2 = face(up, "zmin");
        MeetingOptions options;
        options.acts_by_area = true;
        const Meeting meeting(side_1, side_2, options);
        const Facing facing = meeting.facing({});
        EXPECT_NEAR(facing.areas.sum(), 1.0, 1e-12);
        EXPECT_GT(facing.areas.minCoeff(), 0.0);
        expect_balanced(facing, side_1, side_2, 1e-10);
        expect_consistent_loads(facing, facing.side_1, side_1, 1e-10);
        expect_consistent_loads(facing, facing.side_2, side_2, 1e-10);
      }
}

// Sub-facets that are covered altogether beside such that nothing faces: a function of all of the facet would have a
// negative integral over the half of it that is covered, and its point no area.
TEST(Mortar, of_facets_whose_half_is_covered_has_the_area_of_the_overlap) {
  for (const CellShape& shape : cell_shapes)
    for (const double offset : {0.5, 0.25, 0.4})
      for (const Carrier carrier : {Carrier::automatic, Carrier::first, Carrier::second}) {
        SCOPED_TRACE(testing::Message() << shape.name << ' ' << offset << ' ' << static_cast<int>(carrier));
        const Mesh low = *box_mesh(Vec3(0, 0, 0), Vec3(6, 2, 1), {6, 2, 1}, shape.type);
        const Mesh up = *box_mesh(Vec3(2 + offset, 0, 1), Vec3(1, 2, 1), {1, 1, 1}, shape.type);
        const PlacedFace side_1 = face(low, "zmax"), side_2 = face(up, "zmin");
        const Facing facing = points_between(side_1, side_2, {0.0, carrier, false});
        EXPECT_NEAR(facing.areas.sum(), 2.0, 1e-12);
        EXPECT_GT(facing.areas.minCoeff(), 0.0);
        expect_balanced(facing, side_1, side_2, 1e-9);
        expect_consistent_loads(facing, facing.side_2, side_2, 1e-10);
      }
}

// Weights of a point at a corner and on an edge of one facet of order two against another of its kind.
TEST(Mortar, of_facets_of_order_two_has_the_points_of_their_sub_facets) {
  const Mesh lower = *box_mesh(Vec3(0, 0, 0), Vec3(1, 1, 1), {1, 1, 1}, CellType::hex20);
  const Mesh upper = *box_mesh(Vec3(0, 0, 1), Vec3(1, 1, 1), {1, 1, 1}, CellType::hex20);
  MeetingOptions options;
  options.acts_by_area = true;
  const Facing facing = Meeting(face(lower, "zmax"), face(upper, "zmin"), options).facing({});
  ASSERT_EQ(facing.n_points(), 8);
  for (int i = 0; i < 8; ++i) {
    const bool is_corner = facing.areas[i] < 0.1;
    EXPECT_NEAR(facing.areas[i], is_corner ? 1.0 / 24 : 5.0 / 24, 1e-14);
    const int own = facing.side_1.main_node(i);
    for (int k = 0; k < facing.side_1.n_shares(i); ++k) {
      const auto& share = facing.side_1.share(i, k);
      if (share.node != own) continue;
      EXPECT_NEAR(share.weight, is_corner ? 0.8541666667 : 1.16, 1e-9);
    }
  }
}

TEST(Mortar,
     has_its_points_on_the_face_within_the_other_else_on_the_coarser_else_where_there_are_fewer_else_on_the_preferred) {
  const Mesh coarse = box(3, 0.0), fine = box(5, 0.5);
  EXPECT_EQ(points_between(face(coarse, "zmax"), face(fine, "zmin")).carrier, 1);
  EXPECT_EQ(points_between(face(fine, "zmin"), face(coarse, "zmax")).carrier, 2);
  EXPECT_NEAR(points_between(face(coarse, "zmax"), face(fine, "zmin")).size_ratio, 5.0 / 3.0, 1e-12);
  EXPECT_EQ(points_between(face(coarse, "zmax"), face(fine, "zmin"), {0.0, Carrier::second, false}).carrier, 2);
  const Mesh fewer = *box_mesh(Vec3(0, 0, 0.5), Vec3(1, 1, 0.5), {3, 4, 1});
  const Mesh four = *box_mesh(Vec3(0, 0, 0), Vec3(1, 1, 0.5), {4, 4, 1});
  EXPECT_EQ(points_between(face(four, "zmax"), face(fewer, "zmin")).carrier, 2);
  EXPECT_EQ(points_between(face(fewer, "zmin"), face(four, "zmax")).carrier, 1);
  // A foot on a table, its facets finer or coarser than the table's.
  for (const int n : {2, 9}) {
    const Mesh foot = *box_mesh(Vec3(0.21, 0.3, 0.5), Vec3(0.5, 0.45, 0.5), {n, n, 1});
    EXPECT_EQ(points_between(face(coarse, "zmax"), face(foot, "zmin")).carrier, 2);
    EXPECT_EQ(points_between(face(foot, "zmin"), face(coarse, "zmax")).carrier, 1);
  }
  const Mesh same = distorted(box(3, 0.5), 0.02, 7);
  EXPECT_EQ(points_between(face(coarse, "zmax"), face(same, "zmin")).carrier, 1);
  EXPECT_EQ(points_between(face(coarse, "zmax"), face(same, "zmin"), {0.0, Carrier::automatic, true}).carrier, 2);
}

// A quarter of a ring: faces "in" and "out".
Mesh quarter_ring(int n, double radius_in, double radius_out) {
  Mesh mesh;
  mesh.nodes.resize(3, 4 * (n + 1));
  CellBlock block{CellType::hex8, {}};
  for (int i = 0; i <= n; ++i) {
    const double angle = 0.5 * std::numbers::pi * i / n;
    for (int k = 0; k < 4; ++k) {
      const double radius = k % 2 == 0 ? radius_in : radius_out;
      mesh.nodes.col(4 * i + k) << radius * std::cos(angle), radius * std::sin(angle), k / 2;
    }
    for (int k = 0; k < 2 && i < n; ++k)
      for (const int node : {4 * i, 4 * i + 1, 4 * i + 5, 4 * i + 4}) block.nodes.push_back(node + 2 * k);
  }
  mesh.blocks = {block};
  for (const Facet& facet : boundary_facets(mesh.blocks)) {
    const auto radius = [&](int a) { return mesh.nodes.col(facet.nodes()[static_cast<size_t>(a)]).head<2>().norm(); };
    for (const auto& [name, r] : {std::pair{"in", radius_in}, {"out", radius_out}})
      if (std::abs(radius(0) - r) < 1e-9 && std::abs(radius(2) - r) < 1e-9) mesh.faces[name].push_back(facet);
  }
  check_mesh(mesh, "ring");
  return mesh;
}

// Facets of round faces are a sagitta apart: rigid motions and moments must not see it.
TEST(Mortar, of_faceted_rings_keeps_rigid_motions_and_moments) {
  for (const auto& [n_in, n_out] : {std::pair{6, 10}, {4, 20}, {20, 4}}) {
    SCOPED_TRACE(testing::Message() << n_in << ':' << n_out);
    const Mesh inner = quarter_ring(n_in, 1, 2), outer = quarter_ring(n_out, 2, 3);
    const Facing facing = points_between(face(inner, "out"), face(outer, "in"));
    EXPECT_EQ(facing.carrier, n_in < n_out ? 1 : 2);
    for (int d = 0; d < 3; ++d) {
      const auto rotation = [&](const Mesh& mesh) {
        Points v = mesh.nodes;
        for (int i = 0; i < v.cols(); ++i) v.col(i) = Vec3::Unit(d).cross(Vec3(mesh.nodes.col(i)));
        return v;
      };
      const Points v_1 = rotation(inner), v_2 = rotation(outer);
      for (int i = 0; i < facing.n_points(); ++i) {
        EXPECT_LT((facing.side_1.at(i, v_1) - facing.side_2.at(i, v_2)).norm(), 1e-13);
        EXPECT_LT((facing.side_1.at(i, v_1) - Vec3::Unit(d).cross(Vec3(facing.places.col(i)))).norm(), 1e-13);
      }
    }
    Points on_1 = Points::Zero(3, inner.n_nodes()), on_2 = Points::Zero(3, outer.n_nodes());
    for (int i = 0; i < facing.n_points(); ++i) {
      const Vec3 force(pseudo_random(3 * i), pseudo_random(3 * i + 1), pseudo_random(3 * i + 2));
      facing.side_1.spread(i, force, on_1);
      facing.side_2.spread(i, -force, on_2);
    }
    Vec3 moment = Vec3::Zero();
    for (int i = 0; i < inner.n_nodes(); ++i) moment += Vec3(inner.nodes.col(i)).cross(Vec3(on_1.col(i)));
    for (int i = 0; i < outer.n_nodes(); ++i) moment += Vec3(outer.nodes.col(i)).cross(Vec3(on_2.col(i)));
    EXPECT_LT((on_1.rowwise().sum() + on_2.rowwise().sum()).norm(), 1e-13);
    EXPECT_LT(moment.norm(), 1e-13);
  }
}

// A quarter of a ring of tetrahedra, its rows of nodes shifted against one another: triangles that are as long around
// as they are high.
Mesh ring_of_triangles(int n, double radius_in) {
  Mesh mesh = in_tetrahedra(*box_mesh(Vec3(0, 0, radius_in), Vec3(1, 1, 1), {n, n, 1}));
  for (int i = 0; i < mesh.n_nodes(); ++i) {
    auto x = mesh.nodes.col(i);
    const bool is_inside = x[0] > 1e-9 && x[0] < 1.0 - 1e-9, is_odd = std::lround(x[1] * n) % 2 == 1;
    const double angle = 0.5 * std::numbers::pi * (x[0] + (is_inside && is_odd ? 0.5 / n : 0.0));
    x = Vec3(x[2] * std::cos(angle), x[1], x[2] * std::sin(angle)).eval();
  }
  for (CellBlock& block : mesh.blocks)
    for (int c = 0; c < block.n_cells(); ++c)
      std::swap(block.nodes[static_cast<size_t>(4 * c)], block.nodes[static_cast<size_t>(4 * c + 1)]);
  for (auto& [name, facets] : mesh.faces)
    for (Facet& facet : facets) std::swap(facet.nodes()[0], facet.nodes()[1]);
  check_mesh(mesh, "ring");
  return mesh;
}

TEST(Mortar, of_round_faces_of_triangles_has_all_of_their_area) {
  for (const auto& [n_in, n_out] : {std::pair{4, 5}, {5, 7}, {6, 9}, {9, 4}}) {
    const Mesh inner = ring_of_triangles(n_in, 1), outer = ring_of_triangles(n_out, 2);
    const Facing facing = points_between(face(inner, "zmax"), face(outer, "zmin"));
    EXPECT_GT(facing.areas.sum(), 0.97 * std::numbers::pi) << n_in << ':' << n_out;
    EXPECT_LT(facing.areas.sum(), 1.05 * std::numbers::pi) << n_in << ':' << n_out;
  }
}

// Second moments of the points' areas about their middle, m^4.
Vec2 spread_of(const Facing& facing) {
  const Vec3 middle = facing.places * facing.areas / facing.areas.sum();
  return ((facing.places.topRows<2>().colwise() - middle.head<2>()).array().square().matrix() * facing.areas);
}

// An edge anywhere in the facets that carry the points: nothing of the pressure is lost, no row grows, and the points
// reach as far as what is covered and no farther.
TEST(Mortar, of_a_face_whose_edge_cuts_facets_has_points_where_these_are_covered) {
  for (const bool is_tet : {false, true})
    for (int position = 0; position < 12; ++position) {
      Mesh table = box(4, 0.0);
      if (is_tet) table = in_tetrahedra(table);
      const double edge = position == 0 ? 0.5 + 1e-5 : position == 11 ? 0.75 - 1e-5 : 0.5 + 0.25 * position / 12.0;
      SCOPED_TRACE(testing::Message() << edge << is_tet);
      const Mesh punch = *box_mesh(Vec3(0, 0, 0.5), Vec3(edge, 1, 0.5), {7, 9, 1});
      const PlacedFace side_1 = face(table, "zmax"), side_2 = face(punch, "zmin");
      const Facing facing = points_between(side_1, side_2, {0.0, Carrier::first, false});
      EXPECT_NEAR(facing.areas.sum(), edge, 1e-12);
      expect_balanced(facing, side_1, side_2, 1e-10);
      expect_consistent_loads(facing, facing.side_2, side_2, 1e-12);
      for (const SideTrace* trace : {&facing.side_1, &facing.side_2})
        for (int i = 0; i < facing.n_points(); ++i) {
          double sum = 0.0;
          for (int k = 0; k < trace->n_shares(i); ++k) sum += std::abs(trace->share(i, k).weight);
          EXPECT_LT(sum, 3.0);
        }
      const double reach = facing.places.row(0).maxCoeff();
      EXPECT_NEAR(reach, edge, 0.15 * 0.25);
      for (const Facet& facet : facing.facets)
        for (const int point : facet.nodes()) EXPECT_TRUE(point >= 0 && point < facing.n_points());
    }
}

// A foot on the edge of a table, neither face within the other, at any offset and angle: the points hold it as well as
// points of the whole overlap would.
TEST(Mortar, of_faces_that_cover_each_other_in_part_spans_the_overlap) {
  const Mesh table = box(3, 0.0);
  for (const int n : {1, 2, 3, 7})
    for (const double offset : {0.53, 0.66, 0.81})
      for (const double angle : {0.0, 0.3, 0.7}) {
        Mesh foot = *box_mesh(Vec3(-0.4, -0.3, 0.5), Vec3(0.8, 0.6, 0.5), {n, n, 1});
        const Eigen::AngleAxisd turn(angle, Vec3::UnitZ());
        foot.nodes = (turn.toRotationMatrix() * foot.nodes).eval();
        const PlacedFace side_1 = face(table, "zmax"), side_2 = face(foot, "zmin", Vec3(offset + 0.2, 0.5, 0));
        const Facing exact = points_between(side_1, side_2, {0.0, Carrier::first, false});
        const Mesh fine = box(60, 0.0);
        const Vec2 wanted = spread_of(points_between(face(fine, "zmax"), side_2, {0.0, Carrier::first, false}));
        for (const Carrier carrier : {Carrier::automatic, Carrier::first, Carrier::second}) {
          SCOPED_TRACE(testing::Message() << n << ' ' << offset << ' ' << angle << ' ' << static_cast<int>(carrier));
          const Facing facing = points_between(side_1, side_2, {0.0, carrier, false});
          expect_balanced(facing, side_1, side_2, 1e-9);
          EXPECT_NEAR(facing.areas.sum(), exact.areas.sum(), 1e-12);
          EXPECT_GT(facing.areas.minCoeff(), 0.0);
          for (int d = 0; d < 2; ++d) {
            EXPECT_GT(spread_of(facing)[d], 0.45 * wanted[d]);
            EXPECT_LT(spread_of(facing)[d], 3.3 * wanted[d]);
          }
        }
      }
}

TEST(Mortar, leaves_points_that_are_taken_away_to_their_neighbours) {
  const Mesh lower = box(3, 0.0), upper = box(4, 0.5);
  const PlacedFace side_1 = face(lower, "zmax"), side_2 = face(upper, "zmin");
  const Meeting meeting(side_1, side_2, {});
  const Facing facing = meeting.facing([](const Vec3& x) { return x[0] < 1e-9; });
  EXPECT_EQ(facing.n_points(), 12);
  EXPECT_EQ(facing.n_merged, 4);
  EXPECT_NEAR(facing.areas.sum(), 1.0, 1e-12);
  expect_balanced(facing, side_1, side_2, 1e-12);
}

// Four feet in the corners of a plate, whose slivers could go to either of two points as large as each other.
TEST(Mortar, of_mirror_images_are_mirror_images) {
  for (const Carrier carrier : {Carrier::automatic, Carrier::first}) {
    const Mesh plate = *box_mesh(Vec3(-8, -5, -1), Vec3(16, 10, 1), {16, 10, 1});
    const auto foot_at = [&](double x, double y) {
      const Mesh foot = *box_mesh(Vec3(x - 0.75, y - 0.75, 0), Vec3(1.5, 1.5, 1), {2, 2, 1});
      const Facing facing = points_between(face(plate, "zmax"), face(foot, "zmin"), {0.0, carrier, false});
      std::vector<std::array<double, 3>> points;
      for (int i = 0; i < facing.n_points(); ++i)
        points.push_back({std::abs(facing.places(0, i)), std::abs(facing.places(1, i)), facing.areas[i]});
      // Last digits put no point before another.
      const auto order = [](const std::array<double, 3>& p) {
        return std::pair(std::llround(1e9 * p[0]), std::llround(1e9 * p[1]));
      };
      std::sort(points.begin(), points.end(), [&](const auto& a, const auto& b) { return order(a) < order(b); });
      return points;
    };
    const auto first = foot_at(3.5, 2.5);
    for (const auto& [x, y] : {std::pair(-3.5, 2.5), {3.5, -2.5}, {-3.5, -2.5}}) {
      const auto other = foot_at(x, y);
      ASSERT_EQ(other.size(), first.size());
      for (size_t i = 0; i < first.size(); ++i)
        for (size_t d = 0; d < 3; ++d) EXPECT_NEAR(other[i][d], first[i][d], 1e-12) << x << " " << y;
    }
  }
}

TEST(Mortar, of_bodies_on_the_same_side_is_refused) {
  const Mesh tall = box(2, 0.0), other = box(3, 0.0);
  expect_input_error([&] { Meeting(face(tall, "zmax"), face(other, "zmax"), {}); }, {"same side", "overlap"});
}

// Every facet against every other would not end within the limit that each test has; the record has the time.
TEST(Mortar, of_a_hundred_thousand_facets_ends) {
  const Mesh lower = *box_mesh(Vec3(0, 0, 0), Vec3(1, 1, 0.01), {316, 316, 1});
  const Mesh upper = *box_mesh(Vec3(0, 0, 0.01), Vec3(1, 1, 0.01), {400, 400, 1});
  const std::clock_t start = std::clock();
  const Facing facing = points_between(face(lower, "zmax"), face(upper, "zmin"));
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;  // of the processors
  EXPECT_EQ(facing.n_points(), 317 * 317);
  EXPECT_NEAR(facing.areas.sum(), 1.0, 1e-9);
  RecordProperty("seconds", std::to_string(seconds));
}

}  // namespace
}  // namespace dygita
