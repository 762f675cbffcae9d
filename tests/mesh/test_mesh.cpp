#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "meeting/facing.hpp"
#include "mesh/box.hpp"
#include "mesh/expect_input_error.hpp"
#include "mesh/mesh.hpp"
#include "mesh/mesh_limits.hpp"
#include "mesh/unmatched_cells.hpp"

namespace dygita {
namespace {

Vec3 area_vector(const Mesh& mesh, const Facet& facet) {
  Vec3 area = Vec3::Zero();
  const std::span<const int> corners = facet.corners();
  const Vec3 first = mesh.nodes.col(corners[0]);
  for (size_t i = 1; i + 1 < corners.size(); ++i)
    area += (Vec3(mesh.nodes.col(corners[i])) - first).cross(Vec3(mesh.nodes.col(corners[i + 1])) - first) / 2;
  return area;
}

Mesh one_cell(CellType type, const Points& nodes) {
  Mesh mesh;
  mesh.nodes = nodes;
  CellBlock block{type, {}};
  for (int i = 0; i < nodes.cols(); ++i) block.nodes.push_back(i);
  mesh.blocks.push_back(block);
  mesh.source = "test";
  return mesh;
}

Points unit_tet() {
  Points x(3, 4);
  x << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1;
  return x;
}

// Base triangle turning clockwise seen from the top, as in vtkWedge.
Points unit_prism() {
  Points x(3, 6);
  x << 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 1, 1;
  return x;
}

TEST(Box, is_split_into_the_asked_cells) {
  const MeshPtr box = box_mesh({0, 0, 0}, {1, 2, 3}, {2, 3, 4});
  EXPECT_EQ(box->n_cells(), 24);
  EXPECT_EQ(box->n_nodes(), 3 * 4 * 5);
  EXPECT_EQ(box->faces.at("xmin").size(), 12u);
  EXPECT_EQ(box->faces.at("ymax").size(), 8u);
  EXPECT_EQ(box->faces.at("zmin").size(), 6u);
  EXPECT_EQ(box->faces.size(), 6u);
  EXPECT_NO_THROW(check_mesh(*box, "box"));
}

TEST(Box, fills_its_volume_from_its_origin) {
  const MeshPtr box = box_mesh({-1, 5, 0.25}, {1, 2, 3}, {2, 3, 4});
  EXPECT_NEAR(volume(*box), 6.0, 1e-13);
  EXPECT_TRUE(box->nodes.rowwise().minCoeff().isApprox(Vec3(-1, 5, 0.25)));
  EXPECT_TRUE(box->nodes.rowwise().maxCoeff().isApprox(Vec3(0, 7, 3.25)));
}

TEST(Box, has_faces_whose_normals_point_outward) {
  const MeshPtr box = box_mesh({1, 1, 1}, {1, 2, 3}, {2, 3, 4});
  for (int axis = 0; axis < 3; ++axis)
    for (const bool is_max : {false, true}) {
      const std::string name = std::string(1, "xyz"[axis]) + (is_max ? "max" : "min");
      Vec3 total = Vec3::Zero();
      for (const Facet& facet : box->faces.at(name)) total += area_vector(*box, facet);
      const double area = 6.0 / (axis + 1);
      EXPECT_TRUE(total.isApprox(Vec3::Unit(axis) * (is_max ? area : -area))) << name << total.transpose();
    }
}

TEST(Box, covers_its_boundary_by_its_six_faces) {
  const MeshPtr box = box_mesh({0, 0, 0}, {1, 1, 1}, {3, 2, 2});
  std::map<FacetKey, Vec3> boundary;
  for (const Facet& facet : boundary_facets(box->blocks)) boundary[facet_key(facet)] = area_vector(*box, facet);
  size_t n_named = 0;
  for (const auto& [name, facets] : box->faces)
    for (const Facet& facet : facets) {
      ++n_named;
      ASSERT_TRUE(boundary.count(facet_key(facet))) << name;
      EXPECT_TRUE(boundary.at(facet_key(facet)).isApprox(area_vector(*box, facet))) << name;
    }
  EXPECT_EQ(n_named, boundary.size());
}

TEST(Box, refuses_sizes_and_counts_that_are_not_positive) {
  expect_input_error([] { box_mesh({0, 0, 0}, {1, 0, 1}, {1, 1, 1}); }, {"size along y", "positive", "0 m"});
  expect_input_error([] { box_mesh({0, 0, 0}, {1, 1, -2}, {1, 1, 1}); }, {"size along z", "-2 m"});
  expect_input_error([] { box_mesh({0, 0, 0}, {1, 1, 1}, {0, 1, 1}); }, {"cells along x", "at least 1"});
}

TEST(Box, that_takes_more_memory_than_there_is_is_refused_before_it_is_made) {
  set_mesh_limits({.box_memory = 1e6, .trusted = {}});
  const Vec3 zero = Vec3::Zero(), one = Vec3::Ones();
  std::string message;
  try {
    box_mesh(zero, one, {100, 100, 100});
  } catch (const InputError& error) {
    message = error.what();
  }
  EXPECT_EQ(message, "box: 100 x 100 x 100 cells require about 0.06 GB, but this machine has 0.001 GB");
  EXPECT_THROW(box_mesh(zero, one, {10, 10, 10}, CellType::tet10), InputError);
  EXPECT_NO_THROW(box_mesh(zero, one, {20, 20, 20}));
  set_mesh_limits({});
}

TEST(Mesh, has_outward_facets_of_the_right_area_on_every_cell_type) {
  const MeshPtr cube = box_mesh({0, 0, 0}, {1, 1, 1}, {1, 1, 1});
  const Mesh prism = one_cell(CellType::prism6, unit_prism()), tet = one_cell(CellType::tet4, unit_tet());
  const std::pair<const Mesh*, double> expected[] = {
      {cube.get(), 6.0}, {&prism, 3 + std::sqrt(2.0)}, {&tet, 1.5 + std::sqrt(3.0) / 2}};
  for (const auto& [mesh, expected_area] : expected) {
    const Vec3 centre = mesh->nodes.rowwise().mean();
    double area = 0;
    for (const Facet& facet : boundary_facets(mesh->blocks)) {
      const Vec3 normal = area_vector(*mesh, facet);
      area += normal.norm();
      EXPECT_GT(normal.dot(Vec3(mesh->nodes.col(facet.nodes()[0])) - centre), 0)
          << cell_shape(mesh->blocks[0].type).name;
    }
    EXPECT_NEAR(area, expected_area, 1e-14);
  }
}

// The plain way: those that are met once, in the order of the cells; here a facet of three cells, too.
TEST(Mesh, has_on_its_boundary_what_is_met_once) {
  for (const CellType type : {CellType::hex8, CellType::tet4, CellType::tet10, CellType::hex27}) {
    const MeshPtr box = box_mesh({0, 0, 0}, {1, 1, 1}, {3, 2, 4}, type);
    std::vector<CellBlock> blocks = box->blocks;
    const std::vector<int> first(blocks[0].cell(5), blocks[0].cell(6));
    for (int again = 0; again < 2; ++again) blocks[0].nodes.insert(blocks[0].nodes.end(), first.begin(), first.end());
    std::map<FacetKey, int> met;
    std::vector<Facet> facets, plain;
    for (const CellBlock& block : blocks)
      for (int i = 0; i < block.n_cells(); ++i)
        for (int k = 0; k < facets_per_cell(block.type); ++k)
          ++met[facet_key(facets.emplace_back(facet_of_cell(block, i, k)))];
    for (const Facet& facet : facets)
      if (met[facet_key(facet)] == 1) plain.push_back(facet);
    const std::vector<Facet> computed = boundary_facets(blocks);
    ASSERT_EQ(computed.size(), plain.size());
    ASSERT_GT(plain.size(), 20u);
    for (size_t i = 0; i < plain.size(); ++i)
      EXPECT_TRUE(std::equal(plain[i].nodes().begin(), plain[i].nodes().end(), computed[i].nodes().begin()));
  }
}

TEST(Mesh, measures_the_volume_of_every_cell_type) {
  EXPECT_NEAR(volume(one_cell(CellType::tet4, unit_tet())), 1.0 / 6, 1e-15);
  EXPECT_NEAR(volume(one_cell(CellType::prism6, unit_prism())), 0.5, 1e-15);
  // A frustum of a pyramid: squares of side 2 and 1, height 3.
  Points frustum(3, 8);
  frustum << -1, 1, 1, -1, -.5, .5, .5, -.5, -1, -1, 1, 1, -.5, -.5, .5, .5, 0, 0, 0, 0, 3, 3, 3, 3;
  EXPECT_NEAR(volume(one_cell(CellType::hex8, frustum)), 3.0 / 3 * (4 + 1 + 2), 1e-14);
}

TEST(Mesh, with_an_inverted_cell_is_refused_with_its_type_and_place) {
  Points tet = unit_tet();
  tet.col(1).swap(tet.col(2));
  expect_input_error([&] { check_mesh(one_cell(CellType::tet4, tet), "bracket"); },
                     {"bracket", "cell 0", "tet4", "(0.25, 0.25, 0.25)", "volume -0.167", "inverted"});
  Points prism = unit_prism();
  prism.col(1).swap(prism.col(2));
  prism.col(4).swap(prism.col(5));
  expect_input_error([&] { check_mesh(one_cell(CellType::prism6, prism), "bracket"); }, {"prism6", "volume -0.5"});
}

TEST(Mesh, with_a_hexahedron_folded_at_one_corner_is_refused_though_its_volume_is_positive) {
  Mesh mesh = *box_mesh({0, 0, 0}, {1, 1, 1}, {1, 1, 1});
  mesh.nodes.col(7) = Vec3(0.8, 0.2, 0.9);
  EXPECT_GT(volume(mesh), 0);
  expect_input_error([&] { check_mesh(mesh, "block"); }, {"block", "hex8", "inverted", "smallest"});
}

TEST(Mesh, with_a_flat_cell_is_refused) {
  Points tet = unit_tet();
  tet.col(3) = Vec3(0.3, 0.3, 0);
  expect_input_error([&] { check_mesh(one_cell(CellType::tet4, tet), "sliver"); }, {"sliver", "flat"});
}

TEST(Mesh, with_a_lone_node_or_without_cells_is_refused) {
  Mesh mesh = *box_mesh({0, 0, 0}, {1, 1, 1}, {1, 1, 1});
  mesh.nodes.conservativeResize(3, 9);
  mesh.nodes.col(8) = Vec3(4, 5, 6);
  expect_input_error([&] { check_mesh(mesh, "block"); }, {"block", "node 8", "(4, 5, 6)", "no cell"});
  mesh.blocks.clear();
  expect_input_error([&] { check_mesh(mesh, "block"); }, {"block", "has no cell", "box"});
}

// Two cells that share the facet 0 1 2 of a tetrahedron.
Mesh with_second(CellType type, const std::vector<int>& cell, const std::vector<Vec3>& more) {
  Mesh mesh = one_cell(CellType::tet4, unit_tet());
  mesh.nodes.conservativeResize(3, 4 + static_cast<long>(more.size()));
  for (size_t i = 0; i < more.size(); ++i) mesh.nodes.col(4 + static_cast<long>(i)) = more[i];
  if (type == CellType::tet4)
    mesh.blocks[0].nodes.insert(mesh.blocks[0].nodes.end(), cell.begin(), cell.end());
  else
    mesh.blocks.push_back({type, cell});
  return mesh;
}

TEST(Mesh, whose_cells_do_not_fit_at_a_facet_is_refused_with_both) {
  EXPECT_NO_THROW(check_mesh(with_second(CellType::tet4, {0, 2, 1, 4}, {{0, 0, -1}}), "fits"));
  expect_input_error(
      [] {
        check_mesh(with_second(CellType::tet4, {1, 2, 0, 3}, {}), "bar");
      },
      {"mesh of 'bar': cell 1 (tet4) at (0.25, 0.25, 0.25) m repeats cell 0 (tet4)"});
  expect_input_error(
      [] {
        check_mesh(with_second(CellType::tet4, {0, 1, 2, 4}, {{0.1, 0.1, 2}}), "bar");
      },
      {"cells 0 (tet4) and 1 (tet4)", "lie on the same side of the facet that they share"});
  const std::vector<Vec3> middles = {{0, 0, -1},  {0, .5, 0},   {.5, .5, 0}, {.5, 0, 0},
                                     {0, 0, -.5}, {0, .5, -.5}, {.5, 0, -.5}};
  expect_input_error(
      [&] {
        check_mesh(with_second(CellType::tet10, {0, 2, 1, 4, 5, 6, 7, 8, 9, 10}, middles), "bar");
      },
      {"cells 0 (tet4) and 0 (tet10)", "share the corners of a facet but not its other nodes", "the same order"});
}

// Facets of the boundary that lie on others: nodes that were not merged, a diagonal, nodes in the middle of a facet.
TEST(Mesh, with_a_seam_is_told_its_area) {
  const auto stacked = [](const std::array<int, 3>& upper_cells, CellType upper) {
    Mesh mesh = *box_mesh({0, 0, 0}, {2, 2, 1}, {2, 2, 1});
    const MeshPtr other = box_mesh({0, 0, 1}, {2, 2, 1}, upper_cells, upper);
    const int n = mesh.n_nodes();
    mesh.nodes.conservativeResize(3, n + other->n_nodes());
    mesh.nodes.rightCols(other->n_nodes()) = other->nodes;
    CellBlock block = other->blocks[0];
    for (int& node : block.nodes) node += n;
    mesh.blocks.push_back(block);
    return mesh;
  };
  EXPECT_FALSE(find_seam(*box_mesh({0, 0, 0}, {2, 2, 1}, {4, 4, 4}, CellType::tet10), {}));
  for (const auto& [cells, type] : {std::pair{std::array{2, 2, 1}, CellType::hex8},
                                    {std::array{3, 1, 1}, CellType::hex8},
                                    {std::array{2, 2, 1}, CellType::tet4}}) {
    const Mesh mesh = stacked(cells, type);
    const std::optional<Seam> seam = find_seam(mesh, {});
    ASSERT_TRUE(seam);
    EXPECT_NEAR(seam->area, 4.0, 1e-12);
    EXPECT_FALSE(seam->is_overlap);
    EXPECT_NEAR(seam->place[2], 1.0, 1e-12);
    const std::vector<LoosePiece> pieces = loose_pieces(mesh);
    ASSERT_EQ(pieces.size(), 2u);
    EXPECT_NEAR(volume(pieces[0].mesh), 4.0, 1e-12);
    EXPECT_NEAR(volume(pieces[1].mesh), 4.0, 1e-12);
  }
  Mesh twice = *box_mesh({0, 0, 0}, {2, 2, 1}, {2, 2, 1});  // once more with nodes of its own
  CellBlock again = twice.blocks[0];
  for (int& node : again.nodes) node += twice.n_nodes();
  twice.nodes = (Points(3, 36) << twice.nodes, twice.nodes).finished();
  twice.blocks.push_back(again);
  ASSERT_TRUE(find_seam(twice, {}));
  EXPECT_TRUE(find_seam(twice, {})->is_overlap);
}

// Both sides of a wedge face away from each other.
TEST(Mesh, as_thin_as_a_blade_has_no_seam) {
  Points x(3, 6);
  x << 0, 1, 1, 0, 1, 1, 0, -1e-4, 1e-4, 0, -1e-4, 1e-4, 0, 0, 0, 1, 1, 1;
  EXPECT_FALSE(find_seam(one_cell(CellType::prism6, x), {}));
}

TEST(Mesh, has_a_digest_that_changes_with_nodes_cells_and_faces) {
  const MeshPtr box = box_mesh({0, 0, 0}, {1, 1, 1}, {2, 2, 2});
  EXPECT_EQ(box->digest, box_mesh({0, 0, 0}, {1, 1, 1}, {2, 2, 2})->digest);
  EXPECT_EQ(box->digest.size(), 16u);
  Mesh moved = *box, turned = *box, renamed = *box;
  moved.nodes(0, 0) += 1e-15;
  std::swap(turned.blocks[0].nodes[0], turned.blocks[0].nodes[1]);
  auto face = renamed.faces.extract("xmin");
  face.key() = "left";
  renamed.faces.insert(std::move(face));
  for (const Mesh* other : {&moved, &turned, &renamed}) EXPECT_NE(mesh_digest(*other), box->digest);
}

TEST(FaceNodes, share_the_area_of_a_face_with_unit_outward_normals) {
  const MeshPtr box = box_mesh({0, 0, 0}, {2, 3, 1}, {2, 3, 1});
  const FaceNodes top = face_nodes(*box, box->faces.at("zmax"));
  EXPECT_EQ(top.nodes.size(), 12u);
  EXPECT_NEAR(top.areas.sum(), 6.0, 1e-14);
  EXPECT_NEAR(top.areas.minCoeff(), 0.25, 1e-15);
  EXPECT_NEAR(top.areas.maxCoeff(), 1.0, 1e-15);
  for (int i = 0; i < top.normals.cols(); ++i) EXPECT_TRUE(top.normals.col(i).isApprox(Vec3::UnitZ()));
}

TEST(FaceNodes, of_a_skewed_quadrangle_share_it_as_the_shape_functions_do) {
  // A trapezium with parallel sides 2 (below) and 1 (above), height 1: the integral of N_a by hand.
  Mesh mesh;
  mesh.nodes.resize(3, 4);
  mesh.nodes << 0, 2, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0;
  const FaceNodes nodes = face_nodes(mesh, {Facet{FacetType::quad4, {0, 1, 2, 3}}});
  EXPECT_NEAR(nodes.areas.sum(), 1.5, 1e-15);
  EXPECT_NEAR(nodes.areas[0], 5.0 / 12, 1e-15);
  EXPECT_NEAR(nodes.areas[1], 5.0 / 12, 1e-15);
  EXPECT_NEAR(nodes.areas[2], 1.0 / 3, 1e-15);
  EXPECT_NEAR(nodes.areas[3], 1.0 / 3, 1e-15);
}

}  // namespace
}  // namespace dygita
