#include "base/team.hpp"

#include <immintrin.h>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "base/log.hpp"
#include "base/threads.hpp"

namespace dygita {
namespace {

// How long a thread stays awake: longer than what one thread does alone between two loops of a time step.
constexpr std::chrono::microseconds awake(500);
constexpr int n_looks = 64;  // before it gives way for the first time

// Returns once the value is another than `old`.
void wait_while(const std::atomic<unsigned>& value, unsigned old) {
  for (int look = 0; look < n_looks; ++look) {
    if (value.load(std::memory_order_acquire) != old) return;
    _mm_pause();
  }
  const auto end = std::chrono::steady_clock::now() + awake;
  do {
    sched_yield();
    if (value.load(std::memory_order_acquire) != old) return;
  } while (std::chrono::steady_clock::now() < end);
  value.wait(old, std::memory_order_acquire);
}

thread_local bool is_member = false;

class Team {
 public:
  // False where another thread has the team.
  bool run(int n, TeamWork work, void* context) {
    const std::unique_lock lock(busy_, std::try_to_lock);
    if (!lock) return false;
    const int n_members = grow(n - 1);
    job_ = {work, context};
    for (int i = 0; i < n_members; ++i) members_[static_cast<size_t>(i)]->call();
    is_member = true;
    work(context, 0);
    for (int t = n_members + 1; t < n; ++t) work(context, t);
    for (int i = 0; i < n_members; ++i)
      if (members_[static_cast<size_t>(i)]->takes_over()) work(context, i + 1);
    is_member = false;
    for (int i = 0; i < n_members; ++i) members_[static_cast<size_t>(i)]->wait();
    return true;
  }

 private:
  struct Job {
    TeamWork work;
    void* context;
  };

  // A share of each job and the thread for it. Whoever comes first computes it: the caller, once it is through with its
  // own, does not wait for a thread that still sleeps or has no processor. Counters of jobs, on a cache line of their
  // own: the thread looks at the first all the time.
  class alignas(64) Member {
   public:
    // Of the caller.
    void call() {
      n_called_.store(++n_, std::memory_order_release);
      n_called_.notify_one();
    }
    bool takes_over() { return is_own_ = take(n_); }
    void wait() const {
      if (is_own_) return;
      for (unsigned done; (done = n_done_.load(std::memory_order_acquire)) != n_;) wait_while(n_done_, done);
    }

    // Of the thread.
    [[noreturn]] void serve(const Job& job, int t) {
      flush_denormals();
      is_member = true;
      for (unsigned seen = 0;;) {
        wait_while(n_called_, seen);
        seen = n_called_.load(std::memory_order_acquire);
        if (!take(seen)) continue;
        job.work(job.context, t);
        n_done_.store(seen, std::memory_order_release);
        n_done_.notify_one();
      }
    }

   private:
    bool take(unsigned job) {
      unsigned before = job - 1;
      return n_taken_.compare_exchange_strong(before, job, std::memory_order_acq_rel);
    }

    std::atomic<unsigned> n_called_ = 0, n_taken_ = 0, n_done_ = 0;
    unsigned n_ = 0;       // the caller's
    bool is_own_ = false;  // has the caller done the last one?
  };

  // As many members as wanted, or as the system gives.
  int grow(int wanted) {
    while (static_cast<int>(members_.size()) < wanted) {
      auto member = std::make_unique<Member>();
      const int t = static_cast<int>(members_.size()) + 1;
      try {
        std::thread([this, own = member.get(), t] { own->serve(job_, t); }).detach();
      } catch (const std::system_error&) {
        break;
      }
      members_.push_back(std::move(member));
    }
    return std::min(wanted, static_cast<int>(members_.size()));
  }

  std::mutex busy_;
  Job job_{};
  std::vector<std::unique_ptr<Member>> members_;
};

int limit_at_start() {
  if (const char* asked = std::getenv("OMP_NUM_THREADS")) {
    if (const int n = std::atoi(asked); n > 0) return n;
    warn(fmt::format("OMP_NUM_THREADS='{}' is not a number of threads: one per processor is used", asked));
  }
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof allowed, &allowed) == 0) return std::max(1, CPU_COUNT(&allowed));
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

std::atomic<int>& limit() {
  static std::atomic<int> n = limit_at_start();
  return n;
}

}  // namespace

int thread_limit() { return limit().load(std::memory_order_relaxed); }

void set_thread_limit(int n) { limit().store(std::max(1, n), std::memory_order_relaxed); }

bool is_in_team() { return is_member; }

void run_on_team(int n, TeamWork work, void* context) {
  static Team& team = *new Team;  // its members wait there until the process ends
  if (n > 1 && !is_in_team() && team.run(n, work, context)) return;
  for (int t = 0; t < n; ++t) work(context, t);
}

}  // namespace dygita
