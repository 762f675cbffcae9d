#include "step/integration.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "base/parallel.hpp"
#include "fem/mass.hpp"
#include "model/model.hpp"
#include "partition/all_pieces.hpp"
#include "partition/mass_choice.hpp"
#include "partition/stored_precision.hpp"
#include "pieces/longest_step.hpp"
#include "step/alike_parts.hpp"
#include "step/expected_iterations.hpp"
#include "step/step_needs.hpp"

namespace dygita {

namespace {

constexpr double safety = 0.98;
// What each costs in bytes of plain reading, fitted to the bolted flanges at 14,000 to 50,000 unknowns: of an unknown
// in an explicit increment and of each pair of neighbours, more where the mass is tuned, and of a point; entries of a
// factor are so many n^1.5; a solve and a product by H read so much an entry (in single precision, packed, they are
// bound by unpacking); the rest of an iteration, of an interface unknown; making the factor, of n^2, and H, of n^3.
constexpr double explicit_unknown = 95.0, explicit_pair = 40.0, tuned_unknown = 80.0, damped_unknown = 60.0,
                 branch_unknown = 45.0, explicit_point = 1100.0, fill = 1.4;
constexpr double spread_point = 10000.0;  // between meshes that do not match: some eight rounds
constexpr double single_factor = 9.0, double_factor = 12.0, single_h = 4.0, double_h = 12.0;
constexpr double rest_of_iteration = 1000.0, factorising = 16.0, condensing = 0.5;

struct Size {
  double unknowns = 0.0, interface_unknowns = 0.0;
  double pairs = 0.0;          // of nodes that share a cell
  double spread_points = 0.0;  // between meshes that do not match; half of each interface's
  bool is_damped = false;      // by stiffness
  double branches = 0.0;       // of damping over a band
};

// Of a whole substructure: what an increment reads.
double explicit_cost(const Size& size, bool is_tuned) {
  return (explicit_unknown + (is_tuned ? tuned_unknown : 0.0) + (size.is_damped ? damped_unknown : 0.0) +
          branch_unknown * size.branches) *
             size.unknowns +
         explicit_pair * size.pairs + explicit_point * size.interface_unknowns / 6.0 +
         spread_point * size.spread_points;
}
double of_factor(const Size& size) {
  const double n = size.unknowns, n_b = std::min(size.interface_unknowns, n);
  return factorising * n * n + condensing * n_b * n_b * n_b;
}
double of_iteration(const Size& size, bool is_single) {
  const double n_b = std::min(size.interface_unknowns, size.unknowns);
  return 0.5 * n_b * n_b * (is_single ? single_h : double_h) + rest_of_iteration * n_b;
}
double of_solves(const Size& size, bool is_single) {
  return 2.0 * fill * std::pow(size.unknowns, 1.5) * (is_single ? single_factor : double_factor);
}
// n_increments: of the step, which the factor is made for. With the settings that nobody has asked for: what is
// discretised in which way is no matter of how it is solved.
double implicit_cost(const Size& size, int n_increments) {
  const bool is_single = stored_precision(LatinSettings(), size.unknowns) == Precision::single_precision;
  return of_solves(size, is_single) + iterations_of_shocks * of_iteration(size, is_single) +
         of_factor(size) / n_increments;
}

std::vector<double> pairs_of_neighbours(const Cut& cut, const std::vector<Body>& bodies) {
  const std::vector<double> of_pieces =
      of_all_pieces(cut, 1, [&](int p, double* to) { *to = bodies[static_cast<size_t>(p)].matrices->n_pairs(); });
  std::vector<double> pairs;
  for (size_t p = 0; p < of_pieces.size(); ++p) {
    const size_t part = static_cast<size_t>(cut.piece(static_cast<int>(p)).part);
    pairs.resize(std::max(pairs.size(), part + 1), 0.0);
    pairs[part] += of_pieces[p];
  }
  return pairs;
}

std::vector<Size> sizes_of(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces,
                           const std::vector<double>& pairs) {
  std::vector<std::set<int>> nodes(problem.substructures.size());
  std::vector<double> spread(nodes.size(), 0.0);
  for (const Surface& s : surfaces) {
    if (!takes_part(problem, step, s)) continue;
    const auto take = [](const SideTrace& side, std::set<int>& of) {
      for (int i = 0; i < side.n_points(); ++i)
        for (int k = 0; k < side.n_shares(i); ++k) of.insert(side.share(i, k).node);
    };
    take(s.facing.side_1, nodes[s.part_1]);
    if (s.part_2 >= 0) take(s.facing.side_2, nodes[s.part_2]);
    if (s.facing.matches()) continue;
    spread[s.part_1] += 0.5 * s.n_points();
    if (s.part_2 >= 0) spread[s.part_2] += 0.5 * s.n_points();
  }
  std::vector<Size> sizes;
  for (size_t i = 0; i < nodes.size(); ++i) {
    const Damping& damping = problem.substructures[i]->material.damping;
    sizes.push_back({3.0 * problem.substructures[i]->mesh->n_nodes(), 3.0 * static_cast<double>(nodes[i].size()),
                     pairs[i], spread[i], damping.is_of_strain(), static_cast<double>(damping.branches.size())});
  }
  return sizes;
}

std::unordered_map<int, Held> held_of(const Cut& cut, int piece, const Conditions& conditions) {
  const CutPiece& own = cut.piece(piece);
  if (own.is_whole()) return conditions.held[own.part];
  std::unordered_map<int, Held> held;
  for (size_t i = 0; i < own.nodes.size(); ++i)
    if (const Held* h = conditions.at(own.part, own.nodes[i])) held.emplace(static_cast<int>(i), *h);
  return held;
}

class Chooser {
 public:
  Chooser(const Problem& problem, const Step& step, std::vector<Integration::Part> parts, std::vector<Size> sizes,
          const AlikeParts& alike)
      : problem_(problem), step_(step), parts_(std::move(parts)), sizes_(std::move(sizes)) {
    for (size_t i = 0; i < parts_.size(); ++i) {
      must_.push_back(may_be(i) && is_asked(i));
      stable_.push_back(parts_[i].longest);
    }
    for (size_t i = 0; i < parts_.size(); ++i)
      for (size_t j = 0; j < parts_.size(); ++j) {
        if (!alike.are_bound(i, j)) continue;
        must_[i] |= may_be(j) && is_asked(j);
        stable_[i] = std::min(stable_[i], parts_[j].longest);
      }
    for (size_t i = 0; i < parts_.size(); ++i) {
      bool loses = loses_by_diagonal(*problem.substructures[i]->mesh);
      for (size_t j = 0; j < parts_.size(); ++j)
        loses |= alike.are_bound(i, j) && loses_by_diagonal(*problem.substructures[j]->mesh);
      left_.push_back(loses && !must_[i]);
    }
  }

  // The set of explicit substructures that costs least, of those that a longest step separates.
  Integration best() const {
    std::vector<double> limits{std::numeric_limits<double>::infinity()};
    for (size_t i = 0; i < parts_.size(); ++i)
      if (may_be(i) && !must_[i] && !left_[i]) limits.push_back(stable_[i]);
    std::sort(limits.begin(), limits.end());
    Integration best;
    double least = std::numeric_limits<double>::infinity();
    for (const double limit : limits) {
      std::vector<char> set;
      for (size_t i = 0; i < parts_.size(); ++i)
        set.push_back(must_[i] || (may_be(i) && !left_[i] && stable_[i] >= limit));
      if (limit == limits.back())  // the parts without a limit are no reason to begin with
        set = must_;
      const double cost = cost_of(set);
      if (cost >= least) continue;
      least = cost;
      best.parts = parts_;
      for (size_t i = 0; i < parts_.size(); ++i) best.parts[i].is_explicit = set[i] != 0;
      best.n_substeps = substeps(set);
      best.cost = cost / cost_of(std::vector<char>(parts_.size(), 0));
    }
    for (size_t i = 0; i < best.parts.size(); ++i)
      if (left_[i] && best.parts[i].why_not.empty())
        best.parts[i].why_not =
            "its cells of order two have no nodes in the middle of quadrangles, so that their diagonal mass is less "
            "accurate: explicit only on request";
    return best;
  }

 private:
  bool is_asked(size_t i) const {
    return asked_of(problem_, *problem_.substructures[i]) == IntegrationChoice::explicitly;
  }
  bool may_be(size_t i) const {
    return parts_[i].why_not.empty() && asked_of(problem_, *problem_.substructures[i]) != IntegrationChoice::implicitly;
  }
  int substeps(const std::vector<char>& set) const {
    double shortest = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < set.size(); ++i)
      if (set[i]) shortest = std::min(shortest, parts_[i].longest);
    return std::isinf(shortest) ? 1 : std::max(1, static_cast<int>(std::ceil(step_.dt / shortest * (1.0 - 1e-9))));
  }
  double cost_of(const std::vector<char>& set) const {
    double cost = 0.0;
    bool is_mixed = false;
    for (size_t i = 0; i < set.size(); ++i) {
      cost += set[i] ? substeps(set) * explicit_cost(sizes_[i], parts_[i].is_tuned)
                     : substeps(set) * implicit_cost(sizes_[i], substeps(set) * step_.n_increments());
      is_mixed |= set[i] != set[0];
    }
    const bool has_must = std::find(must_.begin(), must_.end(), 1) != must_.end();
    // A window of several steps is iterated: not with increments inside them.
    if (is_mixed && problem_.solver.window != 1 && !has_must) return std::numeric_limits<double>::infinity();
    return cost;
  }

  const Problem& problem_;
  const Step& step_;
  std::vector<Integration::Part> parts_;
  std::vector<Size> sizes_;
  std::vector<char> must_;      // the deck asks for it, of a substructure or of one that it is bound to
  std::vector<char> left_;      // nobody asks, and its cells, or of one that it is bound to, would lose accuracy
  std::vector<double> stable_;  // s, longest stable increment of those it is bound to
};

// Where one of those bound together is implicit, all are.
void bind_to_implicit(const Problem& problem, const AlikeParts& alike, std::vector<Integration::Part>& parts) {
  std::vector<char> is_implicit;
  for (size_t i = 0; i < parts.size(); ++i)
    is_implicit.push_back(!parts[i].why_not.empty() ||
                          asked_of(problem, *problem.substructures[i]) == IntegrationChoice::implicitly);
  for (size_t i = 0; i < parts.size(); ++i)
    for (size_t j = 0; j < parts.size() && parts[i].why_not.empty(); ++j)
      if (alike.are_bound(i, j) && is_implicit[j] && !is_implicit[i])
        parts[i].why_not =
            fmt::format("interface '{}', between meshes that do not match, binds it to '{}', which is implicit{}",
                        alike.interfaces[i], problem.substructures[j]->name,
                        parts[j].why_not.empty() ? "" : ": " + parts[j].why_not);
}

// Whether it is cut does not count: a cut changes nothing.
void choose_mass(const Problem& problem, const std::vector<Size>& sizes, std::vector<Integration::Part>& parts) {
  const bool is_chosen = problem.mass().is_chosen;
  const std::vector<double> brought = is_chosen ? brought_frequencies(problem) : std::vector<double>();
  for (size_t i = 0; i < parts.size(); ++i) {
    // Tuned to one speed of waves; where other directions have others the longest stable step is not found safely.
    parts[i].is_tuned = problem.mass().is_tuned && problem.substructures[i]->material.is_isotropic();
    if (!is_chosen || !parts[i].why_not.empty()) continue;
    const Substructure& part = *problem.substructures[i];
    parts[i].phase = phase_of_lumped_mass(problem, brought, part);
    const double interface_share = sizes[i].interface_unknowns / sizes[i].unknowns;
    parts[i].is_tuned = wants_tuned_mass(part, parts[i].phase, interface_share);
    parts[i].why_lumped = why_lumped(part, parts[i].phase, interface_share);
  }
}

// Longest stable increments of the pieces that are here and may be explicit. Equal ones that nothing holds have the
// same.
void longest_steps(const Problem& problem, const std::vector<Body>& bodies, const Cut& cut,
                   const Conditions& conditions, const std::vector<Integration::Part>& parts,
                   std::vector<double>& longest) {
  std::map<std::tuple<const StoredMatrices*, const Mass*, double, double, bool>, int> free_ones;
  std::vector<int> first(bodies.size(), -1);  // equal to it; itself: asked
  std::vector<std::unordered_map<int, Held>> held(bodies.size());
  for (int p = 0; p < static_cast<int>(bodies.size()); ++p) {
    const int part = cut.piece(p).part;
    if (!cut.is_here(p) || !parts[part].why_not.empty() ||
        asked_of(problem, *problem.substructures[part]) == IntegrationChoice::implicitly)
      continue;
    held[p] = held_of(cut, p, conditions);
    const Damping& damping = problem.substructures[part]->material.damping;
    first[p] = held[p].empty() ? free_ones
                                     .try_emplace({bodies[p].matrices.get(), bodies[p].mass.get(), damping.stiffness,
                                                   damping.of_sudden_motion(), parts[part].is_tuned},
                                                  p)
                                     .first->second
                               : p;
  }
  std::vector<double> speed(parts.size(), 0.0);
  for (size_t i = 0; i < parts.size(); ++i)
    if (parts[i].is_tuned) speed[i] = tuned_wave_speed(*problem.substructures[i], conditions.held[i]);
  parallel_for(static_cast<int>(bodies.size()), [&](int p) {
    const auto part = static_cast<size_t>(cut.piece(p).part);
    if (first[p] == p)
      longest[p] = safety * (parts[part].is_tuned ? longest_tuned_step(bodies[p], held[p], speed[part])
                                                  : longest_explicit_step(bodies[p], held[p]));
  });
  for (size_t p = 0; p < first.size(); ++p)
    if (first[p] >= 0) longest[p] = longest[first[p]];
}

void refuse(const Problem& problem, const std::vector<Integration::Part>& parts) {
  for (size_t i = 0; i < parts.size(); ++i) {
    const Substructure& part = *problem.substructures[i];
    if (part.integration != IntegrationChoice::explicitly || parts[i].why_not.empty()) continue;
    throw InputError(part.origin, fmt::format("substructure '{}': integration = \"explicit\" is not possible: {}",
                                              part.name, parts[i].why_not));
  }
}

void refuse_mixed_window(const Problem& problem, const Integration& chosen) {
  if (problem.solver.window == 1) return;
  const auto count =
      std::count_if(chosen.parts.begin(), chosen.parts.end(), [](const auto& p) { return p.is_explicit; });
  if (count == 0 || count == static_cast<long>(chosen.parts.size())) return;
  throw InputError(problem.origin,
                   fmt::format("problem '{}': 'window' is for time steps that are iterated together, and some of its "
                               "substructures are explicit\n    omit 'window', or make all of them implicit",
                               problem.name));
}

}  // namespace

IntegrationChoice asked_of(const Problem& problem, const Substructure& part) {
  return part.integration.value_or(problem.solver.integration);
}

Integration choose_integration(const Problem& problem, const Step& step, const std::vector<Body>& bodies,
                               const Cut& cut, const Conditions& conditions, const std::vector<Surface>& surfaces) {
  const size_t n = problem.substructures.size();
  const bool is_asked = std::any_of(problem.substructures.begin(), problem.substructures.end(), [&](const auto& part) {
    return asked_of(problem, *part) != IntegrationChoice::implicitly;
  });
  if (!is_asked || problem.monolithic || problem.explicit_dynamics) return {};
  std::vector<Integration::Part> parts(n);
  std::vector<double> longest(bodies.size(), std::numeric_limits<double>::infinity());
  for (size_t p = 0; p < bodies.size(); ++p) {
    std::string& why_not = parts[cut.piece(static_cast<int>(p)).part].why_not;
    if (why_not.empty()) why_not = why_not_explicit(bodies[p], problem.numerical_damping());
  }
  const AlikeParts alike = find_alike(problem, step, surfaces);
  bind_to_implicit(problem, alike, parts);
  refuse(problem, parts);
  const std::vector<Size> sizes = sizes_of(problem, step, surfaces, pairs_of_neighbours(cut, bodies));
  choose_mass(problem, sizes, parts);
  longest_steps(problem, bodies, cut, conditions, parts, longest);
  longest = of_all_pieces(cut, 1, [&](int p, double* to) { *to = longest[p]; });
  for (size_t i = 0; i < n; ++i) {
    const int first = cut.first(static_cast<int>(i));
    parts[i].longest =
        *std::min_element(longest.begin() + first, longest.begin() + first + cut.n_pieces(static_cast<int>(i)));
  }
  Integration chosen = Chooser(problem, step, parts, sizes, alike).best();
  refuse_mixed_window(problem, chosen);
  for (const CutPiece& piece : cut.pieces()) chosen.is_explicit.push_back(chosen.parts[piece.part].is_explicit);
  if (std::find(chosen.is_explicit.begin(), chosen.is_explicit.end(), 1) == chosen.is_explicit.end())
    chosen.is_explicit.clear();
  return chosen;
}

StepCost predict_cost(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces,
                      const std::vector<Body>& bodies, const Cut& cut, const Integration& integration) {
  const std::vector<Size> sizes = sizes_of(problem, step, surfaces, pairs_of_neighbours(cut, bodies));
  StepCost cost;
  double an_increment = 0.0, an_iteration = 0.0, an_explicit_one = 0.0;
  std::set<const StoredMatrices*> factorised;  // equal ones once
  for (size_t i = 0; i < sizes.size(); ++i) {
    if (!integration.parts.empty() && integration.parts[i].is_explicit) {
      an_explicit_one += explicit_cost(sizes[i], integration.parts[i].is_tuned);
      continue;
    }
    const bool is_single =
        !step.is_static && stored_precision(problem.solver, sizes[i].unknowns) == Precision::single_precision;
    if (factorised.insert(bodies[static_cast<size_t>(cut.first(static_cast<int>(i)))].matrices.get()).second)
      cost.once.bytes += of_factor(sizes[i]);
    an_increment += of_solves(sizes[i], is_single);
    an_iteration += of_iteration(sizes[i], is_single);
  }
  const double n = static_cast<double>(step.n_increments()) * integration.n_substeps;
  // Laws, energies and outputs beside, as in the flanges, the box of electronics and the ring.
  constexpr double whole_increment = 1.7;
  const double share = step.is_static ? 1.0 : whole_increment;
  cost.once.bytes += n * share * (an_increment + an_explicit_one);
  cost.a_round.bytes = share * an_iteration;
  const auto [fewest, most] = expected_iterations(problem, step, surfaces, integration);
  cost.fewest = n * fewest;
  cost.most = n * most;
  if (an_iteration > 0.0)
    cost.rounds = fewest < most ? fmt::format("{:.0f} to {:.0f} iterations an increment", fewest, most)
                                : fmt::format("{:.0f} iterations an increment", fewest);
  return cost;
}

}  // namespace dygita
