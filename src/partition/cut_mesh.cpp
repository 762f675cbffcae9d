#include "partition/cut_mesh.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <unordered_map>
#include <unordered_set>

#include "base/error.hpp"
#include "base/fnv1a.hpp"
#include "mesh/face_nodes.hpp"
#include "numerics/partition.hpp"

namespace dygita {

namespace {

// Cells that share a facet.
Graph graph_of_cells(const Mesh& mesh) {
  std::unordered_map<FacetKey, int, FacetKeyHash> first_cell;
  std::vector<std::pair<int, int>> pairs;
  int cell = 0;
  for (const CellBlock& block : mesh.blocks)
    for (int i = 0; i < block.n_cells(); ++i, ++cell)
      for (int k = 0; k < facets_per_cell(block.type); ++k) {
        const auto [at, is_new] = first_cell.try_emplace(facet_key(facet_of_cell(block, i, k)), cell);
        if (!is_new) pairs.emplace_back(at->second, cell);
      }
  Graph graph;
  graph.starts.assign(cell + 1, 0);
  for (const auto& [a, b] : pairs) ++graph.starts[a + 1], ++graph.starts[b + 1];
  for (int i = 0; i < cell; ++i) graph.starts[i + 1] += graph.starts[i];
  graph.neighbours.resize(2 * pairs.size());
  std::vector<int> next(graph.starts.begin(), graph.starts.end() - 1);
  for (const auto& [a, b] : pairs) {
    graph.neighbours[next[a]++] = b;
    graph.neighbours[next[b]++] = a;
  }
  return graph;
}

// Connected cells of one piece: number of each cell's lump, and the lumps' sizes.
std::pair<std::vector<int>, std::vector<int>> lumps_of(const Graph& graph, const std::vector<int>& piece) {
  std::vector<int> lump(piece.size(), -1), sizes, stack;
  for (int seed = 0; seed < graph.n_vertices(); ++seed) {
    if (lump[seed] >= 0) continue;
    const int number = static_cast<int>(sizes.size());
    sizes.push_back(0);
    lump[seed] = number;
    stack.push_back(seed);
    while (!stack.empty()) {
      const int cell = stack.back();
      stack.pop_back();
      ++sizes[number];
      for (int e = graph.starts[cell]; e < graph.starts[cell + 1]; ++e)
        if (const int other = graph.neighbours[e]; lump[other] < 0 && piece[other] == piece[cell]) {
          lump[other] = number;
          stack.push_back(other);
        }
    }
  }
  return {std::move(lump), std::move(sizes)};
}

// The largest lump of each piece stays; another joins the piece it shares most facets with, or becomes one.
void join_fragments(const Graph& graph, std::vector<int>& piece, int n_pieces) {
  const auto [lump, sizes] = lumps_of(graph, piece);
  std::vector<int> largest(n_pieces, -1), piece_of_lump(sizes.size(), -1);
  for (size_t cell = 0; cell < piece.size(); ++cell)
    if (int& now = largest[piece[cell]]; now < 0 || sizes[lump[cell]] > sizes[now]) now = lump[cell];
  size_t n_left = sizes.size();
  for (int p = 0; p < n_pieces; ++p)
    if (largest[p] >= 0) {
      piece_of_lump[largest[p]] = p;
      --n_left;
    }
  while (n_left > 0) {
    std::vector<std::map<int, int>> n_shared(sizes.size());
    for (int cell = 0; cell < graph.n_vertices(); ++cell)
      for (int e = graph.starts[cell]; e < graph.starts[cell + 1] && piece_of_lump[lump[cell]] < 0; ++e)
        if (const int other = piece_of_lump[lump[graph.neighbours[e]]]; other >= 0) ++n_shared[lump[cell]][other];
    const size_t before = n_left;
    for (size_t l = 0; l < sizes.size(); ++l) {
      if (piece_of_lump[l] >= 0 || n_shared[l].empty()) continue;
      piece_of_lump[l] = std::max_element(n_shared[l].begin(), n_shared[l].end(), [](const auto& a, const auto& b) {
                           return a.second < b.second;
                         })->first;
      --n_left;
    }
    if (n_left < before) continue;
    piece_of_lump[std::find(piece_of_lump.begin(), piece_of_lump.end(), -1) - piece_of_lump.begin()] = n_pieces++;
    --n_left;
  }
  for (size_t cell = 0; cell < piece.size(); ++cell) piece[cell] = piece_of_lump[lump[cell]];
}

void number_without_gaps(std::vector<int>& piece) {
  std::vector<int> used = piece;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (int& p : piece) p = static_cast<int>(std::lower_bound(used.begin(), used.end(), p) - used.begin());
}

}  // namespace

namespace {

// One vertex for the cells that stay together: its number for each cell; others have their own.
std::vector<int> vertex_of_cells(const Mesh& mesh, const std::vector<std::vector<int>>& together) {
  std::vector<int> parent(mesh.n_cells());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const std::vector<int>& set : together) {
    std::vector<char> is_in_set(mesh.n_nodes(), 0);
    for (const int node : set) is_in_set[node] = 1;
    int cell = 0, first = -1;
    for (const CellBlock& block : mesh.blocks)
      for (int i = 0; i < block.n_cells(); ++i, ++cell) {
        const int* nodes = block.cell(i);
        if (std::none_of(nodes, nodes + nodes_per_cell(block.type), [&](int node) { return is_in_set[node] != 0; }))
          continue;
        if (first < 0) first = cell;
        parent[root(cell)] = root(first);
      }
  }
  for (int i = 0; i < mesh.n_cells(); ++i) parent[i] = root(i);
  return parent;
}

// The graph with the cells of one vertex contracted, and the vertex of each cell in it.
std::pair<Graph, std::vector<int>> contracted(const Graph& graph, std::vector<int> vertex) {
  number_without_gaps(vertex);
  const int n = 1 + *std::max_element(vertex.begin(), vertex.end());
  std::vector<std::vector<int>> neighbours(n);
  for (int cell = 0; cell < graph.n_vertices(); ++cell)
    for (int e = graph.starts[cell]; e < graph.starts[cell + 1]; ++e)
      if (const int other = vertex[graph.neighbours[e]]; other != vertex[cell])
        neighbours[vertex[cell]].push_back(other);
  Graph result;
  for (std::vector<int>& own : neighbours) {
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    result.neighbours.insert(result.neighbours.end(), own.begin(), own.end());
    result.starts.push_back(static_cast<int>(result.neighbours.size()));
  }
  return {std::move(result), std::move(vertex)};
}

// All cells in one piece, where too many of them must stay together or they do not.
bool is_whole(const std::vector<int>& vertex, const std::vector<int>& piece) {
  std::map<int, int> n_cells, piece_of;
  for (size_t cell = 0; cell < vertex.size(); ++cell) {
    if (4 * static_cast<size_t>(++n_cells[vertex[cell]]) > vertex.size() && n_cells[vertex[cell]] > 1) return true;
    if (!piece.empty() && piece_of.emplace(vertex[cell], piece[cell]).first->second != piece[cell]) return true;
  }
  return false;
}

// Of the same nodes of equal meshes: cells go with them.
std::string shape_of_piece(const Mesh& whole, const std::vector<int>& nodes) {
  Fnv1a digest;
  digest.add(whole.shape_digest());
  digest.add(nodes.data(), nodes.size() * sizeof(int));
  return digest.hexadecimal();
}

}  // namespace

std::vector<int> piece_of_cells(const Mesh& mesh, int n_pieces, const std::vector<std::vector<int>>& together) {
  const int n_cells = mesh.n_cells();
  n_pieces = std::min(n_pieces, n_cells);
  if (n_pieces < 2) return std::vector<int>(n_cells, 0);
  const Graph graph = graph_of_cells(mesh);
  std::vector<int> weights;
  for (const CellBlock& block : mesh.blocks)
    weights.insert(weights.end(), block.n_cells(), cell_shape(block.type).weight);
  const bool is_connected = lumps_of(graph, std::vector<int>(n_cells, 0)).second.size() == 1;
  std::vector<int> piece;
  if (together.empty()) {
    piece = partition(graph, weights, n_pieces, is_connected);
  } else {
    const std::vector<int> kept_together = vertex_of_cells(mesh, together);
    if (is_whole(kept_together, {})) return std::vector<int>(n_cells, 0);
    const auto [small, vertex] = contracted(graph, kept_together);
    std::vector<int> sums(small.n_vertices(), 0);
    for (int cell = 0; cell < n_cells; ++cell) sums[vertex[cell]] += weights[cell];
    const std::vector<int> of_vertices = partition(small, sums, n_pieces, is_connected);
    for (const int v : vertex) piece.push_back(of_vertices[v]);
  }
  join_fragments(graph, piece, n_pieces);
  if (!together.empty() && is_whole(vertex_of_cells(mesh, together), piece)) return std::vector<int>(n_cells, 0);
  number_without_gaps(piece);
  return piece;
}

std::vector<int> lump_of_cells(const Mesh& mesh) {
  return lumps_of(graph_of_cells(mesh), std::vector<int>(mesh.n_cells(), 0)).first;
}

std::vector<MeshPiece> cut_mesh(const Mesh& mesh, const std::vector<int>& piece_of_cell) {
  CHECK(static_cast<int>(piece_of_cell.size()) == mesh.n_cells(), "one piece a cell");
  const int n = 1 + *std::max_element(piece_of_cell.begin(), piece_of_cell.end());
  std::vector<std::vector<CellBlock>> blocks(n);
  int cell = 0;
  for (const CellBlock& block : mesh.blocks) {
    std::vector<CellBlock> own(n, CellBlock{block.type, {}});
    const int n_nodes = nodes_per_cell(block.type);
    for (int i = 0; i < block.n_cells(); ++i, ++cell) {
      std::vector<int>& nodes = own[piece_of_cell[cell]].nodes;
      nodes.insert(nodes.end(), block.cell(i), block.cell(i) + n_nodes);
      if (!block.axes.empty()) own[piece_of_cell[cell]].axes.push_back(block.axes[static_cast<size_t>(i)]);
    }
    for (int p = 0; p < n; ++p)
      if (own[p].n_cells() > 0) blocks[p].push_back(std::move(own[p]));
  }
  std::unordered_set<FacetKey, FacetKeyHash> outside;
  for (const Facet& facet : boundary_facets(mesh.blocks)) outside.insert(facet_key(facet));

  std::vector<MeshPiece> pieces;
  std::vector<int> local(mesh.n_nodes());
  for (int p = 0; p < n; ++p) {
    MeshPiece piece;
    for (const CellBlock& block : blocks[p])
      piece.nodes.insert(piece.nodes.end(), block.nodes.begin(), block.nodes.end());
    std::sort(piece.nodes.begin(), piece.nodes.end());
    piece.nodes.erase(std::unique(piece.nodes.begin(), piece.nodes.end()), piece.nodes.end());
    const int n_nodes = static_cast<int>(piece.nodes.size());
    for (int i = 0; i < n_nodes; ++i) local[piece.nodes[i]] = i;
    std::vector<Facet> cut;
    for (const Facet& facet : boundary_facets(blocks[p]))
      if (!outside.contains(facet_key(facet))) cut.push_back(facet);
    const FaceNodes on_cut = face_nodes(mesh, cut);
    piece.cut_areas = Vec::Zero(n_nodes);
    for (size_t i = 0; i < on_cut.nodes.size(); ++i)
      piece.cut_areas[local[on_cut.nodes[i]]] = on_cut.areas[static_cast<Eigen::Index>(i)];

    auto own = std::make_shared<Mesh>();
    own->source = mesh.source;
    own->nodes.resize(3, n_nodes);
    for (int i = 0; i < n_nodes; ++i) own->nodes.col(i) = mesh.nodes.col(piece.nodes[i]);
    own->blocks = std::move(blocks[p]);
    for (CellBlock& block : own->blocks)
      for (int& node : block.nodes) node = local[node];
    own->digest = mesh_digest(*own);
    own->shape = shape_of_piece(mesh, piece.nodes);
    own->turn = mesh.turn;
    own->shift = mesh.shift;
    piece.mesh = std::move(own);
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

}  // namespace dygita
