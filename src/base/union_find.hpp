// Sets that are joined one by one.
#pragma once

#include <numeric>
#include <vector>

namespace dygita {

class UnionFind {
 public:
  // n sets of one.
  explicit UnionFind(int n) : parent_(static_cast<size_t>(n)), n_sets_(n) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  // The member that stands for the set of i.
  int root(int i) const {
    while (at(i) != i) i = at(i) = at(at(i));
    return i;
  }
  void join(int i, int j) {
    i = root(i), j = root(j);
    if (i == j) return;
    at(i) = j;
    --n_sets_;
  }
  int n_sets() const { return n_sets_; }

 private:
  int& at(int i) const { return parent_[static_cast<size_t>(i)]; }
  mutable std::vector<int> parent_;  // paths are made shorter where they are gone
  int n_sets_;
};

}  // namespace dygita
