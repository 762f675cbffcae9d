// Where the joint under a preloaded bolt stands open, no force is in balance until it has closed, and the iteration
// cannot find the shortening by the way: it is searched from outside, roughly, and the iteration continues from there
// (manual, preload).
#include <algorithm>
#include <cmath>

#include "latin/step_run.hpp"

namespace dygita {

namespace {

// Of the search, one after the other: tolerance of the iterations for given shortenings, and how close the forces are
// to come to those asked for.
struct Level {
  double tolerance, precision;
};
constexpr Level levels[] = {{1e-4, 2e-2}, {1e-6, 1e-4}, {1e-8, 1e-6}};
constexpr int most_sweeps = 5;  // over bolts that loosen each other

}  // namespace

Vec StepRun::search_shortenings(int increment, double tolerance, double precision, Vec& d, Best& best) {
  const PreloadFigures figures = local_.preload_figures();
  int n_searched = 0;
  const auto forces = [&](const Vec& prescribed) {
    heed_interrupt(n_searched++, 1);
    local_.prescribe_shortenings(prescribed);
    iterate(increment, {tolerance, settings_.limit, 0.0}, best);
    return local_.preload_figures().force;
  };
  const Vec& target = figures.target;
  const double scale = std::max(target.cwiseAbs().maxCoeff(), forces(d).cwiseAbs().maxCoeff());
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    if (sweep > 0) {
      const Vec now = forces(d);
      if ((now - target).cwiseAbs().maxCoeff() <= 5 * precision * scale) break;
      // Nothing has resisted any of them: once more over all finds no more.
      if ((now.array() < 0.5 * target.array()).all()) break;
    }
    for (int i = 0; i < d.size(); ++i) {
      const auto force = [&](double own) {
        Vec all = d;
        all[i] = own;
        return forces(all)[i];
      };
      d[i] = find_shortening(force, target[i], d[i], figures.stiffest[i], scale, precision, settings_.assembly_size);
    }
  }
  return forces(d);
}

void StepRun::seat_bolts(int increment, const BoltStart& start, Best& best) {
  at_.q = start.q;
  if (assembled_) at_.velocity.setZero();
  const PreloadFigures figures = local_.preload_figures();
  Vec d = start.shortening;
  Best roughly;
  for (const Level& level : levels) {
    const Vec force =
        search_shortenings(increment, std::max(level.tolerance, settings_.tolerance), level.precision, d, roughly);
    if (&level == levels) check_reached(*model_.step, increment, figures.interfaces, force, figures.target);
    const Vec seated = at_.q;
    local_.prescribe_shortenings({});
    // A preload may send a part away that is still unconstrained: it is then seated more closely.
    iterate(increment, {settings_.tolerance, settings_.limit, settings_.assembly_size}, best);
    if (best.outcome.eta <= settings_.tolerance) break;
    at_.q = seated;
  }
  best.iterations += roughly.iterations;
}

}  // namespace dygita
