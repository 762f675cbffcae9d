#include "numerics/repeated_factor.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <new>
#include <numeric>

#include "base/error.hpp"
#include "numerics/cholmod_workspace.hpp"
#include "numerics/elimination_tree.hpp"
#include "numerics/fronts.hpp"

namespace dygita {

namespace {

// Multiplications and additions together.
double operations_of(const SupernodeView& s) {
  const double k = s.n_columns, m = s.n_below;
  return k * (k * k / 3.0 + m * (k + m));
}

}  // namespace

RepeatedFactor::RepeatedFactor(const SparseMatrix& pattern, const std::vector<int>& node_of_dof,
                               const std::string& what)
    : cholmod_(std::make_unique<Cholmod>()), what_(what) {
  order_ = analyse(*cholmod_, pattern, node_of_dof, std::vector<char>(node_of_dof.size(), 0), what);
  const int n = static_cast<int>(order_.size());
  for (size_t s = 0; s < cholmod_->n_supernodes(); ++s) supernodes_.push_back(cholmod_->supernode(s, n));
  for (const SupernodeView& s : supernodes_) operations_ += operations_of(s);
}

RepeatedFactor::~RepeatedFactor() = default;
RepeatedFactor::RepeatedFactor(RepeatedFactor&&) noexcept = default;

double RepeatedFactor::bytes() const {
  double sum = 0.0;
  for (const SupernodeView& s : supernodes_) sum += supernode_bytes(s.n_columns, s.n_below) + 4.0 * s.n_below;
  return sum;
}

double RepeatedFactor::bytes_at_work() const { return bytes_of_fronts(supernodes_, static_cast<int>(order_.size())); }

bool RepeatedFactor::factorise(const SparseMatrix& matrix, const std::function<void(double)>& watch) {
  return factorise(matrix, order_, watch);
}

bool RepeatedFactor::factorise_in_order(const SparseMatrix& upper, const std::function<void(double)>& watch) {
  std::vector<int> as_it_is(order_.size());
  std::iota(as_it_is.begin(), as_it_is.end(), 0);
  return factorise(upper, as_it_is, watch);
}

bool RepeatedFactor::factorise(const SparseMatrix& matrix, const std::vector<int>& order,
                               const std::function<void(double)>& watch) {
  factor_.clear();
  std::mutex telling;
  std::atomic<double> done = 0.0;
  const auto keep = [&](const SupernodeView& supernode, int place) {
    factor_.add(supernode, place);
    done = done + operations_of(supernode);
  };
  const auto tell = [&] {
    const std::scoped_lock lock(telling);
    watch(std::min(1.0, done / operations_));
  };
  try {
    const int at =
        eliminate(matrix, order, static_cast<int>(order.size()), supernodes_, keep, watch ? Watch(tell) : Watch())
            .not_positive;
    not_positive_ = at < 0 ? -1 : order_[static_cast<size_t>(at)];
    factor_.arrange();
    return at < 0;
  } catch (const std::bad_alloc&) {
    throw NumericalError(what_ + ": factorisation failed: out of memory");
  }
}

Mat RepeatedFactor::solve(const Mat& b) const {
  Mat x = b(order_, Eigen::all);
  factor_.forward(x);
  factor_.backward(x);
  Mat answer(b.rows(), b.cols());
  answer(order_, Eigen::all) = x;
  return answer;
}

// Supernodes of the unknowns and all above them, by their places.
std::vector<char> RepeatedFactor::reach_of(const std::vector<int>& unknowns) const {
  const int n = static_cast<int>(order_.size());
  const EliminationTree tree(supernodes_, n);
  std::vector<int> position(order_.size()), supernode_of(order_.size());
  for (int i = 0; i < n; ++i) position[static_cast<size_t>(order_[i])] = i;
  std::vector<char> is_reached(supernodes_.size(), 0), reach;
  for (size_t s = 0; s < supernodes_.size(); ++s)
    std::fill_n(supernode_of.begin() + supernodes_[s].first, supernodes_[s].n_columns, static_cast<int>(s));
  for (const int unknown : unknowns) is_reached[supernode_of[position[unknown]]] = 1;
  for (const int s : tree.order) {
    if (is_reached[s] && tree.parent[s] >= 0) is_reached[tree.parent[s]] = 1;
    reach.push_back(is_reached[s]);
  }
  return reach;
}

Vec RepeatedFactor::solve(const Vec& b, const std::vector<char>& reach) const {
  Vec x = b(order_), answer(b.size());
  factor_.forward(x, reach);
  factor_.backward(x, reach);
  answer(order_) = x;
  return answer;
}

}  // namespace dygita
