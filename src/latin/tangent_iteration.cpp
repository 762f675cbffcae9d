#include "latin/tangent_iteration.hpp"

#include <algorithm>
#include <limits>

#include "law/law.hpp"

namespace dygita {

namespace {

// Of the search directions, the least stiffness of what is open or slides. It keeps parts that nothing holds where they
// are until what they rest on is known; then it goes down, since it is all that slows the iteration.
constexpr double usual_softest = TangentBounds{}.softest, hard_softest = 0.1, least_softest = 1e-9;

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
    : local_(&local), system_(model), k_(k), least_(1e-9 * size), softest_(usual_softest) {}

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
  n_ = 0;
  softest_ = usual_softest;
  limits_.clear();
  tangents_ = {};
}

double TangentIteration::distance(const Vec& velocity, const Vec& q) {
  const IndicatorSums sums = local_->run(velocity, q, image_);
  return sums.force_distance + sums.velocity_distance;
}

// Friction is limited by the normal forces of an earlier iteration until what that leaves is nearly solved: each such
// problem is convex, where friction limited by forces that are far from balance sends loose parts away. The distance
// with these limits.
double TangentIteration::limit_friction(const Vec& velocity, const Vec& q) {
  constexpr double nearly = 0.3;
  const double own = distance(velocity, q);
  std::vector<double> trials = local_->normal_trials();
  if (!limits_.empty()) {
    local_->limit_friction(limits_);
    if (const double limited = distance(velocity, q); limited > nearly * nearly * own) return limited;
  }
  limits_ = std::move(trials);
  local_->limit_friction(limits_);
  return distance(velocity, q);
}

int TangentIteration::take_tangents(bool is_first) {
  TangentBounds bounds;
  bounds.softest = softest_;
  Tangents now = local_->tangents(is_first, least_, bounds);
  const int n_changed = count_changed(now, tangents_, k_, 0.1);
  if (softest_ == factorised_softest_ && count_changed(now, tangents_, k_, 1e-3) == 0) return 0;
  factorised_softest_ = softest_;
  system_.set_tangents(now);
  tangents_ = std::move(now);
  return n_changed;
}

// How far to go: the first half, quarter, ... that lessens the distance; else the best of them.
double TangentIteration::search(double before, const Vec& velocity, const Vec& q, const Vec& to_velocity,
                                const Vec& to_q) {
  double best = 1.0, least = std::numeric_limits<double>::infinity();
  for (double share = 1.0; share > 0.01; share *= 0.5) {
    const double now = distance(velocity + share * (to_velocity - velocity), q + share * (to_q - q));
    if (now < least) {
      least = now;
      best = share;
    }
    if (now < (1.0 - 0.2 * share) * before) break;
  }
  return best;
}

void TangentIteration::choose_softest(double share, int n_changed, double eta) {
  if (share < 1.0)
    softest_ = share < 0.4 ? std::min(3.0 * softest_, hard_softest) : softest_;
  else if (n_changed == 0 && eta < 1e-3)
    softest_ = std::max(softest_ / 30.0, least_softest);
  else
    softest_ = std::max(softest_ / 3.0, usual_softest);
}

void TangentIteration::advance(const Outcome& outcome, Vec& velocity, Vec& q) {
  const bool is_first = n_++ == 0;
  const double before = is_first ? distance(velocity, q) : limit_friction(velocity, q);
  const int n_changed = take_tangents(is_first);
  // W_hat and F_hat, from the image.
  Vec to_velocity = velocity + (image_ - q).cwiseQuotient(2.0 * k_);
  Vec force = image_ - k_.cwiseProduct(to_velocity);
  system_.solve(to_velocity, force);
  const Vec to_q = force + k_.cwiseProduct(to_velocity);
  const double share = is_first ? 1.0 : search(before, velocity, q, to_velocity, to_q);
  velocity += share * (to_velocity - velocity);
  q += share * (to_q - q);
  if (!is_first) choose_softest(share, n_changed, outcome.eta);
  local_->limit_friction({});
}

void TangentIteration::finish(const Vec& velocity, const Vec& q) {
  Vec own = velocity, force = q - k_.cwiseProduct(velocity);
  system_.solve(own, force);
  system_.set_velocities();
}

}  // namespace dygita
