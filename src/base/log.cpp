#include "base/log.hpp"

#include <algorithm>
#include <cstdio>
#include <mutex>
#include <utility>

#include "base/names.hpp"

namespace dygita {

namespace {
std::mutex log_mutex;
std::vector<std::string> kept_warnings;
bool is_silent = false;
}  // namespace

void say(const std::string& line) {
  const std::scoped_lock lock(log_mutex);
  if (is_silent) return;
  std::fputs((printable(line) + "\n").c_str(), stdout);
  std::fflush(stdout);
}

void warn(const std::string& message) {
  const std::scoped_lock lock(log_mutex);
  if (std::find(kept_warnings.begin(), kept_warnings.end(), message) != kept_warnings.end()) return;
  kept_warnings.push_back(message);
  if (is_silent) return;
  std::fputs(("warning: " + printable(message) + "\n").c_str(), stderr);
}

void be_silent() {
  const std::scoped_lock lock(log_mutex);
  is_silent = true;
}

std::vector<std::string> take_warnings() {
  const std::scoped_lock lock(log_mutex);
  return std::exchange(kept_warnings, {});
}

}  // namespace dygita
