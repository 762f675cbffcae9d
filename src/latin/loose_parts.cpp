// Parts that nothing touches at the end of a static increment have been carried along by whatever the iteration came
// through; they rest (manual, loose parts).
#include "latin/step_run.hpp"

namespace dygita {

// The system knows where loose parts are by what they are near to, and carries them along with it: they rest, as far as
// nothing is in their way there. False: there are none.
bool StepRun::leave_loose_parts() {
  const auto moved = [&](int p, int d) {
    return at_.velocity[model_.unknown(model_.exchange.ports[static_cast<size_t>(p)], d)];
  };
  const std::vector<Vec3> motions = loose_->find({[&](int point) { return local_.carries(point); }, moved});
  for (size_t p = 0; p < motions.size(); ++p)
    for (int d = 0; d < 3; ++d)
      if (const int i = model_.unknown(model_.exchange.ports[p], d); i >= 0) {
        at_.velocity[i] -= motions[p][d];
        at_.q[i] -= assembled_->k()[i] * motions[p][d];  // the same force
      }
  return !motions.empty();
}

// What loose parts are carried along in the last iteration, of each port; collective.
std::vector<Vec3> StepRun::loose_motions() const {
  const std::vector<Point>& points = model_.exchange.points;
  constexpr int width = 2;
  std::vector<double> said(width * points.size());  // of each point: is it linked, its gap
  for (const int i : model_.near.points()) {
    double* to = said.data() + width * static_cast<size_t>(i);
    to[0] = local_.links(i) ? 1.0 : 0.0;
    to[1] = local_.gap(i);
  }
  if (!model_.near.is_all()) {
    std::vector<int> owner, offset{0};
    for (const Point& point : points) {
      owner.push_back(DistantPoints::booking(model_, point));
      offset.push_back(offset.back() + 1);
    }
    ranks::Segments(owner, offset).complete(said.data(), width);
  }
  const Vec velocity = model_.near.assembled(at_.velocity);
  const auto of = [&](int point) { return said.data() + width * static_cast<size_t>(point); };
  return loose_->find({[&](int point) { return of(point)[0] != 0.0; },
                       [&](int p, int d) {
                         return velocity[model_.assembled_unknown(model_.exchange.ports[static_cast<size_t>(p)], d)];
                       },
                       [&](int point) { return of(point)[1]; }});
}

// The same where substructures are iterated: any place at which nothing presses is in balance. They rest as far as
// nothing is in their way; what was to the tolerance beside a large motion may need more iterations without it.
void StepRun::rest_loose_parts(int increment, const Goal& goal, Best& best) {
  constexpr int most = 3;
  if (!loose_ || assembled_ || !loose_->may_be()) return;
  const Vec carried = at_.q, uncorrected = at_.uncorrected;
  const Best before = best;
  const auto answer = [&] {
    linear_stage(at_.q, at_.velocity, true);
    at_.sums = local_stage(at_.velocity, at_.q, at_.image, true);
  };
  for (int n = 0; n < most; ++n) {
    const std::vector<Vec3> motions = loose_motions();
    if (motions.empty()) return;
    for (size_t p = 0; p < motions.size(); ++p)
      for (int d = 0; d < 3; ++d)
        if (const int i = model_.unknown(model_.exchange.ports[p], d); i >= 0)
          at_.q[i] -= local_.k()[i] * motions[p][d];  // the same force
    at_.uncorrected.resize(0);
    answer();
    if (const Outcome outcome = indicator_.measure(at_.sums); outcome.eta <= goal.tolerance) {
      best.outcome = outcome;
      best.q = at_.q;
      return;
    }
    iterate(increment, goal, best);
    if (best.outcome.eta <= goal.tolerance) continue;
    const int iterations = best.iterations;
    best = before;
    best.iterations = iterations;
    at_.q = carried;
    at_.uncorrected = uncorrected;
    answer();
    return;
  }
}

}  // namespace dygita
