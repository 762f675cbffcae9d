#include "reference/preload_newton.hpp"

#include <cmath>

#include "base/progress.hpp"
#include "numerics/dense.hpp"

namespace dygita {

namespace {

constexpr double near_enough = 1e-7;  // relative: from there on Newton's own slopes are right

// The search of the shortenings ends: forces that are no solution lead nowhere, or the user wishes so.
struct GivenUp {};
constexpr int most_solutions_in_vain = 4;  // solutions that have not converged, one after the other

}  // namespace

PreloadNewton::PreloadNewton(const InterfaceRows& rows, const std::vector<PointRecord>& records, double tolerance,
                             bool plain)
    : model_(&rows.model()),
      preloads_(make_preloads(rows.model(), records)),
      approach_(rows, preloads_, plain),
      stiffest_(Vec::Zero(static_cast<Eigen::Index>(preloads_.size()))),
      extent_(rows.extent()),
      tolerance_(tolerance) {
  for (size_t i = 0; i < preloads_.size(); ++i)
    for (const int p : preloads_[i].points)
      if (const int row = rows.assembly().row(p, 0); row >= 0)
        stiffest_[i] += 1.0 / rows.assembly().compliance()(row, row);
}

// Forces through the preloaded interfaces for shortenings d: the whole increment solved.
Vec PreloadNewton::forces(const Vec& d) {
  Vec force = Vec::Zero(d.size());
  for (int i = 0; i < d.size(); ++i)
    for (const int p : preloads_[i].points) (*records_)[p].trial.shortening = d[i];
  if (interrupt_requested()) throw GivenUp();
  outcome_ = solve_();
  n_iterations_ += outcome_.iterations;
  n_in_vain_ = outcome_.converged ? 0 : n_in_vain_ + 1;
  if (n_in_vain_ == most_solutions_in_vain) throw GivenUp();
  for (int i = 0; i < d.size(); ++i)
    for (const int p : preloads_[i].points) force[i] += (*records_)[p].force[0];
  return force;
}

// Each alone, the others' shortenings held: slow, but it closes gaps and comes back from yield.
void PreloadNewton::one_by_one(Vec& d) {
  for (int i = 0; i < d.size(); ++i) {
    const auto force = [&](double own) {
      Vec all = d;
      all[i] = own;
      return forces(all)[i];
    };
    d[i] = find_shortening(force, target_[i], d[i], stiffest_[i], scale_, tolerance_, 0.1 * extent_);
  }
}

Mat PreloadNewton::slopes(const Vec& d, const Vec& force) {
  Mat slope(d.size(), d.size());
  for (int i = 0; i < d.size(); ++i) {
    Vec moved = d;
    moved[i] += 1e-3 * scale_ / stiffest_[i];
    slope.col(i) = (forces(moved) - force) / (moved[i] - d[i]);
  }
  return slope;
}

double PreloadNewton::error(const Vec& force) const {
  return scale_ > 0.0 ? (target_ - force).cwiseAbs().maxCoeff() / scale_ : 0.0;
}

// From shortenings d to those that bring the target; returns the forces there.
Vec PreloadNewton::search(Vec& d) {
  Vec force = forces(d);
  scale_ = std::max(target_.cwiseAbs().maxCoeff(), force.cwiseAbs().maxCoeff());
  Mat slope;
  for (int k = 0; k < 30 && error(force) > tolerance_; ++k) {
    const double before = error(force);
    if (d.size() == 1 || k == 0) {
      one_by_one(d);
      force = forces(d);
      slope.resize(0, 0);
      continue;
    }
    if (slope.size() == 0) slope = slopes(d, force);
    const Vec old = d;
    d += solve_dense(slope, target_ - force);
    force = forces(d);
    if (error(force) > 0.1 * before) slope.resize(0, 0);
    if (error(force) < before) continue;
    d = old;
    one_by_one(d);
    force = forces(d);
  }
  return force;
}

InterfaceNewton::Outcome PreloadNewton::solve(InterfaceNewton& newton, std::vector<PointRecord>& records,
                                              const Increment& increment, int i_increment) {
  constexpr double nearer = 1e-2;  // where Newton's method has diverged
  newton.start(records);
  n_iterations_ = 0;
  InterfaceNewton::Outcome outcome = attempt(newton, records, increment, i_increment, near_enough);
  if (increment.is_static && !outcome.converged && !interrupt_requested())
    outcome = attempt(newton, records, increment, i_increment, nearer * near_enough);
  newton.check_together(outcome);
  return outcome;
}

InterfaceNewton::Outcome PreloadNewton::attempt(InterfaceNewton& newton, std::vector<PointRecord>& records,
                                                const Increment& increment, int i_increment, double near) {
  if (increment.is_static)
    n_iterations_ +=
        approach_.approach(newton.reduced_force(), records, increment, i_increment,
                           std::max(near, newton.settings().tolerance), 2 * newton.settings().max_iterations);
  if (preloads_.empty()) {
    InterfaceNewton::Outcome outcome = newton.solve(records, increment);
    outcome.iterations = n_iterations_ += outcome.iterations;
    return outcome;
  }
  records_ = &records;
  solve_ = [&] { return newton.solve(records, increment); };
  const int n = static_cast<int>(preloads_.size());
  Vec d(n);
  target_.resize(n);
  for (int i = 0; i < n; ++i) {
    target_[i] = preloads_[i].target(i_increment, model_->step->increments);
    d[i] = preloads_[i].points.empty() ? 0.0 : records[preloads_[i].points.front()].trial.shortening;
  }
  Vec force = Vec::Zero(n);
  n_in_vain_ = 0;
  bool is_given_up = false;
  try {
    force = search(d);
  } catch (const GivenUp&) {
    is_given_up = true;
  }
  std::vector<const Interface*> interfaces;
  for (const Preload& preload : preloads_) interfaces.push_back(preload.interface);
  outcome_.iterations = n_iterations_;
  if (is_given_up) {
    outcome_.converged = false;
    return outcome_;
  }
  check_reached(*model_->step, i_increment, interfaces, force, target_);  // says more than that a part has come off
  outcome_.residual = std::max(outcome_.residual, error(force));
  outcome_.converged = outcome_.converged && error(force) <= tolerance_;
  return outcome_;
}

}  // namespace dygita
