// Where the joint under a preloaded bolt stands open, no force is in balance until it has closed, and the iteration
// cannot find the shortening by the way: it is searched from outside, roughly, and the iteration continues from there
// (manual, preload).
#include <algorithm>
#include <cmath>

#include "latin/iteration.hpp"
#include "step/preload.hpp"

namespace dygita {

namespace {

// Of the search, one after the other: tolerance of the iterations for given shortenings, and how close the forces are
// to come to those asked for.
struct Level {
  double tolerance, precision;
};
constexpr Level levels[] = {{1e-4, 2e-2}, {1e-6, 1e-4}, {1e-8, 1e-6}};
constexpr int most_sweeps = 5;  // over bolts that loosen each other

class SeatBolts final : public Strategy {
 public:
  explicit SeatBolts(Iteration& iteration) : iteration_(iteration), step_(iteration.step()) {}
  Goal begin(const Goal& goal) override {
    start_ = step_.at.q;
    shortening_ = step_.local.preload_figures().shortening;
    return goal;
  }
  void rescue(int increment, const Goal& goal, Best& best) override;

 private:
  // Improves shortenings d (m), each bolt's in turn, until forces are right to `precision`; answers them (N), `best`
  // being the iteration at d.
  Vec search(int increment, double tolerance, double precision, Vec& d, Best& best);

  Iteration& iteration_;
  StepData& step_;
  Vec start_, shortening_;  // where the increment began
};

Vec SeatBolts::search(int increment, double tolerance, double precision, Vec& d, Best& best) {
  const PreloadFigures figures = step_.local.preload_figures();
  int n_searched = 0;
  const auto forces = [&](const Vec& prescribed) {
    Told::heed_interrupt(n_searched++, 1);
    step_.local.prescribe_shortenings(prescribed);
    iteration_.run(increment, {tolerance, step_.settings.limit, 0.0}, best);
    return step_.local.preload_figures().force;
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
      d[i] =
          find_shortening(force, target[i], d[i], figures.stiffest[i], scale, precision, step_.settings.assembly_size);
    }
  }
  return forces(d);
}

void SeatBolts::rescue(int increment, const Goal& /*goal*/, Best& best) {
  if (best.outcome.eta <= step_.settings.tolerance) return;
  step_.at.q = start_;
  if (step_.settings.is_assembled) step_.at.velocity.setZero();
  const PreloadFigures figures = step_.local.preload_figures();
  Vec d = shortening_;
  Best roughly;
  for (const Level& level : levels) {
    const Vec force =
        search(increment, std::max(level.tolerance, step_.settings.tolerance), level.precision, d, roughly);
    if (&level == levels) check_reached(*step_.model.step, increment, figures.interfaces, force, figures.target);
    const Vec seated = step_.at.q;
    step_.local.prescribe_shortenings({});
    // A preload may send a part away that is still unconstrained: it is then seated more closely.
    iteration_.run(increment, {step_.settings.tolerance, step_.settings.limit, step_.settings.assembly_size}, best);
    if (best.outcome.eta <= step_.settings.tolerance) break;
    step_.at.q = seated;
  }
  best.iterations += roughly.iterations;
}

}  // namespace

std::unique_ptr<Strategy> seat_bolts(Iteration& iteration) {
  return iteration.step().local.has_preloads() ? std::make_unique<SeatBolts>(iteration) : nullptr;
}

}  // namespace dygita
