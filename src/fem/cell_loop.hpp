// Sums over the cells that end at nodes, in parallel, with the same result for any number of threads.
#pragma once

#include <omp.h>

#include <algorithm>
#include <exception>
#include <vector>

#include "fem/cells.hpp"

namespace dygita {

// Coordinates, or any other vector by node, of the nodes of a cell.
template <int n>
Nodes<n> gather(const Points& values, const int* nodes) {
  Nodes<n> gathered;
  for (int a = 0; a < n; ++a) gathered.col(a) = values.col(nodes[a]);
  return gathered;
}

// Computes `Result` of every cell of the block, and adds it at the nodes.
//   compute(first, last, results): fills results[0 .. last - first) of cells first .. last - 1; any thread.
//   add(i_cell, a, result): adds the share of local node a, writing only what belongs to that node; always in the order
//   of the cells, by one thread for each node: this is what makes the sums reproducible.
// What `compute` throws is thrown again, once all threads are back.
template <class Result, class Compute, class Add>
void sum_at_nodes(const CellBlock& block, Compute&& compute, Add&& add) {
  constexpr int chunk = 32, batch = 8 * chunk;
  const int n_cells = block.n_cells(), n_local = nodes_per_cell(block.type);
  std::vector<Result> results(std::min(batch, n_cells));
  std::exception_ptr error;

#pragma omp parallel
  for (int start = 0; start < n_cells; start += batch) {
    const int end = std::min(start + batch, n_cells);
#pragma omp for schedule(static)
    for (int first = start; first < end; first += chunk) try {
        compute(first, std::min(first + chunk, end), results.data() + (first - start));
      } catch (...) {
#pragma omp critical(sum_at_nodes_error)
        error = std::current_exception();
      }
    // Stripes of 64 nodes, so that two threads seldom write near one another.
    const int n_threads = omp_get_num_threads(), thread = omp_get_thread_num();
    for (int i = start; i < end; ++i)
      for (int a = 0; a < n_local; ++a)
        if (block.cell(i)[a] / 64 % n_threads == thread) add(i, a, results[i - start]);
#pragma omp barrier
  }
  if (error) std::rethrow_exception(error);
}

}  // namespace dygita
