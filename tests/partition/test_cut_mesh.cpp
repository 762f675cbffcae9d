#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "intake/gmsh_reader.hpp"
#include "mesh/box.hpp"
#include "partition/cut_mesh.hpp"

namespace dygita {
namespace {

// Cells of a mesh as sorted lists of their nodes' places in the whole mesh.
std::multiset<std::vector<int>> cells_of(const Mesh& mesh, const std::vector<int>* node_of = nullptr) {
  std::multiset<std::vector<int>> cells;
  for (const CellBlock& block : mesh.blocks)
    for (int i = 0; i < block.n_cells(); ++i) {
      std::vector<int> nodes(block.cell(i), block.cell(i) + nodes_per_cell(block.type));
      if (node_of)
        for (int& node : nodes) node = (*node_of)[node];
      nodes.push_back(static_cast<int>(block.type));
      cells.insert(nodes);
    }
  return cells;
}

// Through facets, from the first cell.
bool is_connected(const Mesh& mesh) {
  const std::vector<int> lumps = lump_of_cells(mesh);
  return *std::max_element(lumps.begin(), lumps.end()) == 0;
}

std::vector<MeshPtr> meshes() {
  const std::string file = std::string(DYGITA_SOURCE_DIR) + "/meshes/bar.geo";
  return {box_mesh(Vec3::Zero(), {3, 2, 1}, {12, 8, 5}),
          GmshMeshes({file, {{"n", 40.0}, {"cells", 1.0}}, {}, 1.0}).volume("bar"),
          GmshMeshes({file, {{"n", 40.0}, {"cells", 0.0}}, {}, 1.0}).volume("bar")};
}

TEST(CutMesh, every_cell_is_in_one_piece_and_each_piece_is_connected) {
  for (const MeshPtr& mesh : meshes())
    for (const int n : {2, 3, 8}) {
      const std::vector<MeshPiece> pieces = cut_mesh(*mesh, piece_of_cells(*mesh, n));
      EXPECT_EQ(static_cast<int>(pieces.size()), n);
      std::multiset<std::vector<int>> cells;
      double sum = 0.0, area = 0.0;
      int smallest = mesh->n_cells(), largest = 0;
      for (const MeshPiece& piece : pieces) {
        EXPECT_NO_THROW(check_mesh(*piece.mesh, "piece"));
        EXPECT_TRUE(is_connected(*piece.mesh));
        EXPECT_TRUE(std::is_sorted(piece.nodes.begin(), piece.nodes.end()));
        for (int i = 0; i < piece.mesh->n_nodes(); ++i)
          EXPECT_EQ(Vec3(piece.mesh->nodes.col(i)), Vec3(mesh->nodes.col(piece.nodes[i])));
        cells.merge(cells_of(*piece.mesh, &piece.nodes));
        sum += volume(*piece.mesh);
        area += piece.cut_areas.sum();
        smallest = std::min(smallest, piece.mesh->n_cells());
        largest = std::max(largest, piece.mesh->n_cells());
      }
      EXPECT_EQ(cells, cells_of(*mesh));
      EXPECT_NEAR(sum, volume(*mesh), 1e-12 * volume(*mesh));
      EXPECT_GT(area, 0.0);
      EXPECT_LT(largest, 1.5 * smallest + 2);
    }
}

TEST(CutMesh, the_cut_of_a_bar_into_halves_has_the_area_of_its_section) {
  const MeshPtr bar = box_mesh(Vec3::Zero(), {8, 1, 1}, {16, 2, 2});
  const std::vector<MeshPiece> halves = cut_mesh(*bar, piece_of_cells(*bar, 2));
  for (const MeshPiece& half : halves) EXPECT_NEAR(half.cut_areas.sum(), 1.0, 1e-12);
}

TEST(CutMesh, is_the_same_each_time) {
  const MeshPtr box = box_mesh(Vec3::Zero(), Vec3::Ones(), {9, 9, 9});
  EXPECT_EQ(piece_of_cells(*box, 7), piece_of_cells(*box, 7));
}

TEST(CutMesh, lumps_that_touch_nowhere_are_pieces_of_their_own) {
  Mesh two = *box_mesh(Vec3::Zero(), Vec3::Ones(), {4, 4, 4});
  const int n = two.n_nodes();
  two.nodes.conservativeResize(3, 2 * n);
  two.nodes.rightCols(n) = two.nodes.leftCols(n).colwise() + Vec3(5, 0, 0);
  const std::vector<int> cells = two.blocks[0].nodes;
  for (const int node : cells) two.blocks[0].nodes.push_back(node + n);
  for (const MeshPiece& piece : cut_mesh(two, piece_of_cells(two, 3))) EXPECT_TRUE(is_connected(*piece.mesh));
}

TEST(CutMesh, no_more_pieces_than_cells) {
  const MeshPtr box = box_mesh(Vec3::Zero(), Vec3::Ones(), {2, 2, 1});
  const std::vector<int> piece = piece_of_cells(*box, 100);
  EXPECT_LE(*std::max_element(piece.begin(), piece.end()), 3);
}

}  // namespace
}  // namespace dygita
