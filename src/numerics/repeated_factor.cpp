#include "numerics/repeated_factor.hpp"

#include "base/error.hpp"
#include "numerics/cholmod_workspace.hpp"

namespace dygita {

RepeatedFactor::RepeatedFactor(const SparseMatrix& pattern, const std::vector<int>& node_of_dof,
                               const std::string& what)
    : cholmod_(std::make_unique<Cholmod>()), what_(what) {
  analyse(*cholmod_, pattern, node_of_dof, std::vector<char>(node_of_dof.size(), 0), what);
}

RepeatedFactor::~RepeatedFactor() = default;
RepeatedFactor::RepeatedFactor(RepeatedFactor&&) noexcept = default;

double RepeatedFactor::bytes() const { return 8.0 * static_cast<double>(cholmod_->l->xsize); }
double RepeatedFactor::operations() const { return cholmod_->common.fl; }

bool RepeatedFactor::factorise(const SparseMatrix& matrix) {
  cholmod_sparse a = view_of(matrix);
  cholmod_common& common = cholmod_->common;
  {
    const SerialRegion serial;
    cholmod_factorize(&a, cholmod_->l, &common);
  }
  if (common.status == CHOLMOD_NOT_POSDEF) return false;
  if (common.status != CHOLMOD_OK) throw NumericalError(what_ + ": factorisation failed: out of memory");
  return true;
}

Mat RepeatedFactor::solve(const Mat& b) const {
  cholmod_dense view{};
  view.nrow = view.d = static_cast<size_t>(b.rows());
  view.ncol = static_cast<size_t>(b.cols());
  view.nzmax = static_cast<size_t>(b.size());
  view.x = const_cast<double*>(b.data());
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  const SerialRegion serial;
  cholmod_dense* x = cholmod_solve(CHOLMOD_A, cholmod_->l, &view, &cholmod_->common);
  if (!x) throw NumericalError(what_ + ": out of memory");
  Mat answer = Eigen::Map<const Mat>(static_cast<const double*>(x->x), b.rows(), b.cols());
  cholmod_free_dense(&x, &cholmod_->common);
  return answer;
}

}  // namespace dygita
