// Ends the process where code that nothing can interrupt takes longer than it may.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <limits>
#include <mutex>
#include <string>
#include <thread>

namespace dygita {

class Watchdog {
 public:
  // Once a deadline has passed, writes what `message` answers on standard error, if anything, and ends the process with
  // `code`. `message` is called from another thread.
  Watchdog(std::function<std::string()> message, int code);
  ~Watchdog();
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

  // From now on, in seconds of std::chrono::steady_clock; costs nothing, and may be called from any thread.
  void expect_end_by(double seconds) { deadline_.store(seconds, std::memory_order_relaxed); }
  void rest() { expect_end_by(std::numeric_limits<double>::infinity()); }

 private:
  void watch();

  std::function<std::string()> message_;
  int code_;
  std::atomic<double> deadline_{std::numeric_limits<double>::infinity()};
  std::mutex mutex_;
  std::condition_variable ended_;
  bool is_ended_ = false;
  std::thread thread_;
};

}  // namespace dygita
