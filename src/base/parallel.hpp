// Work shared among threads: the only place that opens a parallel region, so that whatever a loop throws is caught in
// its thread and reaches the caller.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <mutex>

#include "base/team.hpp"
#include "base/threads.hpp"

namespace dygita {

// What a loop has thrown: of several errors the one of the lowest index, so that a message does not depend on the
// number of threads.
class LoopError {
 public:
  // Has an earlier index failed? What follows it need not run.
  bool precedes(int i) const noexcept { return index_.load(std::memory_order_relaxed) < i; }
  // In a handler: keeps the exception at hand.
  void keep(int i) noexcept {
    const std::scoped_lock lock(mutex_);
    if (precedes(i)) return;
    error_ = std::current_exception();
    index_.store(i, std::memory_order_relaxed);
  }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::atomic<int> index_ = std::numeric_limits<int>::max();
  std::mutex mutex_;
  std::exception_ptr error_;
};

// How the indices are dealt to the threads: contiguous shares of equal length, or the next one to whoever is free.
enum class Schedule { evenly, as_free };

// body(i) for i = 0 .. n - 1, on at most so many threads (0: all; 1: on the caller's), each with denormals flushed.
// Inside another such loop it runs on one thread. Bodies must not wait for each other. Throws what the body of the
// lowest failing index has thrown, once all threads are back; indices above it may not have run.
template <class Body>
void parallel_for(int n, Body&& body, Schedule schedule = Schedule::as_free, int most_threads = 0) {
  const int n_threads = is_in_team() ? 1 : std::min(n, most_threads > 0 ? most_threads : thread_limit());
  if (n_threads < 2) {
    flush_denormals();
    for (int i = 0; i < n; ++i) body(i);
    return;
  }
  LoopError error;
  const auto guarded = [&](int i) noexcept {
    if (error.precedes(i)) return;
    try {
      body(i);
    } catch (...) {
      error.keep(i);
    }
  };
  std::atomic<int> next = 0;
  run_on_team(n_threads, [&](int t) noexcept {
    flush_denormals();
    if (schedule == Schedule::evenly) {
      const auto bound = [&](int share) { return static_cast<int>(std::int64_t{n} * share / n_threads); };
      for (int i = bound(t); i < bound(t + 1); ++i) guarded(i);
    } else {
      for (int i; (i = next.fetch_add(1, std::memory_order_relaxed)) < n;) guarded(i);
    }
  });
  error.rethrow();
}

// body(first, n) for ranges that together are [0, n_all): ranges of the same length for any number of threads.
// most_threads: as parallel_for has it.
template <class Body>
void parallel_for_ranges(std::ptrdiff_t n_all, Body&& body, std::ptrdiff_t length = 1024, int most_threads = 0) {
  const int n_ranges = static_cast<int>((n_all + length - 1) / length);
  parallel_for(
      n_ranges,
      [&](int i) {
        const std::ptrdiff_t first = i * length;
        body(first, std::min(length, n_all - first));
      },
      Schedule::evenly, most_threads);
}

}  // namespace dygita
