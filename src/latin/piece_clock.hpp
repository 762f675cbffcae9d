// What pieces take of a processor, whoever else runs on it.
#pragma once

#include <ctime>
#include <vector>

namespace dygita {

class PieceClock {
 public:
  // Adds the seconds of this thread until it is gone, in equal shares, to those of the pieces; sums: empty: to none.
  PieceClock(std::vector<double>& sums, const std::vector<int>& pieces)
      : sums_(sums), pieces_(sums.empty() ? std::vector<int>() : pieces), start_(sums.empty() ? 0.0 : now()) {}
  ~PieceClock() {
    if (pieces_.empty()) return;
    const double share = (now() - start_) / static_cast<double>(pieces_.size());
    for (const int i : pieces_) sums_[static_cast<size_t>(i)] += share;
  }
  PieceClock(const PieceClock&) = delete;
  PieceClock& operator=(const PieceClock&) = delete;

 private:
  static double now() {
    std::timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  }
  std::vector<double>& sums_;
  std::vector<int> pieces_;
  double start_;
};

}  // namespace dygita
