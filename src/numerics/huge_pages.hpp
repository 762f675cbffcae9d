// Memory for what is streamed from end to end at every solve: in large pages, where the system gives them for the
// asking.
#pragma once

#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>
#include <new>
#include <vector>

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

template <class T>
struct HugePages {
  using value_type = T;
  HugePages() = default;
  template <class Other>
  HugePages(const HugePages<Other>&) {}

  T* allocate(size_t n) {
    void* memory = allocate_huge_pages(n * sizeof(T));
    if (!memory) throw std::bad_alloc();
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, size_t) { std::free(memory); }
  template <class Other>
  bool operator==(const HugePages<Other>&) const {
    return true;
  }
};

template <class T>
using StreamedVector = std::vector<T, HugePages<T>>;

}  // namespace dygita
