// What the program says: plain lines, and warnings that are also kept for the run record.
#pragma once

#include <spdlog/fmt/fmt.h>

#include <string>
#include <vector>

namespace dygita {

// One line on standard output.
void say(const std::string& line);

// A warning, on standard error and kept until `take_warnings`; said once even if repeated.
void warn(const std::string& message);

// Runs that differ by parameters warn of the same with other numbers: while it lives, the first of these is said, and
// the others are only kept. Serious kinds are said each time. One at a time.
class SayAlikeOnce {
 public:
  SayAlikeOnce();
  ~SayAlikeOnce();
  SayAlikeOnce(const SayAlikeOnce&) = delete;
  SayAlikeOnce& operator=(const SayAlikeOnce&) = delete;
  int n_unsaid() const;
};

// From now on nothing is printed; warnings are kept as before.
void be_silent();

// The warnings since the last call, serious kinds (base/warnings.hpp) first, else oldest first; clears them.
std::vector<std::string> take_warnings();

}  // namespace dygita
