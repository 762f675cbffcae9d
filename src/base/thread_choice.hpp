// Whether a loop that comes again and again is faster on all threads or on one: where little is done between two
// meetings of the threads, that depends on the machine and on who else runs on it.
#pragma once

#include <algorithm>
#include <array>
#include <limits>

namespace dygita {

class ThreadChoice {
 public:
  enum Threads { all = 0, one = 1 };  // as parallel_for has them

  // Always the same.
  explicit ThreadChoice(Threads always = all) : now_(always) {}
  static ThreadChoice measured() {
    ThreadChoice choice;
    choice.has_choice_ = true;
    return choice;
  }

  int threads() const { return now_; }
  // The loop has been run so. Both are tried, the faster one is taken for a while, then they are tried again.
  void note(double seconds) {
    if (!has_choice_) return;
    if (n_ < 2 * trials) least_[now_] = std::min(least_[now_], seconds);
    n_ = (n_ + 1) % (2 * trials + between);
    if (n_ == 0) least_ = untried;
    now_ = n_ < trials ? all : n_ < 2 * trials ? one : least_[all] < least_[one] ? all : one;
  }

 private:
  static constexpr int trials = 2, between = 76;  // loops
  static constexpr std::array<double, 2> untried{std::numeric_limits<double>::infinity(),
                                                 std::numeric_limits<double>::infinity()};
  bool has_choice_ = false;
  Threads now_;
  int n_ = 0;
  std::array<double, 2> least_ = untried;  // s
};

}  // namespace dygita
