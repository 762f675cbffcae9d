// Sums over the cells that end at nodes, in parallel, with the same result for any number of threads.
#pragma once

#include <algorithm>
#include <mutex>
#include <vector>

#include "base/parallel.hpp"
#include "fem/cells.hpp"
#include "mesh/mesh.hpp"

namespace dygita {

// Coordinates, or any other vector by node, of the nodes of a cell.
template <int n>
Nodes<n> gather(const Points& values, const int* nodes) {
  Nodes<n> gathered;
  for (int a = 0; a < n; ++a) gathered.col(a) = values.col(nodes[a]);
  return gathered;
}

// Who sums at each node: slabs of the mesh across its longest extent, so that few cells touch two owners.
struct NodeOwners {
  int n_owners = 1;
  std::vector<unsigned char> owner;  // of each node

  // Has an owner any of these nodes?
  bool has_part_of(int who, const int* nodes, int n) const {
    return std::any_of(nodes, nodes + n, [&](int node) { return owner[static_cast<size_t>(node)] == who; });
  }
};

// As many owners as threads, fewer for a small mesh, one inside a parallel region.
NodeOwners node_owners(const Mesh& mesh);

// Runs `kernel` on all cells of the block, a copy of it for each owner:
//   kernel.begin(owner)            where it has that: before its first cell;
//   kernel.compute(nodes, i_cell)  computes a cell; called by every owner that has a node of it;
//   kernel.add(nodes, a)           adds the share of local node a of the computed cell, writing nothing but that
//   node's; kernel.finish()                hands over what is not by node; one owner at a time, in no order.
// One owner adds at a node, in the order of the cells: the sums do not depend on the number of owners. The owners never
// wait for one another before the end: on a busy machine waiting costs more than the cells computed twice.
// What a kernel throws is thrown again, once all owners are back.
template <class Kernel>
void sum_at_nodes(const CellBlock& block, const NodeOwners& owners, const Kernel& kernel) {
  const int n_cells = block.n_cells(), n_local = nodes_per_cell(block.type);
  std::mutex one_at_a_time;
  parallel_for(
      owners.n_owners,
      [&](int owner) {
        Kernel mine = kernel;
        if constexpr (requires { mine.begin(owner); }) mine.begin(owner);
        for (int i = 0; i < n_cells; ++i) {
          const int* nodes = block.cell(i);
          bool is_computed = false;
          for (int a = 0; a < n_local; ++a) {
            if (owners.owner[nodes[a]] != owner) continue;
            if (!is_computed) mine.compute(nodes, i);
            is_computed = true;
            mine.add(nodes, a);
          }
        }
        const std::scoped_lock lock(one_at_a_time);
        mine.finish();
      },
      Schedule::evenly, owners.n_owners);
}

}  // namespace dygita
