#include "latin/tangent_iteration.hpp"

#include <algorithm>

#include "law/law_slope.hpp"

namespace dygita {

namespace {

// How many points answer otherwise than before, by so much of their search directions.
int count_changed(const Tangents& now, const Tangents& before, const Vec& k, double share) {
  if (before.points.empty()) return static_cast<int>(now.points.size());
  int n = 0;
  for (size_t i = 0; i < now.points.size(); ++i) {
    const PointTangent &a = now.points[i], &b = before.points[i];
    if (a.unknowns.empty()) continue;
    const double size = std::max({a.matrix.norm(), b.matrix.norm(), k[a.unknowns.front()]});
    if ((a.matrix - b.matrix).norm() > share * size) ++n;
  }
  return n;
}

}  // namespace

TangentIteration::TangentIteration(const StepModel& model, LocalStage& local, const Vec& k, double size)
    : local_(&local), system_(model), k_(k), least_(1e-9 * size) {}

void TangentIteration::linear_stage(const Vec& q, Vec& velocity) {
  Tangents tangents;
  for (const std::vector<int>& unknowns : system_.unknowns_of_points()) {
    const Vec own = k_(unknowns);
    tangents.points.push_back({unknowns, own.asDiagonal()});
  }
  system_.set_tangents(std::move(tangents));
  velocity = Vec::Zero(q.size());
  Vec force = q;
  system_.solve(velocity, force);
}

void TangentIteration::begin() {
  steps_.begin();
  tangents_ = {};
}

double TangentIteration::distance(const Vec& velocity, const Vec& q, const std::vector<double>& limits) {
  local_->limit_friction(limits);
  const IndicatorSums sums = local_->run(velocity, q, image_);
  return sums.force_distance + sums.velocity_distance;
}

int TangentIteration::take_tangents() {
  TangentBounds bounds;
  bounds.softest = steps_.softest();
  Tangents now = local_->tangents(steps_.is_first(), least_, bounds);
  const int n_changed = count_changed(now, tangents_, k_, 0.1);
  if (bounds.softest == factorised_softest_ && count_changed(now, tangents_, k_, 1e-3) == 0) return 0;
  factorised_softest_ = bounds.softest;
  system_.set_tangents(now);
  tangents_ = std::move(now);
  return n_changed;
}

void TangentIteration::advance(const Outcome& outcome, Vec& velocity, Vec& q) {
  const double before =
      steps_.begin_step([&](const std::vector<double>& limits) { return distance(velocity, q, limits); },
                        [&] { return local_->normal_trials(); });
  const int n_changed = take_tangents();
  // W_hat and F_hat, from the image.
  Vec to_velocity = velocity + (image_ - q).cwiseQuotient(2.0 * k_);
  Vec force = image_ - k_.cwiseProduct(to_velocity);
  system_.solve(to_velocity, force);
  const Vec to_q = force + k_.cwiseProduct(to_velocity);
  const auto that_far = [&](double share) {
    return distance(velocity + share * (to_velocity - velocity), q + share * (to_q - q), steps_.limits());
  };
  const double share = steps_.end_step(before, that_far, n_changed, outcome.eta);
  velocity += share * (to_velocity - velocity);
  q += share * (to_q - q);
  local_->limit_friction({});
}

void TangentIteration::finish(const Vec& velocity, const Vec& q) {
  Vec own = velocity, force = q - k_.cwiseProduct(velocity);
  system_.solve(own, force);
  system_.set_velocities();
}

}  // namespace dygita
