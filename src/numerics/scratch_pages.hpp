// Memory that one factorisation after the other works in: pages that the system has cleared once serve again.
#pragma once

#include "numerics/huge_pages.hpp"

namespace dygita {

// While one of these lives, scratch that is given back is kept for who asks next, on any thread.
class KeepScratch {
 public:
  KeepScratch();
  ~KeepScratch();
  KeepScratch(const KeepScratch&) = delete;
  KeepScratch& operator=(const KeepScratch&) = delete;
};

// Of at least so many bytes, with anything in it. Throws std::bad_alloc.
class ScratchPages {
 public:
  explicit ScratchPages(size_t n_bytes);
  ~ScratchPages();
  ScratchPages(const ScratchPages&) = delete;
  ScratchPages& operator=(const ScratchPages&) = delete;
  double* doubles() { return pages_.doubles(); }

 private:
  size_t n_bytes_;
  UntouchedPages pages_;
};

}  // namespace dygita
