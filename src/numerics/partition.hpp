// Parts of a graph of about the same weight with few edges between them (METIS).
#pragma once

#include <mutex>
#include <vector>

namespace dygita {

// Neighbours of vertex i: neighbours[starts[i]] .. neighbours[starts[i + 1] - 1]; each edge is listed at both its ends.
struct Graph {
  std::vector<int> starts{0}, neighbours;
  std::vector<int> edge_weights;  // of each of the neighbours; empty: all are equal

  int n_vertices() const { return static_cast<int>(starts.size()) - 1; }
};

// Part (0 .. n_parts - 1) of each vertex, the same at each call; some part may be empty. is_connected: the graph is,
// and then so are the parts.
std::vector<int> partition(const Graph& graph, const std::vector<int>& weights, int n_parts, bool is_connected);

// METIS draws from the C library's one random sequence, seeded at each call: side by side, two calls would mix theirs.
std::mutex& metis_mutex();

}  // namespace dygita
