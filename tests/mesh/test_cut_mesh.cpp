// Meshes cut in two: nothing of the body is lost, the new faces match, named faces stay what they were.
#include <gtest/gtest.h>

#include <random>

#include "mesh/box.hpp"
#include "mesh/cut_mesh.hpp"
#include "mesh/expect_input_error.hpp"
#include "mesh/face_nodes.hpp"
#include "mesh/raise_order.hpp"

namespace dygita::test::cut_mesh_tests {
namespace {

// Six tetrahedra a cell; nodes inside moved at random, which leaves the box what it is.
MeshPtr tetrahedra(const Vec3& size, const std::array<int, 3>& cells, double noise) {
  const MeshPtr box = box_mesh(Vec3::Zero(), size, cells, CellType::hex8);
  auto mesh = std::make_shared<Mesh>(*box);
  CellBlock block{CellType::tet4, {}};
  constexpr int of_cell[6][4] = {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
  for (int i = 0; i < box->blocks[0].n_cells(); ++i)
    for (const auto& tet : of_cell)
      for (const int a : tet) block.nodes.push_back(box->blocks[0].cell(i)[a]);
  mesh->blocks = {block};
  mesh->faces.clear();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-noise, noise);
  for (int i = 0; i < mesh->n_nodes(); ++i) {
    const Vec3 x = mesh->nodes.col(i);
    if (x.minCoeff() > 1e-9 && (size - x).minCoeff() > 1e-9)
      mesh->nodes.col(i) += Vec3(any(random), any(random), any(random));
  }
  for (const Facet& facet : boundary_facets(mesh->blocks)) {
    const Vec3 normal = facet_area_vector(mesh->nodes, facet).normalized();
    if (normal[2] > 0.9) mesh->faces["top"].push_back(facet);
    if (normal[0] > 0.9) mesh->faces["side"].push_back(facet);
  }
  mesh->digest = mesh_digest(*mesh);
  return mesh;
}

double area(const Mesh& mesh, const std::string& face) {
  double sum = 0.0;
  if (!mesh.faces.contains(face)) return sum;
  for (const Facet& facet : mesh.faces.at(face)) sum += facet_area_vector(mesh.nodes, facet).norm();
  return sum;
}

// Places of the corners of each facet, in order: the same on both sides.
std::vector<std::vector<std::array<long, 3>>> facets_by_place(const Mesh& mesh, const std::string& face) {
  std::vector<std::vector<std::array<long, 3>>> all;
  for (const Facet& facet : mesh.faces.at(face)) {
    auto& one = all.emplace_back();
    for (const int node : facet.nodes()) {
      const Vec3 x = 1e9 * mesh.nodes.col(node);
      one.push_back({std::lround(x[0]), std::lround(x[1]), std::lround(x[2])});
    }
    std::sort(one.begin(), one.end());
  }
  std::sort(all.begin(), all.end());
  return all;
}

void expect_whole(const Mesh& whole, const MeshCut& cut, const Vec3& normal, double at, double section) {
  const Mesh &one = *cut.halves[0].mesh, &other = *cut.halves[1].mesh;
  EXPECT_NEAR(volume(one) + volume(other), volume(whole), 1e-12 * volume(whole));
  for (const auto& [name, facets] : whole.faces)
    EXPECT_NEAR(area(one, name) + area(other, name), area(whole, name), 1e-12 * area(whole, name)) << name;
  EXPECT_NEAR(area(one, "cut"), section, 1e-9 * section);
  EXPECT_EQ(facets_by_place(one, "cut"), facets_by_place(other, "cut"));
  for (const MeshHalf& half : cut.halves) {
    check_mesh(*half.mesh, "half");
    for (const int node : nodes_of(half.mesh->faces.at("cut")))
      EXPECT_NEAR(normal.dot(half.mesh->nodes.col(node)), at, 1e-12);
    for (size_t i = 0; i < half.nodes.size(); ++i) {
      if (half.nodes[i] < 0) continue;
      const double moved = (half.mesh->nodes.col(static_cast<long>(i)) - whole.nodes.col(half.nodes[i])).norm();
      EXPECT_LT(moved, 0.25 * 0.02);
    }
  }
}

TEST(CutMesh, divides_tetrahedra_at_a_plane_wherever_it_is) {
  const Vec3 size(0.04, 0.04, 0.1);
  for (const double noise : {0.0, 0.002})
    for (const bool is_quadratic : {false, true}) {
      MeshPtr mesh = tetrahedra(size, {3, 3, 6}, noise);
      if (is_quadratic) mesh = second_order(*mesh, SecondOrder::edges_only);
      for (const double at : {0.031, 0.05, 0.0501, 0.0533, 0.058, 0.0667})
        expect_whole(*mesh, cut_by_plane(*mesh, {0, 0, 1}, at, "cut"), {0, 0, 1}, at, 0.0016);
    }
}

TEST(CutMesh, divides_tetrahedra_at_an_oblique_plane) {
  const Vec3 normal = Vec3(0.3, -0.2, 1.0).normalized();
  const double at = normal.dot(Vec3(0.02, 0.02, 0.053));
  for (const bool is_quadratic : {false, true}) {
    MeshPtr mesh = tetrahedra({0.04, 0.04, 0.1}, {3, 3, 6}, 0.002);
    if (is_quadratic) mesh = second_order(*mesh, SecondOrder::edges_only);
    expect_whole(*mesh, cut_by_plane(*mesh, normal, at, "cut"), normal, at, 0.0016 / normal[2]);
  }
}

TEST(CutMesh, leaves_no_slivers_where_nodes_are_near) {
  const MeshPtr mesh = tetrahedra({0.04, 0.04, 0.1}, {3, 3, 6}, 0.0);
  const MeshCut cut = cut_by_plane(*mesh, {0, 0, 1}, 0.0501, "cut");  // nodes at 0.05
  EXPECT_EQ(cut.n_divided, 0);
}

TEST(CutMesh, keeps_hexahedra_whole_and_cuts_at_the_nearest_of_their_facets) {
  for (const CellType type : {CellType::hex8, CellType::hex20}) {
    const MeshPtr mesh = box_mesh(Vec3::Zero(), {0.04, 0.04, 0.1}, {2, 2, 5}, type);
    for (const auto& [asked, at] : {std::pair(0.043, 0.04), {0.0501, 0.06}, {0.04, 0.04}}) {
      const MeshCut cut = cut_by_plane(*mesh, {0, 0, 1}, asked, "cut");
      EXPECT_NEAR(cut.at, at, 1e-12);
      EXPECT_EQ(cut.n_divided, 0);
      expect_whole(*mesh, cut, {0, 0, 1}, at, 0.0016);
    }
  }
}

TEST(CutMesh, refuses_what_no_plane_of_facets_cuts_and_planes_beside_the_body) {
  const MeshPtr mesh = box_mesh(Vec3::Zero(), {0.04, 0.04, 0.1}, {2, 2, 5}, CellType::hex8);
  expect_input_error([&] { cut_by_plane(*mesh, Vec3(0, 1, 1).normalized(), 0.05, "cut"); }, {"no facets in a plane"});
  expect_input_error([&] { cut_by_plane(*mesh, {0, 0, 1}, 0.2, "cut"); }, {"does not cut the mesh", "0 to 0.1 m"});
  expect_input_error([&] { cut_by_plane(*mesh, {0, 0, 1}, 0.05, "zmax"); }, {"has a face 'zmax' already"});
}

TEST(CutMesh, follows_facets_inside_that_are_on_no_plane) {
  const MeshPtr mesh = box_mesh(Vec3::Zero(), {0.04, 0.04, 0.1}, {2, 1, 5}, CellType::hex8);
  // A step: the column at x < 0.02 up to 0.04, the other up to 0.06.
  std::vector<InnerFacet> facets;
  const CellBlock& block = mesh->blocks[0];
  const auto middle = [&](const int* nodes, size_t n) {
    Vec3 sum = Vec3::Zero();
    for (size_t a = 0; a < n; ++a) sum += mesh->nodes.col(nodes[a]) / static_cast<double>(n);
    return sum;
  };
  const auto is_first = [&](int i) {
    const Vec3 x = middle(block.cell(i), 8);
    return x[2] < (x[0] < 0.02 ? 0.04 : 0.06);
  };
  std::map<FacetKey, std::vector<int>> cells;
  for (int i = 0; i < block.n_cells(); ++i)
    for (int k = 0; k < facets_per_cell(block.type); ++k) cells[facet_key(facet_of_cell(block, i, k))].push_back(i);
  for (const auto& [key, both] : cells) {
    if (both.size() != 2 || is_first(both[0]) == is_first(both[1])) continue;
    const int* nodes = block.cell(is_first(both[0]) ? both[0] : both[1]);
    facets.push_back({key, *std::find_if(nodes, nodes + 8,
                                         [&k = key](int n) { return std::find(k.begin(), k.end(), n) == k.end(); })});
  }
  ASSERT_EQ(facets.size(), 3u);
  const MeshCut cut = cut_along(*mesh, facets, "cut");
  EXPECT_NEAR(volume(*cut.halves[0].mesh), 0.04 * 0.02 * 0.1, 1e-12);
  EXPECT_EQ(facets_by_place(*cut.halves[0].mesh, "cut"), facets_by_place(*cut.halves[1].mesh, "cut"));
  facets.pop_back();
  expect_input_error([&] { cut_along(*mesh, facets, "cut"); }, {"does not divide the part"});
}

}  // namespace
}  // namespace dygita::test::cut_mesh_tests
