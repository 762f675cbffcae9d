#include "base/turns.hpp"

#include <sys/mman.h>
#include <ucontext.h>
#include <unistd.h>

#include <cstdint>
#include <new>
#include <utility>

#include "base/error.hpp"
#include "base/team.hpp"

#if defined(__SANITIZE_ADDRESS__)
#define DYGITA_ADDRESS_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define DYGITA_ADDRESS_SANITIZER 1
#endif
#endif
#ifdef DYGITA_ADDRESS_SANITIZER
#include <sanitizer/asan_interface.h>
#include <sanitizer/common_interface_defs.h>
#endif

namespace dygita {

// Not anonymous: Turns::One, which is not, has members of these.
namespace turning {

// As large as that of a process; pages that are not touched cost nothing, and one below it ends who goes too far.
class Stack {
 public:
  Stack() : at_(mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0)) {
    if (at_ == MAP_FAILED) throw std::bad_alloc();
    mprotect(at_, static_cast<size_t>(sysconf(_SC_PAGESIZE)), PROT_NONE);
  }
  ~Stack() {
#ifdef DYGITA_ADDRESS_SANITIZER
    __asan_unpoison_memory_region(at_, size);  // of calls that never return: somebody else may be given these pages
#endif
    munmap(at_, size);
  }
  Stack(const Stack&) = delete;
  Stack& operator=(const Stack&) = delete;
  void* at() const { return at_; }

  static constexpr size_t size = size_t{8} << 20;

 private:
  void* at_;
};

// The sanitizer of addresses is told which stack it is on.
struct Place {
  ucontext_t context{};
  void* fake = nullptr;
  const void* bottom = nullptr;
  size_t size = 0;
};

inline void change(Place& from, Place& to, [[maybe_unused]] bool is_last = false) {
#ifdef DYGITA_ADDRESS_SANITIZER
  __sanitizer_start_switch_fiber(is_last ? nullptr : &from.fake, to.bottom, to.size);
#endif
  CHECK(swapcontext(&from.context, &to.context) == 0, "a run cannot be gone on with");
#ifdef DYGITA_ADDRESS_SANITIZER
  __sanitizer_finish_switch_fiber(from.fake, nullptr, nullptr);
#endif
}

inline void arrive([[maybe_unused]] Place& came_from) {
#ifdef DYGITA_ADDRESS_SANITIZER
  __sanitizer_finish_switch_fiber(nullptr, &came_from.bottom, &came_from.size);
#endif
}

// By itself, for it may return twice as far as the compiler knows.
[[gnu::noinline]] bool is_begun(ucontext_t& context) { return getcontext(&context) == 0; }

}  // namespace turning

using turning::change;

namespace {

thread_local Turns* turns_at_hand = nullptr;

}  // namespace

struct Turns::One {
  explicit One(const std::function<void()>& run) : body(&run) {}

  const std::function<void()>* body;
  turning::Stack stack{};
  turning::Place place{}, caller{};
  Asked* asked = nullptr;
  std::exception_ptr thrown{}, refused{};  // by the run; by what it has asked for
  bool is_over = false;
};

Turns::Turns(const std::vector<std::function<void()>>& runs, const std::function<void(int)>& enter,
             const std::function<void(int)>& leave)
    : enter_(enter), leave_(leave) {
  for (const std::function<void()>& body : runs) {
    all_.push_back(std::make_unique<One>(body));
    One& one = *all_.back();
    CHECK(turning::is_begun(one.place.context), "a run cannot be begun");
    one.place.context.uc_stack.ss_sp = const_cast<void*>(one.place.bottom = one.stack.at());
    one.place.context.uc_stack.ss_size = one.place.size = turning::Stack::size;
    const auto address = reinterpret_cast<std::uintptr_t>(this);
    makecontext(&one.place.context, reinterpret_cast<void (*)()>(&Turns::begin), 2,
                static_cast<unsigned>(address >> 32), static_cast<unsigned>(address));
  }
}

Turns::~Turns() = default;

Turns* Turns::at_hand() { return turns_at_hand && turns_at_hand->now_ ? turns_at_hand : nullptr; }

// The first thing on a new stack, and the last.
void Turns::begin(unsigned high, unsigned low) {
  auto* const turns = reinterpret_cast<Turns*>((static_cast<std::uintptr_t>(high) << 32) | low);
  One& one = *turns->now_;
  turning::arrive(one.caller);
  try {
    (*one.body)();
  } catch (...) {
    one.thrown = std::current_exception();
  }
  one.is_over = true;
  change(one.place, one.caller, true);
}

void Turns::ask(Asked& what) {
  CHECK(now_ && !is_in_team(), "a run asks for something between its loops on threads");
  CHECK(!std::current_exception(), "a run asks for nothing while it handles an exception");
  One& one = *now_;
  one.asked = &what;
  change(one.place, one.caller);
  if (one.refused) std::rethrow_exception(std::exchange(one.refused, nullptr));
}

void Turns::go_on(int i) {
  One& one = *all_[static_cast<size_t>(i)];
  if (enter_) enter_(i);
  now_ = &one;
  change(one.caller, one.place);
  now_ = nullptr;
  if (leave_) leave_(i);
}

void Turns::serve() {
  int most_urgent = -1;
  std::vector<One*> who;
  for (const auto& one : all_)
    if (one->asked && (most_urgent < 0 || one->asked->urgency < most_urgent)) most_urgent = one->asked->urgency;
  std::vector<Asked*> what;
  for (const auto& one : all_)
    if (one->asked && one->asked->urgency == most_urgent) {
      who.push_back(one.get());
      what.push_back(one->asked);
      one->asked = nullptr;
    }
  try {
    what.front()->serve(what);
  } catch (...) {
    for (One* const one : who) one->refused = std::current_exception();
  }
}

void Turns::run_all() {
  const auto n = static_cast<int>(all_.size());
  for (bool goes_on = true; goes_on;) {
    goes_on = false;
    for (int i = 0; i < n; ++i) {
      const One& one = *all_[static_cast<size_t>(i)];
      if (!one.is_over && !one.asked) go_on(i);
      goes_on |= !one.is_over;
    }
    if (goes_on) serve();
  }
}

void Turns::run(const std::vector<std::function<void()>>& runs, const std::function<void(int)>& enter,
                const std::function<void(int)>& leave) {
  CHECK(!turns_at_hand, "runs that take turns have none within them");
  Turns turns(runs, enter, leave);
  turns_at_hand = &turns;
  turns.run_all();
  turns_at_hand = nullptr;
  for (const auto& one : turns.all_)
    if (one->thrown) std::rethrow_exception(one->thrown);
}

}  // namespace dygita
