#include "base/threads.hpp"

#include <unistd.h>

#include <cstdlib>

namespace dygita {

void wait_passively(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") && std::getenv("OPENBLAS_NUM_THREADS")) return;
  setenv("OMP_WAIT_POLICY", "passive", 0);
  setenv("OPENBLAS_NUM_THREADS", "1", 0);
  // Where /proc is missing the program goes on as it is, only slower on a busy machine.
  execv("/proc/self/exe", argv);
}

}  // namespace dygita
