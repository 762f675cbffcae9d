#include "step/tangent_steps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "law/law_slope.hpp"

namespace dygita {

namespace {

// Of the search directions, the least stiffness of what is open or slides. It keeps parts that nothing holds where they
// are until what they rest on is known; then it goes down, since it is all that slows the iteration.
constexpr double usual_softest = TangentBounds{}.softest, hard_softest = 0.1, least_softest = 1e-9;

constexpr double near = 1e-2;  // of the indicator: friction follows

}  // namespace

void TangentSteps::begin() {
  n_ = 0;
  softest_ = usual_softest;
  limits_.clear();
  follows_ = false;
  n_in_vain_ = n_to_wait_ = 0;
  rises_below_ = std::numeric_limits<double>::infinity();
}

// Friction is limited by the normal forces of an earlier iteration until what that leaves is nearly solved: each such
// problem is convex, where friction limited by forces that are far from balance sends loose parts away. Near the
// solution it is limited by those at hand: limits a step behind would come closer by the same factor each time.
double TangentSteps::begin_step(const Distance& distance, const std::function<std::vector<double>()>& trials,
                                double eta) {
  constexpr double nearly = 0.3;
  const double own = distance({});
  if (is_first() || follows_) return own;
  std::vector<double> at_hand = trials();
  if (!limits_.empty())
    if (const double limited = distance(limits_); limited > nearly * nearly * own) return limited;
  follows_ = eta < near && !limits_.empty() && n_to_wait_-- <= 0;
  limits_ = follows_ ? std::vector<double>() : std::move(at_hand);
  return distance(limits_);
}

void TangentSteps::cannot_follow() {
  constexpr int most_problems = 4;
  follows_ = false;
  n_to_wait_ = std::min(++n_in_vain_, most_problems);
}

// A few points that open or slide may make the distance rise, and the step after it finds where they belong: steps cut
// for them take many. So where friction follows the distance may rise, again once it is half of what it rose from.
double TangentSteps::end_step(double before, const std::function<double(double)>& distance, int n_changed, double eta) {
  if (n_++ == 0) return 1.0;
  constexpr double most_rise = 10.0;
  const bool may_rise = follows_ && before < rises_below_;
  double best = 1.0, least = std::numeric_limits<double>::infinity();
  bool falls = false;
  for (double share = 1.0; share > 0.01 && !falls; share *= 0.5) {
    const double now = distance(share);
    falls = share == 1.0 && n_changed == 0 && std::abs(now - before) < 1e-6 * before;
    if (now < least) {
      least = now;
      best = share;
    }
    if (now < (1.0 - 0.2 * share) * before || (may_rise && now < most_rise * before)) break;
  }
  if (follows_ && least <= 0.9 * before)
    n_in_vain_ = 0;
  else if (may_rise && best == 1.0)
    rises_below_ = 0.5 * before;
  else if (follows_)
    cannot_follow();
  choose_softest(best, n_changed, falls || eta < 1e-3);
  return best;
}

// What falls across a gap under a small force keeps its distance until it lands: so soft that it lands at once.
void TangentSteps::choose_softest(double share, int n_changed, bool is_quiet) {
  if (share < 1.0)
    softest_ = share < 0.4 ? std::min(3.0 * softest_, hard_softest) : softest_;
  else if (n_changed == 0 && is_quiet)
    softest_ = std::max(softest_ / 30.0, least_softest);
  else
    softest_ = std::max(softest_ / 3.0, usual_softest);
}

}  // namespace dygita
