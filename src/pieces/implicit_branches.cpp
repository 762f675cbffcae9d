// Branches of the material's damping in an increment of the implicit scheme (manual, eq. D24-D25): no product by K,
// since that of the mean velocity is known from W.
#include <algorithm>

#include "base/error.hpp"
#include "pieces/implicit_piece.hpp"

namespace dygita {

const std::vector<Branch>& ImplicitPiece::branches() const {
  static const std::vector<Branch> none;
  return op_.scheme().is_static ? none : op_.damping().branches;
}

void ImplicitPiece::set_elongations(const std::vector<Points>& elongation) {
  CHECK(elongation.size() >= branches().size(), "an elongation a branch");
  const std::vector<HeldDirection>& held = op_.held();
  for (size_t b = 0; b < branches().size(); ++b) {
    BranchState& own = state_.branches[b];
    own.e = op_.unknowns().restrict_nodal(elongation[b]);
    for (size_t i = 0; i < held.size(); ++i) own.held[i] = held[i].direction.dot(elongation[b].col(held[i].node));
    own.force = op_.stiffness_times(op_.unknowns().expand(own.e, own.held));
  }
}

std::vector<Points> ImplicitPiece::elongations() const {
  std::vector<Points> nodal;
  for (const BranchState& b : state_.branches) nodal.push_back(op_.unknowns().expand(b.e, b.held));
  return nodal;
}

// Takes what the branches resist with of themselves off the right-hand side of an increment.
void ImplicitPiece::recall_branches() {
  if (branches().empty()) return;
  BranchState& recalled = work_.recalled;
  recalled = {Vec::Zero(op_.n_free()), std::vector<double>(op_.held().size(), 0.0), {}};
  for (size_t b = 0; b < branches().size(); ++b) {
    const double share = branches()[b].strength * op_.scheme().kept(branches()[b]);
    const BranchState& own = state_.branches[b];
    work_.residual -= share * own.force;
    recalled.e += share * own.e;
    for (size_t i = 0; i < own.held.size(); ++i) recalled.held[i] += share * own.held[i];
  }
}

// Takes them to the increment's end, of mean velocity v of the free unknowns, and books what they dissipate.
void ImplicitPiece::advance_branches(const Vec& v_mean, IncrementEnergy& energy) {
  if (branches().empty()) return;
  const TimeScheme& scheme = op_.scheme();
  const double dt = scheme.dt, ahead = scheme.from_end(dt);
  const Vec pull = scheme.mean(work_.w_old, state_.w) / op_.c1();
  const std::vector<double> held_mean = held_mean_velocities();
  for (size_t b = 0; b < branches().size(); ++b) {
    const Branch& branch = branches()[b];
    const double kept = scheme.kept(branch), relaxed = dt * branch.rate;
    BranchState& own = state_.branches[b];
    BranchState mean{kept * (own.e + ahead * v_mean), own.held, kept * (own.force + ahead * pull)}, change = mean;
    change.e = dt * v_mean - relaxed * mean.e;
    change.force = dt * pull - relaxed * mean.force;
    for (size_t i = 0; i < own.held.size(); ++i) {
      mean.held[i] = kept * (own.held[i] + ahead * held_mean[i]);
      change.held[i] = dt * held_mean[i] - relaxed * mean.held[i];
      own.held[i] += change.held[i];
    }
    own.e += change.e;
    own.force += change.force;
    if (relaxed > 0.0) energy.damping += branch.strength * relaxed * square(mean);
    if (scheme.dissipates()) energy.scheme += branch.strength * scheme.loss(square(change));
  }
}

// e.K e (J).
double ImplicitPiece::square(const BranchState& branch) const {
  double sum = branch.e.dot(branch.force);
  if (std::all_of(branch.held.begin(), branch.held.end(), [](double e) { return e == 0.0; })) return sum;
  const std::vector<double> force = op_.stiffness_times_held(op_.unknowns().expand(branch.e, branch.held));
  for (size_t i = 0; i < force.size(); ++i) sum += branch.held[i] * force[i];
  return sum;
}

}  // namespace dygita
