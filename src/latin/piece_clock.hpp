// What pieces take of a processor, whoever else runs on it.
#pragma once

#include <vector>

#include "base/thread_time.hpp"

namespace dygita {

class PieceClock {
 public:
  // Adds the seconds of this thread until it is gone, in equal shares, to those of the pieces; sums: empty: to none.
  PieceClock(std::vector<double>& sums, const std::vector<int>& pieces)
      : sums_(sums),
        pieces_(sums.empty() ? std::vector<int>() : pieces),
        start_(sums.empty() ? 0.0 : thread_seconds()) {}
  ~PieceClock() {
    if (pieces_.empty()) return;
    const double share = (thread_seconds() - start_) / static_cast<double>(pieces_.size());
    for (const int i : pieces_) sums_[static_cast<size_t>(i)] += share;
  }
  PieceClock(const PieceClock&) = delete;
  PieceClock& operator=(const PieceClock&) = delete;

 private:
  std::vector<double>& sums_;
  std::vector<int> pieces_;
  double start_;
};

}  // namespace dygita
