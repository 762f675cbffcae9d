// What goes on without increments says what it does and ends where the user wants it.
#pragma once

#include <chrono>
#include <exception>
#include <mutex>
#include <string>

namespace dygita {

// Something without increments: meshes, the search of contacts, outputs. Says nothing unless it takes a while: a line
// in place on a terminal, gone at the end, a line every ten seconds in a log. Any thread may tell.
class Task {
 public:
  // May the user end it, or has it to come to its end?
  enum class Interrupts { end_it, wait };

  explicit Task(std::string label, int total = 0, Interrupts interrupts = Interrupts::end_it);
  ~Task();
  Task(const Task&) = delete;
  Task& operator=(const Task&) = delete;

  // Another of `total` is done, `what` is its name; or what goes on. Both heed_interrupt().
  void done(const std::string& what);
  void tell(const std::string& doing);

 private:
  friend void heed_interrupt();
  void write_if_due();

  std::mutex mutex_;
  Task* around_;  // the one that this is part of
  std::string label_, doing_;
  int total_, done_ = 0;
  bool may_end_, is_terminal_;
  std::chrono::steady_clock::time_point start_, last_;
};

// Ends work that has nothing to keep.
class Interrupted : public std::exception {
 public:
  Interrupted();
  const char* what() const noexcept override { return "stopped by the user"; }
};
bool task_was_interrupted();  // has one been thrown?

// Throws Interrupted where the user wants to stop and the work at hand may end; else has it say again what goes on,
// where that is due. For loops whose bodies are short. Of several ranks none may leave the others waiting: there they
// end where all look at it together.
void heed_interrupt();
void set_interrupts_heeded(bool heeded);

// Before something else is printed: takes a progress line from the terminal.
void leave_progress_line();

}  // namespace dygita
