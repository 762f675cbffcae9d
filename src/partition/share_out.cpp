#include "partition/share_out.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

#include "fem/mass.hpp"
#include "numerics/partition.hpp"
#include "partition/mass_choice.hpp"
#include "partition/stored_precision.hpp"

namespace dygita {

namespace {

constexpr double bearable = 1.15;  // heavier than the most even by no more: what is exchanged counts as much

bool is_surely_implicit(const Problem& problem, const Substructure& part) {
  const auto asked = part.integration.value_or(problem.solver.integration);
  return asked == IntegrationChoice::implicitly || problem.numerical_damping() != 0.0 ||
         problem.mass().is_moved_from_contact || has_consistent_mass(*part.mesh);
}

// What an increment costs, in bytes read from a factor: measured on the bolted flanges, the ring and rows of blocks of
// 200 to 15,000 unknowns, where explicit and implicit pieces then agree to about a third. Of an implicit one factor and
// iterations, the interface operator of which has no zeros (integration.cpp has the same terms).
double cost_of(const Problem& problem, const Substructure& whole, double n, double n_b) {
  constexpr double explicit_unknown = 500.0, fill = 1.4, iterations = 4.5, rest_of_iteration = 1000.0;
  if (!is_surely_implicit(problem, whole)) return explicit_unknown * n;
  const bool is_single = stored_precision(problem.solver, 3.0 * whole.mesh->n_nodes()) == Precision::single_precision;
  n_b = std::min(n, n_b);
  return 2.0 * fill * std::pow(n, 1.5) * (is_single ? 9.0 : 12.0) +
         iterations * (0.5 * n_b * n_b * (is_single ? 4.0 : 12.0) + rest_of_iteration * n_b);
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

std::vector<double> costs_of(const Problem& problem, const Cut& cut, const SharePlan& plan, const Weights& shared) {
  std::vector<double> costs, on_interfaces(static_cast<size_t>(cut.n_pieces()), 0.0);
  for (const auto& [pair, n_points] : shared)
    for (const int i : {pair.first, pair.second}) on_interfaces[static_cast<size_t>(i)] += 3.0 * n_points;
  bool is_known = plan.seconds.size() == static_cast<size_t>(cut.n_pieces());
  for (const CutPiece& piece : cut.pieces()) {
    is_known = is_known && plan.unknowns[costs.size()] == 3L * piece.body->mesh->n_nodes();
    costs.push_back(cost_of(problem, *problem.substructures[static_cast<size_t>(piece.part)],
                            3.0 * piece.body->mesh->n_nodes(), on_interfaces[costs.size()]));
  }
  if (!is_known) return costs;
  const double most = *std::max_element(plan.seconds.begin(), plan.seconds.end());
  if (most <= 0.0) return costs;
  for (size_t i = 0; i < costs.size(); ++i) costs[i] = std::max(plan.seconds[i], 1e-4 * most);
  return costs;
}

// Pieces with equal meshes and materials that are surely implicit: one solves for all of them on a rank.
std::vector<int> groups_of_equal(const Problem& problem, const Cut& cut) {
  std::map<std::pair<std::string, MaterialKey>, int> known;
  std::vector<int> group;
  int n = 0;
  for (const CutPiece& piece : cut.pieces()) {
    if (!is_surely_implicit(problem, *piece.body)) {
      group.push_back(n++);
      continue;
    }
    const auto [at, is_new] = known.try_emplace({piece.body->mesh->shape_digest(), piece.body->material.key()}, n);
    n += is_new;
    group.push_back(at->second);
  }
  return group;
}

// The same with the pieces of a group on one rank.
std::vector<int> by_graph_of_groups(const Weights& weights, const std::vector<double>& costs,
                                    const std::vector<int>& group, int n_ranks) {
  std::vector<double> sums(1 + static_cast<size_t>(*std::max_element(group.begin(), group.end())), 0.0);
  if (sums.size() < static_cast<size_t>(n_ranks) || sums.size() == costs.size()) return {};
  for (size_t i = 0; i < costs.size(); ++i) sums[static_cast<size_t>(group[i])] += costs[i];
  Weights between;
  for (const auto& [pair, weight] : weights) {
    const int a = group[static_cast<size_t>(pair.first)], b = group[static_cast<size_t>(pair.second)];
    if (a != b) between[std::minmax(a, b)] += weight;
  }
  const std::vector<int> of_group = by_graph(between, sums, n_ranks);
  std::vector<int> rank_of;
  for (const int g : group) rank_of.push_back(of_group[static_cast<size_t>(g)]);
  return rank_of;
}

double points_between(const Weights& weights, const std::vector<int>& rank_of) {
  double n = 0.0;
  for (const auto& [pair, weight] : weights)
    if (rank_of[static_cast<size_t>(pair.first)] != rank_of[static_cast<size_t>(pair.second)]) n += weight;
  return n;
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

double unevenness(const std::vector<double>& costs, int n_ranks) {
  return heaviest(by_weight_alone(costs, n_ranks), costs, n_ranks) * n_ranks /
         std::accumulate(costs.begin(), costs.end(), 0.0);
}

std::vector<int> pieces_for_ranks(const Problem& problem, int n_ranks) {
  constexpr double of_implicit = 1.5, worth_it = 0.95;
  std::vector<int> usual = usual_pieces(problem);
  if (n_ranks == 1 || problem.solver.pieces > 0) return usual;
  std::vector<double> costs;  // of each substructure, which a cut does not change
  for (const SubstructurePtr& part : problem.substructures)
    costs.push_back(cost_of(problem, *part, 3.0 * part->mesh->n_nodes(), 0.0));
  const double mean = std::accumulate(costs.begin(), costs.end(), 0.0) / n_ranks;
  const auto uneven = [&](const std::vector<int>& n_pieces) {
    std::vector<double> of_pieces;
    for (size_t i = 0; i < costs.size(); ++i) of_pieces.insert(of_pieces.end(), n_pieces[i], costs[i] / n_pieces[i]);
    return unevenness(of_pieces, n_ranks);
  };
  // Pieces of a tuned mass wait for each other twice an increment.
  const std::vector<double> brought = brought_frequencies(problem);
  std::vector<char> stays_whole;
  for (const SubstructurePtr& part : problem.substructures)
    stays_whole.push_back(may_be_tuned(problem, brought, *part));
  const double as_usual = uneven(usual);
  const bool is_too_few = std::accumulate(usual.begin(), usual.end(), 0) < n_ranks;
  std::vector<int> best = usual;
  double least = as_usual;
  for (const double finer : {1.0, 1.25, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0}) {
    if (least <= bearable) break;
    std::vector<int> n_pieces = usual;
    for (size_t i = 0; i < costs.size(); ++i) {
      const Substructure& part = *problem.substructures[i];
      const bool may_be_cut = is_too_few || (!stays_whole[i] && 3.0 * part.mesh->n_nodes() >= smallest_cut &&
                                             (as_usual > of_implicit || !is_surely_implicit(problem, part)));
      const int wanted = static_cast<int>(std::ceil(finer * costs[i] / mean * (1.0 - 1e-12)));
      if (may_be_cut) n_pieces[i] = std::max(usual[i], std::min(wanted, most_pieces(problem, static_cast<int>(i))));
    }
    if (const double now = uneven(n_pieces); now < worth_it * least) {
      least = now;
      best = std::move(n_pieces);
    }
  }
  return best;
}

void share_out(const Problem& problem, const std::vector<Surface>& surfaces, const SharePlan& plan, Cut& cut) {
  constexpr double about_as_few = 1.25;  // points between ranks
  const int n_ranks = ranks::count();
  if (n_ranks == 1) return;
  if (cut.n_pieces() < n_ranks)
    throw InputError(problem.origin,
                     fmt::format("problem '{}': {} MPI ranks for {} substructures or pieces of them: some would be "
                                 "idle\n    start at most {} ranks, or divide it: solver.latin{{ pieces = {} }}",
                                 problem.name, n_ranks, cut.n_pieces(), cut.n_pieces(),
                                 (n_ranks + cut.n_pieces() - 1) / cut.n_pieces()));
  const Weights weights = shared_points(surfaces, cut);
  const std::vector<double> costs = costs_of(problem, cut, plan, weights);
  const std::vector<int> even = by_weight_alone(costs, n_ranks);
  const std::vector<int> near = by_graph(weights, costs, n_ranks);
  const std::vector<int> equal = by_graph_of_groups(weights, costs, groups_of_equal(problem, cut), n_ranks);
  const double most = bearable * heaviest(even, costs, n_ranks);
  const std::vector<int>* chosen = heaviest(near, costs, n_ranks) <= most ? &near : &even;
  if (!equal.empty() && heaviest(equal, costs, n_ranks) <= most &&
      points_between(weights, equal) <= about_as_few * points_between(weights, *chosen))
    chosen = &equal;
  for (int i = 0; i < cut.n_pieces(); ++i) cut.give(i, (*chosen)[static_cast<size_t>(i)]);
}

}  // namespace dygita
