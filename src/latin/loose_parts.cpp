#include "latin/loose_parts.hpp"

#include <algorithm>
#include <cmath>

#include "latin/iteration.hpp"

namespace dygita {

std::unique_ptr<LooseParts> LooseParts::of(Iteration& iteration) {
  if (!iteration.step().model.scheme.is_static) return nullptr;
  LooseMotions motions(iteration.step().model);
  if (!motions.may_be()) return nullptr;
  return std::unique_ptr<LooseParts>(new LooseParts(iteration, std::move(motions)));
}

LooseParts::LooseParts(Iteration& iteration, LooseMotions motions)
    : iteration_(iteration), step_(iteration.step()), motions_(std::move(motions)) {}

double LooseParts::moved(int port, int d) const {
  const StepModel& model = step_.model;
  return step_.at.velocity[model.unknown(model.exchange.ports[static_cast<size_t>(port)], d)];
}

// Takes motions of ports off the fields at hand: the same forces.
void LooseParts::take_off(const std::vector<Vec3>& motions) {
  const StepModel& model = step_.model;
  for (size_t p = 0; p < motions.size(); ++p)
    for (int d = 0; d < 3; ++d)
      if (const int i = model.unknown(model.exchange.ports[p], d); i >= 0) {
        step_.at.velocity[i] -= motions[p][d];
        step_.at.q[i] -= step_.local.k()[i] * motions[p][d];
      }
}

void LooseParts::stop() {
  if (step_.at.velocity.size() != step_.at.q.size()) return;
  const double least = std::pow(step_.settings.tolerance, 2) * step_.indicator.largest();
  take_off(motions_.find(
      {[&](int point) { return step_.local.links(point, least); }, [&](int p, int d) { return moved(p, d); }}));
}

bool LooseParts::leave() {
  const std::vector<Vec3> motions =
      motions_.find({[&](int point) { return step_.local.carries(point); }, [&](int p, int d) { return moved(p, d); }});
  take_off(motions);
  return !motions.empty();
}

// What loose parts are carried along in the last iteration, of each port; size: W, of the increment's fields.
// Collective.
std::vector<Vec3> LooseParts::resting_motions(double size) const {
  // What the tolerance leaves of forces holds nothing.
  const double least = std::pow(step_.settings.tolerance, 2) * std::max(size, step_.indicator.largest());
  return motions_.find({[&](int point) { return step_.local.links(point, least); },
                        [&](int p, int d) { return moved(p, d); }, [&](int point) { return step_.local.gap(point); }});
}

void LooseParts::rescue(int increment, const Goal& goal, Best& best) {
  constexpr int most = 3;
  constexpr double nearly = 1e-6;     // of the indicator: a solution but for loose parts
  constexpr double rounding = 1e-25;  // of the size of a motion, squares both
  const double enough = std::max(goal.tolerance, step_.settings.tolerance);
  if (!(best.outcome.eta <= std::max(enough, nearly))) return;
  Iterate& at = step_.at;
  Stages& stages = iteration_.stages();
  const bool is_in_one = stages.system() != nullptr;
  const bool was_solved = best.outcome.eta <= enough;
  if (!was_solved || best.outcome.eta > goal.tolerance) {
    at.q = best.q;
    at.uncorrected.resize(0);
    stages.answer();
  }
  const Vec carried = at.q, velocity = at.velocity, uncorrected = at.uncorrected;
  const Best before = best;
  const double moved_size = at.sums.velocity_size;
  // In one system V is at hand; pieces answer to q.
  const auto answer = [&] {
    if (is_in_one)
      at.sums = stages.local_stage(at.velocity, at.q, at.image, true);
    else
      stages.answer();
  };
  for (int n = 0; n < most; ++n) {
    const std::vector<Vec3> motions = resting_motions(best.outcome.size);
    if (motions.empty()) return;
    take_off(motions);
    at.uncorrected.resize(0);
    answer();
    Outcome outcome = step_.indicator.measure(at.sums);
    // In one system the same fields but for a motion: what they lack is what rounding leaves of it.
    const IndicatorSums& sums = at.sums;
    if (is_in_one && was_solved && sums.force_distance + sums.velocity_distance <= rounding * moved_size)
      outcome.eta = std::min(outcome.eta, before.outcome.eta);
    const bool is_enough = outcome.eta <= enough;
    if (is_enough || (!was_solved && outcome.eta <= before.outcome.eta)) {
      best.outcome = outcome;
      best.q = at.q;
    }
    if (is_enough) return;
    const Goal again{enough, step_.settings.limit, goal.furthest};
    at.is_answered = is_in_one;
    is_resting_ = true;
    iteration_.run(increment, again, best);
    is_resting_ = false;
    if (best.outcome.eta <= enough) continue;
    if (!was_solved) return;
    // It was a solution as it was.
    const int iterations = best.iterations;
    best = before;
    best.iterations = iterations;
    at.q = carried;
    at.velocity = velocity;
    at.uncorrected = uncorrected;
    answer();
    return;
  }
}

}  // namespace dygita
