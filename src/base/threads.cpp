#include "base/threads.hpp"

#include <pmmintrin.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <string>

#include "base/memory.hpp"

namespace dygita {

void set_up_process(char** argv, const char* blas_kernels) {
  // A write beyond the limit of a file's size fails, and is told, as any other that fails.
  std::signal(SIGXFSZ, SIG_IGN);
  const bool has_kernels = !blas_kernels || std::getenv("OPENBLAS_CORETYPE");
  if (std::getenv("OPENBLAS_NUM_THREADS") && std::getenv("GLIBC_TUNABLES") && has_kernels) return;
  if (!has_kernels) setenv("OPENBLAS_CORETYPE", blas_kernels, 0);
  setenv("OPENBLAS_NUM_THREADS", "1", 0);
  setenv("VTK_SMP_BACKEND_IN_USE", "Sequential", 0);  // VTK's threads beside ours
  // Large pages under all of the heap, which grows by many of them at a time and keeps what comes back: a short run
  // spends a fifth of its time on clearing small ones (glibc 2.35). The heaps of threads are asked for them when they
  // are made alone, not when they grow: they are made whole.
  constexpr std::size_t mapped_alone = std::size_t{32} << 20;
  const std::string growth = std::to_string(heap_growth), kept = std::to_string(2 * heap_growth);
  const std::string tunables = "glibc.malloc.hugetlb=1:glibc.malloc.top_pad=" + growth +
                               ":glibc.malloc.mmap_threshold=" + std::to_string(mapped_alone) +
                               ":glibc.malloc.trim_threshold=" + kept;
  setenv("GLIBC_TUNABLES", tunables.c_str(), 0);
  // Where /proc is missing the program continues as it is, only slower on a busy machine.
  execv("/proc/self/exe", argv);
}

void flush_denormals() {
  _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
  _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
}

}  // namespace dygita
