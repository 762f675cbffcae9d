// When iterations that have not reached the tolerance end.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "step/solver_figures.hpp"

namespace dygita {

// How many iterations an increment gets: `most` where the deck says so; else `least`, and on to `most` as long as the
// later half of them has halved the indicator.
struct IterationLimit {
  int least = 200, most = 200;
};

// The best indicator so far, every now and then, of the iterations of an increment or a window.
class Persistence {
 public:
  explicit Persistence(IterationLimit limit) : limit_(limit) {}

  // After n iterations, the best of which left `best`: is it time to give up?
  bool ends(int n, double best) {
    if (n % every == 0) marks_.push_back(best);
    n_ = n;
    best_ = best;
    if (n >= limit_.most) return true;
    return n >= limit_.least && n % (10 * every) == 0 && !is_falling();
  }
  // Has the later half of the iterations halved the indicator?
  bool is_falling() const { return best_ < 0.5 * halfway(); }
  // What to tell of an increment that ends so.
  Missed missed(int increment, double tolerance) const {
    Missed missed{increment, n_, best_, tolerance, is_falling(), {}};
    if (missed.is_falling && half() > 0) missed.halving = (n_ - every * half()) / std::log2(halfway() / best_);
    return missed;
  }

 private:
  static constexpr int every = 5;
  int half() const { return static_cast<int>(marks_.size()) / 2; }
  double halfway() const { return half() > 0 ? marks_[half() - 1] : std::numeric_limits<double>::infinity(); }

  IterationLimit limit_;
  std::vector<double> marks_;  // best after each `every` iterations
  int n_ = 0;
  double best_ = 0.0;
};

}  // namespace dygita
