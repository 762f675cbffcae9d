#include "fem/assembly.hpp"

#include "fem/cell_loop.hpp"
#include "fem/frequency.hpp"
#include "fem/node_pattern.hpp"

namespace dygita {

namespace {

template <class Cell>
struct CellMatrices {
  Stiffness<Cell::n_nodes> stiffness;
  Eigen::Matrix<double, Cell::n_nodes, 1> mass;
};

// Are the cells equal but for a translation, as those of a box are?
template <int n>
bool is_translated(const Nodes<n>& x, const Nodes<n>& y) {
  const Nodes<n> relative_x = x.colwise() - x.col(0), relative_y = y.colwise() - y.col(0);
  return (relative_x - relative_y).cwiseAbs().maxCoeff() <= 1e-12 * relative_x.cwiseAbs().maxCoeff();
}

// Adds the rows of local node `a`: its cell's nodes are a subset of its neighbours, both walked in increasing order.
template <class Cell>
void add_rows(const NodePattern& pattern, const int* nodes, int a, const Stiffness<Cell::n_nodes>& cell,
              double* values) {
  constexpr int n = Cell::n_nodes;
  const int first = pattern.starts[nodes[a]], count = pattern.starts[nodes[a] + 1] - first;
  const int* neighbour = pattern.neighbours.data() + first;
  double* row = values + static_cast<std::ptrdiff_t>(9) * first;

  for (int b = 0; b < n; ++b) {
    const auto slot = std::lower_bound(neighbour, neighbour + count, nodes[b]) - neighbour;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) row[3 * (i * count + slot) + j] += cell(3 * b + j, 3 * a + i);  // cell is symmetric
  }
}

template <class Cell>
void assemble_block(const Mesh& mesh, const CellBlock& block, const Elastic& material, const NodePattern& pattern,
                    BodyMatrices& body) {
  constexpr int n = Cell::n_nodes;
  FrequencyBound highest;

  const auto compute = [&](int first, int last, CellMatrices<Cell>* results) {
    FrequencyBound of_chunk;
#pragma omp critical(assemble_frequency)
    of_chunk = highest;
    Nodes<n> computed;
    for (int i = first; i < last; ++i) {
      const Nodes<n> x = gather<n>(mesh.nodes, block.cell(i));
      CellMatrices<Cell>& result = results[i - first];
      // Chunks do not depend on the number of threads, hence neither does what is reused.
      if (i > first && is_translated<n>(computed, x)) {
        result = results[i - first - 1];
        continue;
      }
      computed = x;
      result.stiffness = Cell::stiffness(x, material);
      result.mass = material.density * node_volumes<Cell>(x);
      of_chunk.see(result.stiffness, result.mass);
    }
#pragma omp critical(assemble_frequency)
    highest.see(of_chunk);
  };
  const auto add = [&](int i, int a, const CellMatrices<Cell>& result) {
    add_rows<Cell>(pattern, block.cell(i), a, result.stiffness, body.stiffness.valuePtr());
    body.mass[block.cell(i)[a]] += result.mass[a];
  };
  sum_at_nodes<CellMatrices<Cell>>(block, compute, add);
  body.max_frequency = std::max(body.max_frequency, highest.frequency());
}

}  // namespace

BodyMatrices assemble(const Mesh& mesh, const Elastic& material) {
  const NodePattern pattern = node_pattern(mesh);
  BodyMatrices body{block_matrix(pattern), Vec::Zero(mesh.n_nodes()), 0.0};
  for (const CellBlock& block : mesh.blocks)
    with_cell(block.type, [&](auto cell) { assemble_block<decltype(cell)>(mesh, block, material, pattern, body); });
  return body;
}

}  // namespace dygita
