// Substructures that have to do with each other: a force has passed between them. What flies beside the others as a
// whole is no part of the shock.
#pragma once

#include <span>

#include "solution/observer.hpp"

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
  bool are_one() const { return n_groups_ == 1; }
  // Kinetic energy (J) of the motions as a whole of groups of linked parts: of those that something holds along `free`
  // alone, of the others along all directions. momenta: kg m/s, three numbers of each piece of the cut.
  double energy_as_wholes(const Instant& instant, std::span<const double> momenta, const Mat3& free) const;

 private:
  int root(int i) const;
  void link(int i, int j);
  void find_forces(const Instant& instant);

  mutable std::vector<int> parent_;  // of each substructure; the last entry is what holds them
  int n_groups_ = 0;
};

}  // namespace dygita
