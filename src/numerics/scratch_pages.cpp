#include "numerics/scratch_pages.hpp"

#include <map>
#include <mutex>

namespace dygita {

namespace {

struct Kept {
  std::mutex mutex;
  int n_keepers = 0;
  std::multimap<size_t, UntouchedPages> by_size;  // bytes
};

Kept& kept() {
  static Kept all;
  return all;
}

// The smallest that is large enough, or new ones; answers how large they are in `n_bytes`.
UntouchedPages take(size_t& n_bytes) {
  Kept& all = kept();
  {
    const std::scoped_lock lock(all.mutex);
    if (const auto it = all.by_size.lower_bound(n_bytes); it != all.by_size.end()) {
      n_bytes = it->first;
      UntouchedPages pages = std::move(it->second);
      all.by_size.erase(it);
      return pages;
    }
  }
  return UntouchedPages(n_bytes);
}

}  // namespace

KeepScratch::KeepScratch() {
  const std::scoped_lock lock(kept().mutex);
  ++kept().n_keepers;
}

KeepScratch::~KeepScratch() {
  const std::scoped_lock lock(kept().mutex);
  if (--kept().n_keepers == 0) kept().by_size.clear();
}

ScratchPages::ScratchPages(size_t n_bytes) : n_bytes_(n_bytes), pages_(take(n_bytes_)) {}

ScratchPages::~ScratchPages() {
  const std::scoped_lock lock(kept().mutex);
  if (kept().n_keepers == 0) return;
  try {
    kept().by_size.emplace(n_bytes_, std::move(pages_));
  } catch (const std::bad_alloc&) {
    // Given back to the system instead.
  }
}

}  // namespace dygita
