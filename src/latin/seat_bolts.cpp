// Where the joint under a preloaded bolt stands open, no force is in balance until it has closed, and the iteration
// cannot find the shortening by the way: it is searched from outside, roughly, and the iteration goes on from there
// (manual, preload).
#include <algorithm>
#include <cmath>
#include <utility>

#include "latin/step_run.hpp"

namespace dygita {

namespace {

constexpr double rough = 1e-4;  // tolerance of the iterations for a given shortening
constexpr double close = 2e-2;  // to the force asked for
constexpr int most_sweeps = 5;  // over bolts that loosen each other

}  // namespace

// A preload may send a part away that is still unconstrained.
bool StepRun::is_lost() const {
  return extent_ > 0.0 && velocity_.size() > 0 && !(velocity_.cwiseAbs().maxCoeff() <= extent_);
}

void StepRun::keep_start() {
  q_start_ = q_;
  shortenings_start_ = local_.preload_figures().shortening;
  extent_ = assembly_size();
}

Outcome StepRun::seat_bolts(int increment, Vec& q_best, int& n) {
  q_ = q_start_;
  const double extent = std::exchange(extent_, 0.0);
  const PreloadFigures figures = local_.preload_figures();
  const Vec &target = figures.target, &stiffest = figures.stiffest;
  Vec d = shortenings_start_;
  const auto forces = [&](const Vec& prescribed) {
    local_.prescribe_shortenings(prescribed);
    Vec unused;
    iterate(increment, {std::max(rough, tolerance_), max_iterations_}, unused, n);
    return local_.preload_figures().force;
  };
  const double scale = std::max(target.cwiseAbs().maxCoeff(), forces(d).cwiseAbs().maxCoeff());
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    if (sweep > 0 && (forces(d) - target).cwiseAbs().maxCoeff() <= 5 * close * scale) break;
    for (int i = 0; i < d.size(); ++i) {
      const auto force = [&](double own) {
        Vec all = d;
        all[i] = own;
        return forces(all)[i];
      };
      d[i] = find_shortening(force, target[i], d[i], stiffest[i], scale, close, extent);
    }
  }
  check_reached(*model_.step, increment, figures.interfaces, forces(d), target);
  local_.prescribe_shortenings({});
  extent_ = extent;
  return iterate(increment, {tolerance_, max_iterations_}, q_best, n);
}

}  // namespace dygita
