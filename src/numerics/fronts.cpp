#include "numerics/fronts.hpp"

#include <algorithm>

#include "base/parallel.hpp"
#include "numerics/dense_blocks.hpp"
#include "numerics/scratch_pages.hpp"

namespace dygita {

namespace {

constexpr int columns_at_once = 64;       // columns that a thread takes at once
constexpr int rows_of_one_thread = 1000;  // of an update that one thread adds sooner than it wakes another

size_t squared(int m) { return static_cast<size_t>(m) * static_cast<size_t>(m); }

// Supernodes from the leaves up: each follows all of its children, the last of them at once.
struct Tree {
  std::vector<int> parent;  // -1: above is what is not eliminated
  std::vector<std::vector<int>> children;
  std::vector<int> order;

  Tree(const std::vector<SupernodeView>& supernodes, int n_interior)
      : parent(supernodes.size(), -1), children(supernodes.size()) {
    std::vector<int> supernode_of(n_interior);
    const int n = static_cast<int>(supernodes.size());
    for (int s = 0; s < n; ++s) std::fill_n(supernode_of.begin() + supernodes[s].first, supernodes[s].n_columns, s);
    for (int s = 0; s < n; ++s)
      if (supernodes[s].n_below > 0 && supernodes[s].below[0] < n_interior) {
        parent[s] = supernode_of[supernodes[s].below[0]];
        children[parent[s]].push_back(s);
      }
    // From the roots down and children from the last on, read backwards.
    std::vector<int> open;
    for (int s = 0; s < n; ++s)
      if (parent[s] < 0) open.push_back(s);
    while (!open.empty()) {
      const int s = open.back();
      open.pop_back();
      order.push_back(s);
      open.insert(open.end(), children[s].begin(), children[s].end());
    }
    std::reverse(order.begin(), order.end());
  }
};

// f(j) for the columns of an update of m rows, shared among threads where there are many.
template <class Function>
void for_each_column(int m, Function&& f) {
  const auto run = [&](int block) {
    for (int j = block * columns_at_once; j < std::min(m, (block + 1) * columns_at_once); ++j) f(j);
  };
  parallel_for((m + columns_at_once - 1) / columns_at_once, run, Schedule::as_free, m < rows_of_one_thread ? 1 : 0);
}

class Elimination {
 public:
  Elimination(const SparseMatrix& matrix, const std::vector<int>& order, int n_interior,
              const std::vector<SupernodeView>& supernodes)
      : matrix_(matrix),
        order_(order),
        n_interior_(n_interior),
        supernodes_(supernodes),
        tree_(supernodes, n_interior),
        position_(order.size()),
        local_(order.size()),
        update_(supernodes.size(), nullptr),
        panel_(largest_panel() * sizeof(double)),
        stack_(deepest_stack() * sizeof(double)) {
    for (size_t i = 0; i < order.size(); ++i) position_[order[i]] = static_cast<int>(i);
  }

  Eliminated run(const std::function<void(const SupernodeView&)>& keep) {
    Eliminated result;
    schur_ = rest_of_matrix();
    top_ = stack_.doubles();
    for (const int s : tree_.order) {
      const int pivot = eliminate(s);
      if (pivot >= 0) return {Mat(), pivot};
      const SupernodeView& rows = supernodes_[s];
      keep({rows.first, rows.n_columns, rows.n_below, rows.below, panel_.doubles(), rows.n_columns + rows.n_below});
    }
    result.schur = std::move(schur_);
    return result;
  }

 private:
  // Does what a supernode leaves belong to all of the rest, in its order?
  bool is_above_all(int s) const {
    return tree_.parent[s] < 0 && supernodes_[s].n_below == static_cast<int>(order_.size()) - n_interior_;
  }
  size_t update_size(int s) const { return is_above_all(s) ? 0 : squared(supernodes_[s].n_below); }

  size_t largest_panel() const {
    size_t largest = 0;
    for (const SupernodeView& s : supernodes_)
      largest = std::max(largest, static_cast<size_t>(s.n_columns + s.n_below) * static_cast<size_t>(s.n_columns));
    return largest;
  }

  // Updates wait on a stack until their parent takes them; the parent's own is made above its children's.
  size_t deepest_stack() const {
    size_t depth = 0, deepest = 0;
    for (const int s : tree_.order) {
      deepest = std::max(deepest, depth + update_size(s));
      for (const int child : tree_.children[s]) depth -= update_size(child);
      if (tree_.parent[s] >= 0) depth += update_size(s);
    }
    return deepest;
  }

  Mat rest_of_matrix() const {
    const int n = static_cast<int>(order_.size()) - n_interior_;
    Mat rest = Mat::Zero(n, n);
    for (int j = 0; j < n; ++j)
      for (SparseMatrix::InnerIterator e(matrix_, order_[n_interior_ + j]); e; ++e)
        if (const int i = position_[e.col()] - n_interior_; i >= j) rest(i, j) += e.value();
    return rest;
  }

  void take_matrix(const SupernodeView& s) {
    const auto height = static_cast<size_t>(s.n_columns + s.n_below);
    double* panel = panel_.doubles();
    std::fill_n(panel, height * s.n_columns, 0.0);
    for (int j = 0; j < s.n_columns; ++j)
      for (SparseMatrix::InnerIterator e(matrix_, order_[s.first + j]); e; ++e)
        if (const int at = position_[e.col()]; at >= s.first + j) panel[height * j + local_[at]] += e.value();
  }

  // Adds what a child leaves to the columns at hand and to what they leave themselves (n_below apart).
  void take_child(const SupernodeView& s, int child, double* update) {
    const SupernodeView& from = supernodes_[child];
    const int m = from.n_below;
    const auto height = static_cast<size_t>(s.n_columns + s.n_below);
    to_.resize(m);
    for (int i = 0; i < m; ++i) to_[i] = local_[from.below[i]];
    for_each_column(m, [&](int j) {
      const double* column = update_[child] + static_cast<size_t>(j) * m;
      const int at = to_[j];
      double* into = at < s.n_columns ? panel_.doubles() + height * at
                                      : update + static_cast<size_t>(at - s.n_columns) * s.n_below - s.n_columns;
      for (int i = j; i < m; ++i) into[to_[i]] += column[i];
    });
  }

  // The columns of a supernode into the panel, what they leave onto the stack, or into the Schur complement. Answers
  // the position of a pivot that is not positive, or -1.
  int eliminate(int i_supernode) {
    const SupernodeView& s = supernodes_[i_supernode];
    const int k = s.n_columns, m = s.n_below, height = k + m;
    for (int i = 0; i < k; ++i) local_[s.first + i] = i;
    for (int i = 0; i < m; ++i) local_[s.below[i]] = k + i;
    take_matrix(s);
    const bool is_into_schur = is_above_all(i_supernode);
    const std::vector<int>& children = tree_.children[i_supernode];
    double* update = is_into_schur ? schur_.data() : top_;
    if (!children.empty() && !is_into_schur) clear(update, m);
    for (const int child : children) take_child(s, child, update);
    double* panel = panel_.doubles();
    if (const int pivot = factorise_columns(height, k, panel, height); pivot >= 0) return s.first + pivot;
    subtract_square(m, k, panel + k, height, children.empty() && !is_into_schur ? 0.0 : 1.0, update, m);
    if (!children.empty()) top_ = update_[children.front()];
    if (is_into_schur || m == 0) return -1;
    if (tree_.parent[i_supernode] < 0)
      give_to_schur(s, update);
    else
      push(i_supernode, update);
    return -1;
  }

  static void clear(double* update, int m) {
    for_each_column(m, [&](int j) { std::fill_n(update + static_cast<size_t>(j) * m + j, m - j, 0.0); });
  }

  void give_to_schur(const SupernodeView& s, const double* update) {
    for (int j = 0; j < s.n_below; ++j)
      for (int i = j; i < s.n_below; ++i)
        schur_(s.below[i] - n_interior_, s.below[j] - n_interior_) += update[static_cast<size_t>(j) * s.n_below + i];
  }

  void push(int s, const double* update) {
    const size_t size = update_size(s);
    if (update != top_) std::copy_n(update, size, top_);  // down, where the children were
    update_[s] = top_;
    top_ += size;
  }

  const SparseMatrix& matrix_;
  const std::vector<int>& order_;
  const int n_interior_;
  const std::vector<SupernodeView>& supernodes_;
  const Tree tree_;
  std::vector<int> position_;    // of an unknown in the factor
  std::vector<int> local_, to_;  // of a position in the front at hand, of a row of a child's update in it
  std::vector<double*> update_;  // of each supernode whose parent is still to come, n_below x n_below
  ScratchPages panel_, stack_;
  double* top_ = nullptr;
  Mat schur_;
};

}  // namespace

Eliminated eliminate(const SparseMatrix& matrix, const std::vector<int>& order, int n_interior,
                     const std::vector<SupernodeView>& supernodes,
                     const std::function<void(const SupernodeView&)>& keep) {
  return Elimination(matrix, order, n_interior, supernodes).run(keep);
}

}  // namespace dygita
