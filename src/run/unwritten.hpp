// What could not be written of a run.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "base/error.hpp"
#include "base/progress.hpp"

namespace dygita {

// The first file that cannot be written. A frame ends the run after its increment, and whatever else can be written is:
// what has been computed is worth more than what would follow.
class Unwritten {
 public:
  void attempt(const std::function<void()>& write) {
    try {
      write();
    } catch (const InputError& error) {
      if (error_.empty()) error_ = error.what();
    }
  }
  void attempt_frame(const std::function<void()>& write) {
    attempt(write);
    if (!error_.empty()) request_interrupt();
  }
  bool is_empty() const { return error_.empty(); }
  // Throws what went wrong, once everything else is written; remedy: a line of its own, or nothing.
  void finish(const std::filesystem::path& directory, bool is_replacing, const std::string& remedy) const {
    if (error_.empty()) return;
    withdraw_interrupt();
    throw InputError(error_ +
                     (is_replacing ? "\n    the results in " + directory.string() + " are unchanged"
                                   : "\n    the results that could be written are in " + directory.string()) +
                     remedy);
  }

 private:
  std::string error_;
};

}  // namespace dygita
