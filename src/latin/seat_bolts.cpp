// Where the joint under a preloaded bolt stands open, no force is in balance until it has closed, and the iteration
// cannot find the shortening by the way: it is searched from outside, roughly, and the iteration goes on from there
// (manual, preload).
#include <algorithm>
#include <cmath>

#include "latin/step_run.hpp"

namespace dygita {

namespace {

constexpr double rough = 1e-4;  // tolerance of the iterations for a given shortening
constexpr double close = 2e-2;  // to the force asked for
constexpr int most_sweeps = 5;  // over bolts that loosen each other

}  // namespace

void StepRun::seat_bolts(int increment, const BoltStart& start, Best& best) {
  at_.q = start.q;
  const PreloadFigures figures = local_.preload_figures();
  const Vec &target = figures.target, &stiffest = figures.stiffest;
  Vec d = start.shortening;
  Best roughly;
  const auto forces = [&](const Vec& prescribed) {
    local_.prescribe_shortenings(prescribed);
    iterate(increment, {std::max(rough, settings_.tolerance), settings_.max_iterations, 0.0}, roughly);
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
      d[i] = find_shortening(force, target[i], d[i], stiffest[i], scale, close, settings_.assembly_size);
    }
  }
  check_reached(*model_.step, increment, figures.interfaces, forces(d), target);
  local_.prescribe_shortenings({});
  best.iterations += roughly.iterations;
  // A preload may send a part away that is still unconstrained.
  iterate(increment, {settings_.tolerance, settings_.max_iterations, settings_.assembly_size}, best);
}

}  // namespace dygita
