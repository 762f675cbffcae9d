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

// f(j) for the columns of an update of m rows, shared among threads where there are many.
template <class Function>
void for_each_column(int m, Function&& f) {
  const auto run = [&](int block) {
    for (int j = block * columns_at_once; j < std::min(m, (block + 1) * columns_at_once); ++j) f(j);
  };
  parallel_for((m + columns_at_once - 1) / columns_at_once, run, Schedule::as_free, m < rows_of_one_thread ? 1 : 0);
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
        is_own_(whole.supernodes.size(), 0),
        local_(whole.order.size()),
        panel_(largest_panel() * sizeof(double)),
        stack_(deepest_stack() * sizeof(double)),
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
  size_t largest_panel() {
    size_t largest = 0;
    for (const int place : places_) {
      const SupernodeView& s = whole_.supernodes[whole_.tree.order[place]];
      is_own_[whole_.tree.order[place]] = 1;
      largest = std::max(largest, static_cast<size_t>(s.n_columns + s.n_below) * static_cast<size_t>(s.n_columns));
    }
    return largest;
  }

  // Updates wait on a stack until their parent takes them; the parent's own is made above its children's.
  size_t deepest_stack() const {
    size_t depth = 0, deepest = 0;
    for (const int place : places_) {
      const int s = whole_.tree.order[place];
      deepest = std::max(deepest, depth + whole_.update_size(s));
      for (const int child : whole_.tree.children[s])
        if (is_own_[child]) depth -= whole_.update_size(child);
      if (whole_.tree.parent[s] >= 0) depth += whole_.update_size(s);
    }
    return deepest;
  }

  void take_matrix(const SupernodeView& s) {
    const auto height = static_cast<size_t>(s.n_columns + s.n_below);
    double* panel = panel_.doubles();
    std::fill_n(panel, height * s.n_columns, 0.0);
    for (int j = 0; j < s.n_columns; ++j)
      for (SparseMatrix::InnerIterator e(whole_.matrix, whole_.order[s.first + j]); e; ++e)
        if (const int at = whole_.position[e.col()]; at >= s.first + j) panel[height * j + local_[at]] += e.value();
  }

  // Adds what a child leaves to the columns at hand and to what they leave themselves (n_below apart).
  void take_child(const SupernodeView& s, int child, double* update) {
    const SupernodeView& from = whole_.supernodes[child];
    const int m = from.n_below;
    const auto height = static_cast<size_t>(s.n_columns + s.n_below);
    to_.resize(m);
    for (int i = 0; i < m; ++i) to_[i] = local_[from.below[i]];
    for_each_column(m, [&](int j) {
      const double* column = whole_.update[child] + static_cast<size_t>(j) * m;
      const int at = to_[j];
      double* into = at < s.n_columns ? panel_.doubles() + height * at
                                      : update + static_cast<size_t>(at - s.n_columns) * s.n_below - s.n_columns;
      for (int i = j; i < m; ++i) into[to_[i]] += column[i];
    });
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
    double* update = is_into_schur ? whole_.schur.data() : top_;
    if (!children.empty() && !is_into_schur) clear(update, m);
    for (const int child : children) take_child(s, child, update);
    double* panel = panel_.doubles();
    if (const int pivot = factorise_columns(height, k, panel, height, whole_.watch); pivot >= 0) return s.first + pivot;
    subtract_square(m, k, panel + k, height, children.empty() && !is_into_schur ? 0.0 : 1.0, update, m, whole_.watch);
    const auto lowest = std::find_if(children.begin(), children.end(), [&](int child) { return is_own_[child]; });
    if (lowest != children.end()) top_ = whole_.update[*lowest];
    if (is_into_schur || m == 0) return -1;
    if (whole_.tree.parent[i_supernode] < 0)
      give_to_schur(s, update);
    else
      push(i_supernode, update);
    return -1;
  }

  static void clear(double* update, int m) {
    for_each_column(m, [&](int j) { std::fill_n(update + static_cast<size_t>(j) * m + j, m - j, 0.0); });
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
  std::vector<char> is_own_;     // supernodes that are among them
  std::vector<int> local_, to_;  // of a position in the front at hand, of a row of a child's update in it
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
  const std::vector<Branch> branches = branches_of(whole.tree, whole.supernodes);
  std::mutex keeping;
  const auto one_by_one = [&](const SupernodeView& supernode, int place) {
    const std::scoped_lock lock(keeping);
    keep(supernode, place);
  };
  std::vector<std::unique_ptr<ScratchPages>> left(branches.size());  // of the roots of branches
  std::atomic<bool> is_positive = true;
  parallel_for(static_cast<int>(left.size()), [&](int i) {
    const Branch& branch = branches[static_cast<size_t>(i)];
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
  for (const Branch& branch : branches) std::fill(is_done.begin() + branch.first, is_done.begin() + branch.end, 1);
  std::vector<int> above;
  for (size_t i = 0; i < is_done.size(); ++i)
    if (!is_done[i]) above.push_back(static_cast<int>(i));
  if (!is_positive || Fronts(whole, std::move(above)).run(keep) >= 0) return std::nullopt;
  return std::move(whole.schur);
}

}  // namespace

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
