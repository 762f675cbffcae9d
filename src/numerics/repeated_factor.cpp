#include "numerics/repeated_factor.hpp"

#include <new>

#include "base/error.hpp"
#include "numerics/cholmod_workspace.hpp"
#include "numerics/fronts.hpp"

namespace dygita {

RepeatedFactor::RepeatedFactor(const SparseMatrix& pattern, const std::vector<int>& node_of_dof,
                               const std::string& what)
    : cholmod_(std::make_unique<Cholmod>()), what_(what) {
  order_ = analyse(*cholmod_, pattern, node_of_dof, std::vector<char>(node_of_dof.size(), 0), what);
  const int n = static_cast<int>(order_.size());
  for (size_t s = 0; s < cholmod_->n_supernodes(); ++s) supernodes_.push_back(cholmod_->supernode(s, n));
}

RepeatedFactor::~RepeatedFactor() = default;
RepeatedFactor::RepeatedFactor(RepeatedFactor&&) noexcept = default;

double RepeatedFactor::bytes() const {
  double sum = 0.0;
  for (const SupernodeView& s : supernodes_) sum += supernode_bytes(s.n_columns, s.n_below) + 4.0 * s.n_below;
  return sum;
}

double RepeatedFactor::operations() const { return cholmod_->common.fl; }

bool RepeatedFactor::factorise(const SparseMatrix& matrix) {
  factor_.clear();
  try {
    const auto keep = [&](const SupernodeView& supernode, int place) { factor_.add(supernode, place); };
    const bool is_positive =
        eliminate(matrix, order_, static_cast<int>(order_.size()), supernodes_, keep).not_positive < 0;
    factor_.arrange();
    return is_positive;
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

}  // namespace dygita
