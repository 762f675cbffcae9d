// Runs that take turns on one thread: each goes on until it asks for something that costs less for several at once.
#pragma once

#include <exception>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace dygita {

// What a run waits for. It is served together with what others ask for, the most urgent first, once none can go on.
struct Asked {
  explicit Asked(int of) : urgency(of) {}
  virtual ~Asked() = default;
  Asked(const Asked&) = delete;
  Asked& operator=(const Asked&) = delete;
  // Serves all, which are of this urgency, this the first of them. A throw reaches all of those runs.
  virtual void serve(std::span<Asked* const> all) = 0;

  const int urgency;  // 0: the most urgent
};

class Turns {
 public:
  // Runs all to their ends; each has a stack of its own. What they throw is thrown at the end, that of the first in
  // order. enter(i), leave(i): around each turn of run i, on the caller's stack.
  static void run(const std::vector<std::function<void()>>& runs, const std::function<void(int)>& enter = nullptr,
                  const std::function<void(int)>& leave = nullptr);
  // Whose runs the caller is one of; null: it is none.
  static Turns* at_hand();
  // Of such a run, not within a loop on threads nor while it handles an exception. Returns once it has been served.
  void ask(Asked& what);

  ~Turns();
  Turns(const Turns&) = delete;
  Turns& operator=(const Turns&) = delete;

 private:
  struct One;
  Turns(const std::vector<std::function<void()>>& runs, const std::function<void(int)>& enter,
        const std::function<void(int)>& leave);
  void run_all();
  void go_on(int i);
  void serve();
  static void begin(unsigned high, unsigned low);

  std::vector<std::unique_ptr<One>> all_;
  const std::function<void(int)>&enter_, &leave_;
  One* now_ = nullptr;
};

}  // namespace dygita
