// Memory for what is streamed from end to end at every solve: in large pages, where the system gives them for the asking.
#pragma once

#include <sys/mman.h>

#include <cstdlib>
#include <new>
#include <vector>

namespace dygita {

template <class T>
struct HugePages {
  using value_type = T;
  HugePages() = default;
  template <class Other>
  HugePages(const HugePages<Other>&) {}

  T* allocate(size_t n) {
    constexpr size_t page = size_t{1} << 21;
    const size_t bytes = n * sizeof(T);
    if (bytes < 4 * page) return static_cast<T*>(::operator new(bytes, std::align_val_t{64}));
    void* memory = std::aligned_alloc(page, (bytes + page - 1) / page * page);
    if (!memory) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
    madvise(memory, bytes, MADV_HUGEPAGE);  // advice: nothing is lost where it is not taken
#endif
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, size_t n) {
    constexpr size_t page = size_t{1} << 21;
    if (n * sizeof(T) < 4 * page)
      ::operator delete(memory, std::align_val_t{64});
    else
      std::free(memory);
  }
  template <class Other>
  bool operator==(const HugePages<Other>&) const { return true; }
};

template <class T>
using StreamedVector = std::vector<T, HugePages<T>>;

}  // namespace dygita
