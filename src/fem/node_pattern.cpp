#include "fem/node_pattern.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <limits>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "numerics/huge_pages.hpp"

namespace dygita {

namespace {

// Cells of each node, as pointers to their nodes.
struct CellsOfNodes {
  struct Cell {
    const int* nodes;
    int n_nodes;
    std::uint16_t* slots;  // of the node in this cell; null where not asked for
  };
  std::vector<int> starts;
  std::vector<Cell> cells;
};

CellsOfNodes cells_of_nodes(const Mesh& mesh, CellSlots* slots) {
  CellsOfNodes of;
  of.starts.assign(mesh.n_nodes() + 1, 0);
  for (const CellBlock& block : mesh.blocks)
    for (const int node : block.nodes) ++of.starts[node + 1];
  for (int a = 0; a < mesh.n_nodes(); ++a) of.starts[a + 1] += of.starts[a];

  of.cells.resize(of.starts.back());
  std::vector<int> next(of.starts.begin(), of.starts.end() - 1);
  for (size_t k = 0; k < mesh.blocks.size(); ++k) {
    const CellBlock& block = mesh.blocks[k];
    const int n_local = nodes_per_cell(block.type);
    for (int i = 0; i < block.n_cells(); ++i)
      for (int a = 0; a < n_local; ++a) {
        std::uint16_t* const own =
            slots ? slots->of_block[k].data() + (static_cast<size_t>(i) * n_local + a) * n_local : nullptr;
        of.cells[next[block.cell(i)[a]]++] = {block.cell(i), n_local, own};
      }
  }
  return of;
}

}  // namespace

NodePattern node_pattern(const Mesh& mesh, CellSlots* slots) {
  if (slots) {
    slots->of_block.clear();
    for (const CellBlock& block : mesh.blocks)
      slots->of_block.emplace_back(block.nodes.size() * nodes_per_cell(block.type));
  }
  const CellsOfNodes of = cells_of_nodes(mesh, slots);
  NodePattern pattern;
  pattern.starts.reserve(mesh.n_nodes() + 1);
  pattern.starts.push_back(0);
  pattern.neighbours.reserve(static_cast<size_t>(27) * mesh.n_nodes());

  std::vector<int> seen_by(mesh.n_nodes(), -1), place(mesh.n_nodes());
  for (int a = 0; a < mesh.n_nodes(); ++a) {
    const size_t first = pattern.neighbours.size();
    for (int i = of.starts[a]; i < of.starts[a + 1]; ++i)
      for (int b = 0; b < of.cells[i].n_nodes; ++b) {
        const int node = of.cells[i].nodes[b];
        if (seen_by[node] == a) continue;
        seen_by[node] = a;
        pattern.neighbours.push_back(node);
      }
    std::sort(pattern.neighbours.begin() + static_cast<std::ptrdiff_t>(first), pattern.neighbours.end());
    if (pattern.neighbours.size() > std::numeric_limits<int>::max() / 9)
      throw InputError(fmt::format(
          "mesh {}: {} nodes exceed the limit of one substructure: its matrix would have more than 2^31 entries\n"
          "    divide it into several substructures (of at most about 8 million nodes each)",
          mesh.source, mesh.n_nodes()));
    pattern.starts.push_back(static_cast<int>(pattern.neighbours.size()));
    if (!slots) continue;
    if (pattern.neighbours.size() - first > std::numeric_limits<std::uint16_t>::max())
      throw InputError(
          fmt::format("mesh {}: node {} has {} neighbours", mesh.source, a, pattern.neighbours.size() - first));
    for (size_t k = first; k < pattern.neighbours.size(); ++k)
      place[pattern.neighbours[k]] = static_cast<int>(k - first);
    for (int i = of.starts[a]; i < of.starts[a + 1]; ++i)
      for (int b = 0; b < of.cells[i].n_nodes; ++b)
        of.cells[i].slots[b] = static_cast<std::uint16_t>(place[of.cells[i].nodes[b]]);
  }
  return pattern;
}

SparseMatrix block_matrix(const NodePattern& pattern, SparseMatrix* memory) {
  const int n = pattern.n_nodes();
  const auto n_entries = static_cast<Eigen::Index>(9 * pattern.neighbours.size());
  SparseMatrix matrix;
  if (memory) matrix.swap(*memory);
  matrix.resize(3 * n, 3 * n);
  matrix.resizeNonZeros(n_entries);
  prefer_huge_pages(matrix.valuePtr(), n_entries * sizeof(double));
  prefer_huge_pages(matrix.innerIndexPtr(), n_entries * sizeof(int));
  int* rows = matrix.outerIndexPtr();
  rows[0] = 0;

  const auto fill = [&](int a) {
    const int first = pattern.starts[a], count = pattern.starts[a + 1] - first;
    int* column = matrix.innerIndexPtr() + 9 * first;
    for (int i = 0; i < 3; ++i) {
      rows[3 * a + i + 1] = 9 * first + 3 * (i + 1) * count;
      for (int k = 0; k < count; ++k)
        for (int j = 0; j < 3; ++j) *column++ = 3 * pattern.neighbours[first + k] + j;
    }
  };
  parallel_for(n, fill, Schedule::evenly);
  return matrix;
}

}  // namespace dygita
