#include "base/watchdog.hpp"

#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>

#include "base/names.hpp"

namespace dygita {

// Signals go to the threads that know what to do with them.
Watchdog::Watchdog(std::function<std::string()> message, int code) : message_(std::move(message)), code_(code) {
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::thread([this] { watch(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

Watchdog::~Watchdog() {
  {
    const std::scoped_lock lock(mutex_);
    is_ended_ = true;
  }
  ended_.notify_one();
  thread_.join();
}

void Watchdog::watch() {
  using namespace std::chrono;
  constexpr auto looks_every = milliseconds(250);
  std::unique_lock lock(mutex_);
  while (!ended_.wait_for(lock, looks_every, [this] { return is_ended_; })) {
    if (duration<double>(steady_clock::now().time_since_epoch()).count() <= deadline_.load(std::memory_order_relaxed))
      continue;
    const std::string text = message_();
    if (!text.empty()) std::fprintf(stderr, "%s\n", printable(text).c_str());
    _exit(code_);  // no destructors: whoever is stuck may hold what they wait for
  }
}

}  // namespace dygita
