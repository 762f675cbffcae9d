#include "numerics/fronts.hpp"

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>

#include "base/parallel.hpp"
#include "numerics/elimination_tree.hpp"
#include "numerics/scratch_pages.hpp"

namespace dygita {

namespace {

constexpr int columns_at_once = 64;       // columns that a thread takes at once
constexpr int rows_of_one_thread = 1000;  // of an update that one thread adds sooner than it wakes another

size_t squared(int m) { return static_cast<size_t>(m) * static_cast<size_t>(m); }

// f(j) for columns of an update of m rows, shared among threads where there are many.
template <class Function>
void for_each_column(int m, int begin, int end, Function&& f) {
  const auto run = [&](int block) {
    const int first = begin + block * columns_at_once;
    for (int j = first; j < std::min(end, first + columns_at_once); ++j) f(j);
  };
  parallel_for((end - begin + columns_at_once - 1) / columns_at_once, run, Schedule::as_free,
               m < rows_of_one_thread ? 1 : 0);
}

// What all fronts read, and what each of them leaves for its parent.
struct Whole {
  const SparseMatrix& matrix;
  const std::vector<int>& order;
  const int n_interior;
  const std::vector<SupernodeView>& supernodes;
  const Watch& watch;
  const EliminationTree tree;
  std::vector<int> position;    // of an unknown in the factor
  std::vector<double*> update;  // of each supernode whose parent is still to come, n_below x n_below
  Mat schur;

  Whole(const SparseMatrix& of, const std::vector<int>& in, int n, const std::vector<SupernodeView>& all,
        const Watch& meanwhile)
      : matrix(of),
        order(in),
        n_interior(n),
        supernodes(all),
        watch(meanwhile),
        tree(all, n),
        position(in.size()),
        update(all.size(), nullptr) {
    for (size_t i = 0; i < order.size(); ++i) position[order[i]] = static_cast<int>(i);
    schur = rest_of_matrix();
  }

  // Does what a supernode leaves belong to all of the rest, in its order?
  bool is_above_all(int s) const {
    return tree.parent[s] < 0 && supernodes[s].n_below == static_cast<int>(order.size()) - n_interior;
  }
  size_t update_size(int s) const { return is_above_all(s) ? 0 : squared(supernodes[s].n_below); }

 private:
  Mat rest_of_matrix() const {
    const int n = static_cast<int>(order.size()) - n_interior;
    Mat rest = Mat::Zero(n, n);
    for (int j = 0; j < n; ++j)
      for (SparseMatrix::InnerIterator e(matrix, order[n_interior + j]); e; ++e)
        if (const int i = position[e.col()] - n_interior; i >= j) rest(i, j) += e.value();
    return rest;
  }
};

// Some supernodes in the tree's order, one after the other, on memory of their own.
class Fronts {
 public:
  // places: in the tree's order. Updates of children that are not among them are elsewhere.
  Fronts(Whole& whole, std::vector<int> places)
      : whole_(whole),
        places_(std::move(places)),
        room_(whole.tree, whole.supernodes, places_, [&](int s) { return whole.update_size(s); }),
        local_(whole.order.size()),
        panel_(room_.columns * sizeof(double)),
        stack_(room_.waiting * sizeof(double)),
        top_(stack_.doubles()) {}

  // Answers the position of a pivot that is not positive, or -1.
  template <class Keep>
  int run(Keep&& keep) {
    for (const int place : places_) {
      const int s = whole_.tree.order[place];
      if (const int pivot = eliminate(s); pivot >= 0) return pivot;
      const SupernodeView& rows = whole_.supernodes[s];
      keep(SupernodeView{rows.first, rows.n_columns, rows.n_below, rows.below, panel_.doubles(),
                         rows.n_columns + rows.n_below},
           place);
    }
    return -1;
  }

 private:
  void take_matrix(const SupernodeView& s) {
    const auto height = static_cast<size_t>(s.n_columns + s.n_below);
    double* panel = panel_.doubles();
    std::fill_n(panel, height * s.n_columns, 0.0);
    for (int j = 0; j < s.n_columns; ++j)
      for (SparseMatrix::InnerIterator e(whole_.matrix, whole_.order[s.first + j]); e; ++e)
        if (const int at = whole_.position[e.col()]; at >= s.first + j) panel[height * j + local_[at]] += e.value();
  }

  // Where the rows of a child's update go in the front at hand; answers the first that is no column of it.
  int find_rows(const SupernodeView& s, const SupernodeView& child) {
    to_.resize(child.n_below);
    for (int i = 0; i < child.n_below; ++i) to_[i] = local_[child.below[i]];
    return static_cast<int>(std::lower_bound(to_.begin(), to_.end(), s.n_columns) - to_.begin());
  }

  // Adds what a child leaves to the columns at hand.
  void take_columns(const SupernodeView& s, int child) {
    const int m = whole_.supernodes[child].n_below, end = find_rows(s, whole_.supernodes[child]);
    const auto height = static_cast<size_t>(s.n_columns + s.n_below);
    for_each_column(m, 0, end, [&](int j) {
      const double* column = whole_.update[child] + static_cast<size_t>(j) * m;
      double* into = panel_.doubles() + height * to_[j];
      for (int i = j; i < m; ++i) into[to_[i]] += column[i];
    });
  }

  // And to what they leave themselves (n_below apart).
  void take_rest(const SupernodeView& s, int child, double* update) {
    const int m = whole_.supernodes[child].n_below, first = find_rows(s, whole_.supernodes[child]);
    for_each_column(m, first, m, [&](int j) {
      const double* column = whole_.update[child] + static_cast<size_t>(j) * m;
      double* into = update + static_cast<size_t>(to_[j] - s.n_columns) * s.n_below - s.n_columns;
      for (int i = j; i < m; ++i) into[to_[i]] += column[i];
    });
  }

  // Makes of a child's update that of the front at hand, where it lies: no column is written before it is read.
  void move_rest(const SupernodeView& s, int child) {
    const int m = whole_.supernodes[child].n_below, n = s.n_below, first = find_rows(s, whole_.supernodes[child]);
    double* const update = whole_.update[child];
    int next = 0;  // column to be made
    const auto clear_to = [&](int end) {
      for (; next < end; ++next) std::fill_n(update + static_cast<size_t>(next) * n + next, n - next, 0.0);
    };
    for (int j = first; j < m; ++j) {
      const double* column = update + static_cast<size_t>(j) * m;
      moved_.assign(column + j, column + m);
      clear_to(to_[j] - s.n_columns + 1);
      double* into = update + static_cast<size_t>(to_[j] - s.n_columns) * n - s.n_columns;
      for (int i = j; i < m; ++i) into[to_[i]] = moved_[i - j];
    }
    clear_to(n);
  }

  // Takes what the children leave; answers where what the front leaves itself is to be.
  double* take_children(int i_supernode) {
    const SupernodeView& s = whole_.supernodes[i_supernode];
    const std::vector<int>& children = whole_.tree.children[i_supernode];
    for (const int child : children) take_columns(s, child);
    const bool is_over = room_.is_over_child[i_supernode];
    double* update = whole_.is_above_all(i_supernode) ? whole_.schur.data()
                     : is_over                        ? whole_.update[children.back()]
                                                      : top_;
    if (is_over)
      move_rest(s, children.back());
    else if (!children.empty() && !whole_.is_above_all(i_supernode))
      clear(update, s.n_below);
    for (const int child : children)
      if (!is_over || child != children.back()) take_rest(s, child, update);
    return update;
  }

  // The columns of a supernode into the panel, what they leave onto the stack, or into the Schur complement. Answers
  // the position of a pivot that is not positive, or -1.
  int eliminate(int i_supernode) {
    const SupernodeView& s = whole_.supernodes[i_supernode];
    const int k = s.n_columns, m = s.n_below, height = k + m;
    for (int i = 0; i < k; ++i) local_[s.first + i] = i;
    for (int i = 0; i < m; ++i) local_[s.below[i]] = k + i;
    take_matrix(s);
    const bool is_into_schur = whole_.is_above_all(i_supernode);
    const std::vector<int>& children = whole_.tree.children[i_supernode];
    double* update = take_children(i_supernode);
    double* panel = panel_.doubles();
    if (const int pivot = factorise_columns(height, k, panel, height, whole_.watch); pivot >= 0) return s.first + pivot;
    subtract_square(m, k, panel + k, height, children.empty() && !is_into_schur ? 0.0 : 1.0, update, m, whole_.watch);
    const auto lowest = std::find_if(children.begin(), children.end(), [&](int child) { return room_.is_own[child]; });
    if (lowest != children.end()) top_ = whole_.update[*lowest];
    if (is_into_schur || m == 0) return -1;
    if (whole_.tree.parent[i_supernode] < 0)
      give_to_schur(s, update);
    else
      push(i_supernode, update);
    return -1;
  }

  static void clear(double* update, int m) {
    for_each_column(m, 0, m, [&](int j) { std::fill_n(update + static_cast<size_t>(j) * m + j, m - j, 0.0); });
  }

  void give_to_schur(const SupernodeView& s, const double* update) {
    const int first = whole_.n_interior;
    for (int j = 0; j < s.n_below; ++j)
      for (int i = j; i < s.n_below; ++i)
        whole_.schur(s.below[i] - first, s.below[j] - first) += update[static_cast<size_t>(j) * s.n_below + i];
  }

  void push(int s, const double* update) {
    const size_t size = whole_.update_size(s);
    if (update != top_) std::copy_n(update, size, top_);  // down, where the children were
    whole_.update[s] = top_;
    top_ += size;
  }

  Whole& whole_;
  const std::vector<int> places_;
  const RoomForFronts room_;
  std::vector<int> local_, to_;  // of a position in the front at hand, of a row of a child's update in it
  std::vector<double> moved_;
  ScratchPages panel_, stack_;
  double* top_;
};

std::vector<int> range(int first, int end) {
  std::vector<int> all(static_cast<size_t>(end - first));
  std::iota(all.begin(), all.end(), first);
  return all;
}

// Nothing where a pivot is not positive.
std::optional<Mat> eliminate_side_by_side(Whole& whole, const KeepSupernode& keep) {
  const std::vector<TreeBranch> branches = branches_of(whole.tree, whole.supernodes);
  std::mutex keeping;
  const auto one_by_one = [&](const SupernodeView& supernode, int place) {
    const std::scoped_lock lock(keeping);
    keep(supernode, place);
  };
  std::vector<std::unique_ptr<ScratchPages>> left(branches.size());  // of the roots of branches
  std::atomic<bool> is_positive = true;
  parallel_for(static_cast<int>(left.size()), [&](int i) {
    const TreeBranch& branch = branches[static_cast<size_t>(i)];
    if (!is_positive) return;
    Fronts fronts(whole, range(branch.first, branch.end));
    if (fronts.run(one_by_one) >= 0) {
      is_positive = false;
      return;
    }
    const size_t size = whole.update_size(branch.root);
    auto& own = left[static_cast<size_t>(i)] = std::make_unique<ScratchPages>(size * sizeof(double));
    std::copy_n(whole.update[branch.root], size, own->doubles());
    whole.update[branch.root] = own->doubles();
  });
  std::vector<char> is_done(whole.supernodes.size(), 0);
  for (const TreeBranch& branch : branches) std::fill(is_done.begin() + branch.first, is_done.begin() + branch.end, 1);
  std::vector<int> above;
  for (size_t i = 0; i < is_done.size(); ++i)
    if (!is_done[i]) above.push_back(static_cast<int>(i));
  if (!is_positive || Fronts(whole, std::move(above)).run(keep) >= 0) return std::nullopt;
  return std::move(whole.schur);
}

}  // namespace

double bytes_of_fronts(const std::vector<SupernodeView>& supernodes, int n) {
  const EliminationTree tree(supernodes, n);
  const auto update_size = [&](int s) { return tree.parent[s] < 0 ? 0 : squared(supernodes[s].n_below); };
  const RoomForFronts room(tree, supernodes, range(0, static_cast<int>(supernodes.size())), update_size);
  return 8.0 * static_cast<double>(room.columns + room.waiting);
}

Eliminated eliminate(const SparseMatrix& matrix, const std::vector<int>& order, int n_interior,
                     const std::vector<SupernodeView>& supernodes, const KeepSupernode& keep, const Watch& watch) {
  if (thread_limit() > 1 && !is_in_team()) {
    Whole whole(matrix, order, n_interior, supernodes, watch);
    if (std::optional<Mat> schur = eliminate_side_by_side(whole, keep)) return {std::move(*schur), -1};
    // Which pivot one thread meets first is what is to be told.
  }
  Whole whole(matrix, order, n_interior, supernodes, watch);
  const int pivot = Fronts(whole, range(0, static_cast<int>(supernodes.size()))).run(keep);
  return {pivot < 0 ? std::move(whole.schur) : Mat(), pivot};
}

}  // namespace dygita
