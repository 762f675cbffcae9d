// Memory for what is streamed from end to end at every solve: in large pages, where the system gives them for the
// asking.
#pragma once

#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>

namespace dygita {

constexpr size_t huge_page = size_t{1} << 21;

// Asks the system for large pages under memory that nobody has written to yet: a hundred times fewer to clear and to
// look up.
inline void prefer_huge_pages(void* data, size_t n_bytes) {
#ifdef MADV_HUGEPAGE
  const auto begin = (reinterpret_cast<std::uintptr_t>(data) + huge_page - 1) / huge_page * huge_page;
  const auto end = (reinterpret_cast<std::uintptr_t>(data) + n_bytes) / huge_page * huge_page;
  if (end > begin)
    madvise(reinterpret_cast<void*>(begin), end - begin,
            MADV_HUGEPAGE);  // advice: nothing is lost where it is not taken
#else
  (void)data, (void)n_bytes;
#endif
}

// Memory of its own pages where there is much; free() gives it back.
inline void* allocate_huge_pages(size_t n_bytes) {
  if (n_bytes < 4 * huge_page) return std::malloc(n_bytes);
  void* memory = std::aligned_alloc(huge_page, (n_bytes + huge_page - 1) / huge_page * huge_page);
  if (memory) prefer_huge_pages(memory, n_bytes);
  return memory;
}

// Memory that nobody has written to: what is never reached costs nothing.
class UntouchedPages {
 public:
  explicit UntouchedPages(size_t n_bytes)
      : memory_(static_cast<std::byte*>(allocate_huge_pages(std::max(n_bytes, size_t{1})))) {
    if (!memory_) throw std::bad_alloc();
  }
  std::byte* data() { return memory_.get(); }
  double* doubles() { return reinterpret_cast<double*>(memory_.get()); }

 private:
  struct Free {
    void operator()(std::byte* memory) const { std::free(memory); }
  };
  std::unique_ptr<std::byte, Free> memory_;
};

}  // namespace dygita
