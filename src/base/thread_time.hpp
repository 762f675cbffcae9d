// Seconds that this thread has had a processor, whoever else runs on it.
#pragma once

#include <ctime>

namespace dygita {

inline double thread_seconds() {
  std::timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace dygita
