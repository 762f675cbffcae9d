#include "base/aside.hpp"

#include <signal.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

#include "base/progress.hpp"
#include "base/task.hpp"

namespace dygita {

namespace {

std::atomic<int> n_abandonable = 0;

// METIS catches SIGTERM while it runs, and jumps to where only its own thread may go.
class OurHandler {
 public:
  OurHandler() { sigaction(SIGTERM, nullptr, &own_); }
  void put_back() const {
    if (!interrupt_requested()) sigaction(SIGTERM, &own_, nullptr);
  }

 private:
  struct sigaction own_ {};
};

struct Job {
  std::mutex mutex;
  std::condition_variable ended;
  bool is_over = false;
  std::exception_ptr error;
};

}  // namespace

MayBeAbandoned::MayBeAbandoned(bool may) : may_(may) { n_abandonable += may_; }

MayBeAbandoned::~MayBeAbandoned() { n_abandonable -= may_; }

void give_up_if_stopped() {
  if (n_abandonable > 0 && interrupt_requested()) throw Abandoned();
}

void do_aside(std::function<void()> work) {
  constexpr auto most_between = std::chrono::milliseconds(100);
  const OurHandler handler;
  auto job = std::make_shared<Job>();
  std::thread([job, work = std::move(work)]() mutable {
    std::exception_ptr error;
    try {
      work();
    } catch (...) {
      error = std::current_exception();
    }
    work = nullptr;
    const std::scoped_lock lock(job->mutex);
    job->is_over = true;
    job->error = error;
    job->ended.notify_one();
  }).detach();
  std::unique_lock lock(job->mutex);
  for (auto between = std::chrono::milliseconds(1); !job->ended.wait_for(lock, between, [&] { return job->is_over; });
       between = std::min(2 * between, most_between)) {
    lock.unlock();
    handler.put_back();
    heed_interrupt();
    give_up_if_stopped();
    lock.lock();
  }
  if (job->error) std::rethrow_exception(job->error);
}

}  // namespace dygita
