// Where the iteration of an increment starts, given another case's interface fields.
#pragma once

#include <array>

#include "interfaces/interface_fields.hpp"
#include "step/interface_sums.hpp"

namespace dygita {

// A step's fields of another case, of which each rank takes those of its pieces.
struct OwnFields {
  const InterfaceFields* fields;  // null: none
  size_t i_step;
  const NearUnknowns* near;  // null: one process, all of them

  // Collective. The q of an increment, where it has as many unknowns as this case's; false: q is left.
  bool read(size_t increment, Eigen::Index n_own, Vec& q) const;
};

// Three guesses of an increment's q from the kept fields c and the q of the increment before:
//
//   q(n-1)                     this case continues as it does without another
//   c(n)                       the other case's answer
//   q(n-1) + c(n) - c(n-1)     what the other case did in this increment
//
// Which one is taken is decided by hindsight: the least error (weighted, of the increments so far, each counting half
// of the one after it). Close cases move alike, far ones have only some increments in common (all sticks), and where
// neither helps nothing is lost but the arithmetic.
class WarmStart {
 public:
  // fields: of the other case, null for none; weight: of each component of q in the errors. Collective where the sums
  // are.
  WarmStart(const OwnFields& fields, Vec weight, InterfaceSums sums);
  // Of one process, in one sum.
  WarmStart(const InterfaceFields* fields, size_t i_step, const Vec& weight)
      : WarmStart(OwnFields{fields, i_step, nullptr}, weight, InterfaceSums(weight.size())) {}

  // Replaces q, that of the increment before, by a guess for this one. False: the fields have nothing that fits (q is
  // left).
  bool predict(int increment, Eigen::Ref<Vec> q);

 private:
  static constexpr int n_guesses = 3;

  OwnFields fields_;
  Vec weight_;
  InterfaceSums sums_;
  std::array<Vec, n_guesses> guess_;
  std::array<double, n_guesses> error_{};
  Vec kept_, kept_before_;
  bool has_guessed_ = false;
};

}  // namespace dygita
