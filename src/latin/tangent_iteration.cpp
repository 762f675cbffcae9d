#include "latin/tangent_iteration.hpp"

#include <algorithm>
#include <cmath>

#include "law/law_slope.hpp"

namespace dygita {

namespace {

// How many points answer otherwise than before: by a thousandth of their search directions, which a factor must know;
// by a tenth of what they answer, as where contact opens or closes.
struct Changed {
  int other = 0, turned = 0;
};

Changed changed(const Tangents& now, const Tangents& before, const Vec& k) {
  const int n = static_cast<int>(now.points.size());
  if (before.points.empty()) return {n, n};
  Changed count;
  for (size_t i = 0; i < now.points.size(); ++i) {
    const PointTangent &a = now.points[i], &b = before.points[i];
    if (a.unknowns.empty()) continue;
    const double own = k[a.unknowns.front()], change = (a.matrix - b.matrix).norm();
    count.other += change > 1e-3 * own;
    count.turned += change > 0.1 * std::max({a.matrix.norm(), b.matrix.norm(), own});
  }
  return count;
}

}  // namespace

TangentIteration::TangentIteration(const StepModel& model, LocalStage& local, const Vec& k, double size)
    : local_(&local), system_(model), k_(k), least_(1e-9 * size) {}

void TangentIteration::linear_stage(const Vec& q, Vec& velocity) {
  if (!has_usual_factor_) take_usual_factor();
  system_.set_own();
  velocity = Vec::Zero(q.size());
  Vec force = q;
  system_.solve(velocity, force);
}

// With the search directions in place of tangents.
void TangentIteration::take_usual_factor() {
  Tangents tangents;
  for (const std::vector<int>& unknowns : system_.unknowns_of_points()) {
    const Vec own = k_(unknowns);
    PointTangent& tangent = tangents.points.emplace_back();
    tangent.unknowns = unknowns;
    tangent.matrix = own.asDiagonal();
  }
  system_.set_tangents(std::move(tangents));
  has_usual_factor_ = true;
  factorised_ = {};
}

void TangentIteration::begin(double tolerance) {
  tolerance_ = tolerance;
  steps_.begin();
  before_ = {};
  most_since_ = static_cast<int>(system_.unknowns_of_points().size()) / 8;
}

double TangentIteration::distance(const Vec& velocity, const Vec& q, const std::vector<double>& limits) {
  local_->limit_friction(limits);
  const IndicatorSums sums = local_->run(velocity, q, image_);
  return sums.force_distance + sums.velocity_distance;
}

// Where a soft part lies between stiff ones, ties between unlike meshes have tractions that hardly move their sides:
// the stiffer the tie, the fewer iterations these take. Its motion carries rounding, which is to leave forces that
// agree to a tenth of the tolerance.
void TangentIteration::choose_tie(const Outcome& outcome) {
  constexpr double rounding = 2e-16, least = TangentBounds{}.stiffest, most = 1e6;
  const double motion = outcome.size - outcome.force_size;  // W, as the forces are
  const double own = motion > 0.0 ? 0.1 * tolerance_ / rounding * std::sqrt(outcome.force_size / motion) : most;
  if (own >= tie_ && own < 100.0 * tie_) return;
  tie_ = std::pow(10.0, std::floor(std::log10(std::clamp(own, least, most)) + 1e-9));
}

// How many points have turned since the iteration before.
int TangentIteration::take_tangents() {
  TangentBounds bounds;
  bounds.softest = steps_.softest();
  bounds.tie = tie_;
  Tangents now = local_->tangents(steps_.is_first(), steps_.follows(), least_, bounds);
  n_turned_ = changed(now, before_, k_).turned;
  const Changed since = changed(now, factorised_, k_);
  before_ = std::move(now);
  n_since_ = since.turned;
  if (bounds.softest == factorised_softest_ && since.other == 0)
    system_.set_following(before_);
  else if (since.turned <= most_since_ && n_spent_ < system_.most_products())
    system_.set_other_tangents(before_, k_);
  else
    factorise();
  // Of many points a few turn to and fro as long as nothing is exact.
  constexpr int few_of = 1000;
  return n_turned_ * few_of > static_cast<int>(before_.points.size()) ? n_turned_ : 0;
}

void TangentIteration::factorise() {
  has_usual_factor_ = false;
  factorised_ = {};  // of none, should it fail
  factorised_softest_ = steps_.softest();
  system_.set_tangents(before_);
  factorised_ = before_;
  n_since_ = n_spent_ = 0;
}

// From the fields at hand to those that the tangents lead to. False: they were not found. Far from the solution the
// next tangents are others anyway, so that a rough answer is worth as much.
bool TangentIteration::solve(Vec& velocity, Vec& force, double eta) {
  const bool is_found = system_.solve(velocity, force, eta > 1e-4 ? 1e-2 : 1e-3);
  if (system_.has_others()) n_spent_ += system_.n_products();
  if (is_found || !system_.has_others()) return is_found;
  most_since_ = n_since_ / 2;
  factorise();
  return system_.solve(velocity, force);
}

void TangentIteration::advance(const Outcome& outcome, Vec& velocity, Vec& q) {
  const double before =
      steps_.begin_step([&](const std::vector<double>& limits) { return distance(velocity, q, limits); },
                        [&] { return local_->normal_trials(); }, outcome.eta);
  choose_tie(outcome);
  const int n_changed = take_tangents();
  // W_hat and F_hat, from the image.
  Vec to_velocity = velocity + (image_ - q).cwiseQuotient(2.0 * k_);
  Vec force = image_ - k_.cwiseProduct(to_velocity);
  if (!solve(to_velocity, force, outcome.eta)) return steps_.cannot_follow();
  const Vec to_q = force + k_.cwiseProduct(to_velocity);
  const auto that_far = [&](double share) {
    return distance(velocity + share * (to_velocity - velocity), q + share * (to_q - q), steps_.limits());
  };
  const double share = steps_.end_step(before, that_far, n_changed, outcome.eta);
  velocity += share * (to_velocity - velocity);
  q += share * (to_q - q);
  local_->limit_friction({});
}

Vec TangentIteration::finish(const Vec& velocity, const Vec& q) {
  Vec own = velocity, force = q - k_.cwiseProduct(velocity);
  system_.set_own();
  system_.solve(own, force);
  system_.set_velocities();
  return force + k_.cwiseProduct(own);
}

}  // namespace dygita
