// Long work without a word within it, which the user may stop nevertheless.
#pragma once

#include <exception>
#include <functional>

namespace dygita {

// The user has stopped what was going on; what was finished before it counts.
class Abandoned : public std::exception {
 public:
  const char* what() const noexcept override { return "stopped by the user"; }
};

// While there is one, what goes on may be abandoned: whoever has made it catches Abandoned.
class MayBeAbandoned {
 public:
  explicit MayBeAbandoned(bool may = true);
  ~MayBeAbandoned();
  MayBeAbandoned(const MayBeAbandoned&) = delete;
  MayBeAbandoned& operator=(const MayBeAbandoned&) = delete;

 private:
  bool may_;
};

// Throws Abandoned where the user wants to stop and that may be.
void give_up_if_stopped();

// Does `work`, which nothing can interrupt, on a thread of its own, and throws what it throws. Where the user stops it,
// throws Abandoned or Interrupted; the work then goes on until the process ends, and must own all that it touches.
void do_aside(std::function<void()> work);

}  // namespace dygita
