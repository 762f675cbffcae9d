#include "solution/share_out.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "numerics/partition.hpp"

namespace dygita {

namespace {

// Bytes that a time step reads of a piece, about: of its nodes, or of its factor where it is implicit
// (integration.cpp).
double cost_of(const Problem& problem, const CutPiece& piece) {
  const double n = 3.0 * piece.body->mesh->n_nodes();
  const bool is_implicit =
      piece.body->integration.value_or(problem.solver.integration) == IntegrationChoice::implicitly;
  return is_implicit ? 25.0 * std::pow(n, 1.5) : 244.0 * n;
}

using Weights = std::map<std::pair<int, int>, int>;

double heaviest(const std::vector<int>& rank_of, const std::vector<double>& costs, int n_ranks) {
  std::vector<double> sums(static_cast<size_t>(n_ranks), 0.0);
  for (size_t i = 0; i < costs.size(); ++i) sums[static_cast<size_t>(rank_of[i])] += costs[i];
  if (*std::min_element(sums.begin(), sums.end()) == 0.0) return std::numeric_limits<double>::infinity();
  return *std::max_element(sums.begin(), sums.end());
}

// The heaviest first, each to whoever has least.
std::vector<int> by_weight_alone(const std::vector<double>& costs, int n_ranks) {
  std::vector<size_t> order(costs.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return costs[a] > costs[b]; });
  std::vector<double> sums(static_cast<size_t>(n_ranks), 0.0);
  std::vector<int> rank_of(costs.size(), 0);
  for (const size_t i : order) {
    const auto least = std::min_element(sums.begin(), sums.end());
    *least += costs[i];
    rank_of[i] = static_cast<int>(least - sums.begin());
  }
  return rank_of;
}

std::vector<int> by_graph(const Weights& weights, const std::vector<double>& costs, int n_ranks) {
  std::vector<std::vector<std::pair<int, int>>> of_piece(costs.size());
  for (const auto& [pair, weight] : weights) {
    of_piece[static_cast<size_t>(pair.first)].emplace_back(pair.second, weight);
    of_piece[static_cast<size_t>(pair.second)].emplace_back(pair.first, weight);
  }
  Graph graph;
  for (const auto& neighbours : of_piece) {
    for (const auto& [other, weight] : neighbours) {
      graph.neighbours.push_back(other);
      graph.edge_weights.push_back(weight);
    }
    graph.starts.push_back(static_cast<int>(graph.neighbours.size()));
  }
  const double most = *std::max_element(costs.begin(), costs.end());
  std::vector<int> whole;
  for (const double cost : costs) whole.push_back(1 + static_cast<int>(10000.0 * cost / most));
  return partition(graph, whole, n_ranks, false);
}

std::vector<double> costs_of(const Problem& problem, const Cut& cut) {
  std::vector<double> costs;
  for (const CutPiece& piece : cut.pieces()) costs.push_back(cost_of(problem, piece));
  return costs;
}

}  // namespace

std::map<std::pair<int, int>, int> shared_points(const std::vector<Surface>& surfaces, const Cut& cut) {
  Weights weights;
  const auto link = [&](int a, int b) {
    if (a != b) ++weights[std::minmax(a, b)];
  };
  for (const Surface& s : surfaces)
    for (int i = 0; i < s.n_points() && s.part_2 >= 0; ++i)
      link(cut.owner(s.part_1, s.facing.side_1.main_node(i)).piece,
           cut.owner(s.part_2, s.facing.side_2.main_node(i)).piece);
  for (int p = 0; p < cut.n_pieces(); ++p) {
    const CutPiece& piece = cut.piece(p);
    for (size_t i = 0; i < piece.nodes.size(); ++i)
      if (piece.cut_areas[static_cast<Eigen::Index>(i)] > 0.0) link(cut.owner(piece.part, piece.nodes[i]).piece, p);
  }
  return weights;
}

void share_out(const Problem& problem, const std::vector<Surface>& surfaces, Cut& cut) {
  constexpr double bearable = 1.15;  // heavier than the most even by no more: what is exchanged counts as much
  const int n_ranks = ranks::count();
  if (n_ranks == 1) return;
  if (cut.n_pieces() < n_ranks)
    throw InputError(problem.origin,
                     fmt::format("problem '{}': {} MPI ranks for {} substructures or pieces of them: some would have "
                                 "nothing to do\n    start {} ranks at most, or cut it: solver.latin{{ pieces = {} }}",
                                 problem.name, n_ranks, cut.n_pieces(), cut.n_pieces(),
                                 (n_ranks + cut.n_pieces() - 1) / cut.n_pieces()));
  const std::vector<double> costs = costs_of(problem, cut);
  const std::vector<int> even = by_weight_alone(costs, n_ranks);
  const std::vector<int> near = by_graph(shared_points(surfaces, cut), costs, n_ranks);
  const bool is_near_bearable = heaviest(near, costs, n_ranks) <= bearable * heaviest(even, costs, n_ranks);
  for (int i = 0; i < cut.n_pieces(); ++i) cut.give(i, (is_near_bearable ? near : even)[static_cast<size_t>(i)]);
}

}  // namespace dygita
