#include "numerics/partition.hpp"

#include <metis.h>

#include <memory>

#include "base/aside.hpp"
#include "base/error.hpp"

namespace dygita {

namespace {

struct Parting {
  std::vector<idx_t> starts, neighbours, vertex_weights, edge_weights, found;
  idx_t n_parts = 0;
  bool is_connected = false;
  int status = METIS_OK;

  void find() {
    idx_t n = static_cast<idx_t>(found.size()), n_constraints = 1, n_cut = 0;
    idx_t options[METIS_NOPTIONS];
    METIS_SetDefaultOptions(options);
    options[METIS_OPTION_SEED] = 1;
    options[METIS_OPTION_CONTIG] = is_connected ? 1 : 0;
    options[METIS_OPTION_NCUTS] = 4;  // the best of several: a shorter cut is paid back at every step
    const std::scoped_lock lock(metis_mutex());
    status = METIS_PartGraphKway(&n, &n_constraints, starts.data(), neighbours.data(), vertex_weights.data(), nullptr,
                                 edge_weights.empty() ? nullptr : edge_weights.data(), &n_parts, nullptr, nullptr,
                                 options, &n_cut, found.data());
  }
};

}  // namespace

std::mutex& metis_mutex() {
  static std::mutex mutex;
  return mutex;
}

std::vector<int> partition(const Graph& graph, const std::vector<int>& weights, int n_parts, bool is_connected) {
  CHECK(static_cast<int>(weights.size()) == graph.n_vertices(), "one weight a vertex");
  if (n_parts < 2 || weights.empty()) return std::vector<int>(weights.size(), 0);
  const auto own = std::make_shared<Parting>();
  own->starts.assign(graph.starts.begin(), graph.starts.end());
  own->neighbours.assign(graph.neighbours.begin(), graph.neighbours.end());
  own->vertex_weights.assign(weights.begin(), weights.end());
  own->edge_weights.assign(graph.edge_weights.begin(), graph.edge_weights.end());
  own->found.resize(weights.size());
  own->n_parts = n_parts;
  own->is_connected = is_connected;
  constexpr size_t quick = 20000;  // as long as it takes less than a tenth of a second
  if (weights.size() <= quick)
    own->find();
  else
    do_aside([own] { own->find(); });
  CHECK(own->status == METIS_OK, "METIS could not cut the graph");
  return {own->found.begin(), own->found.end()};
}

}  // namespace dygita
