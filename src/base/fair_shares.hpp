// Loops that run again and again over things that stand in order: each thread keeps a contiguous share, whose caches
// hold what it had before, and its length follows what it took.
#pragma once

#include <vector>

#include "base/parallel.hpp"
#include "base/thread_time.hpp"

namespace dygita {

class FairShares {
 public:
  // body(i) for i = 0 .. n - 1, as parallel_for has it; n_threads: 0: all.
  template <class Body>
  void run(int n, int n_threads, Body&& body) {
    if (n_threads == 0) n_threads = thread_limit();
    if (n_threads < 2 || n < n_threads) {
      parallel_for(n, body, Schedule::evenly, 1);
      return;
    }
    if (n != n_ || bounds_.size() != static_cast<size_t>(n_threads) + 1) divide_evenly(n, n_threads);
    std::vector<double> seconds(static_cast<size_t>(n_threads));
    parallel_for(
        n_threads,
        [&](int t) {
          const double start = thread_seconds();
          for (int i = bounds_[t]; i < bounds_[t + 1]; ++i) body(i);
          seconds[static_cast<size_t>(t)] = thread_seconds() - start;
        },
        Schedule::evenly, n_threads);
    follow(seconds);
  }

  void divide_evenly(int n, int n_shares);
  // Moves the bounds half way to where all shares would have taken as long, if things within one cost the same.
  void follow(const std::vector<double>& seconds);
  // First index of each share, and the number of all.
  const std::vector<int>& bounds() const { return bounds_; }

 private:
  int n_ = 0;
  std::vector<int> bounds_;
};

}  // namespace dygita
