// Substructures that have to do with each other: a force has passed between them. What flies beside the others as a
// whole is no part of the shock.
#pragma once

#include <span>

#include "base/union_find.hpp"
#include "step/observer.hpp"

namespace dygita {

// Kept over the steps of a problem: parts that have touched stay linked.
class LinkedParts {
 public:
  // Nothing is linked.
  explicit LinkedParts(const Problem& problem);
  // Both are collective. Links what holds a part, and what forces pass between now.
  void begin_step(const Instant& start);
  void accept(const Instant& instant);
  // All parts are linked: there is nothing to ask for.
  bool are_one() const { return sets_.n_sets() == 1; }
  // Substructures that at this instant neither a support, a load, a tie nor a force of contact links to what is held,
  // or, where nothing is, to most others. Collective.
  static std::vector<int> let_go(const Instant& instant);
  // Kinetic energy (J) of the motions as a whole of groups of linked parts: of those that something holds along `free`
  // alone, of the others along all directions. momenta: kg m/s, three numbers of each piece of the cut.
  double energy_as_wholes(const Instant& instant, std::span<const double> momenta, const Mat3& free) const;

 private:
  void link_held(const StepModel& model);
  void link_ties(const Instant& instant);
  void find_forces(const Instant& instant, double least = 0.0);
  int other(const Surface& surface) const;

  UnionFind sets_;              // of the substructures, and of what holds them
  int ground_;                  // the latter
  std::vector<double> masses_;  // kg, of the step's pieces
};

}  // namespace dygita
