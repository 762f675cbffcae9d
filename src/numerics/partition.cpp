#include "numerics/partition.hpp"

#include <metis.h>

#include "base/error.hpp"

namespace dygita {

std::mutex& metis_mutex() {
  static std::mutex mutex;
  return mutex;
}

std::vector<int> partition(const Graph& graph, const std::vector<int>& weights, int n_parts, bool is_connected) {
  CHECK(static_cast<int>(weights.size()) == graph.n_vertices(), "one weight a vertex");
  std::vector<int> part(weights.size(), 0);
  if (n_parts < 2 || part.empty()) return part;
  std::vector<idx_t> starts(graph.starts.begin(), graph.starts.end());
  std::vector<idx_t> neighbours(graph.neighbours.begin(), graph.neighbours.end());
  std::vector<idx_t> vertex_weights(weights.begin(), weights.end()), found(weights.size());
  std::vector<idx_t> edge_weights(graph.edge_weights.begin(), graph.edge_weights.end());
  idx_t n = graph.n_vertices(), n_constraints = 1, parts = n_parts, n_cut = 0;
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_CONTIG] = is_connected ? 1 : 0;
  options[METIS_OPTION_NCUTS] = 4;  // the best of several: a shorter cut is paid back at every step
  const std::scoped_lock lock(metis_mutex());
  const int status = METIS_PartGraphKway(&n, &n_constraints, starts.data(), neighbours.data(), vertex_weights.data(),
                                         nullptr, edge_weights.empty() ? nullptr : edge_weights.data(), &parts, nullptr,
                                         nullptr, options, &n_cut, found.data());
  CHECK(status == METIS_OK, "METIS could not cut the graph");
  part.assign(found.begin(), found.end());
  return part;
}

}  // namespace dygita
