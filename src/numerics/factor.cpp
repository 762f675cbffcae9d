#include "numerics/factor.hpp"

#include <cblas.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/log.hpp"
#include "base/threads.hpp"
#include "numerics/cholmod_workspace.hpp"

extern "C" {
void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info);
void dpotri_(const char* uplo, const int* n, double* a, const int* lda, int* info);
}

namespace dygita {

namespace {

PackedFactor pack(const Cholmod& cholmod, int n_interior, Precision precision, Vec largest_error) {
  PackedFactor packed(precision, std::move(largest_error));
  for (size_t s = 0; s < cholmod.n_supernodes(); ++s) {
    const SupernodeView view = cholmod.supernode(s, n_interior);
    if (view.n_columns == 0) break;
    packed.add(view);
  }
  packed.shrink();
  return packed;
}

// L_bb, lower triangle.
Mat interface_block(const Cholmod& cholmod, int n, int n_interior) {
  Mat l = Mat::Zero(n - n_interior, n - n_interior);
  for (size_t s = 0; s < cholmod.n_supernodes(); ++s) {
    const SupernodeView all = cholmod.supernode(s, n);
    for (int j = std::max(0, n_interior - all.first); j < all.n_columns; ++j) {
      const double* column = all.values + static_cast<size_t>(j) * all.stride;
      const int at = all.first + j - n_interior;
      for (int i = j; i < all.n_columns; ++i) l(all.first + i - n_interior, at) = column[i];
      for (int i = 0; i < all.n_below; ++i) l(all.below[i] - n_interior, at) = column[all.n_columns + i];
    }
  }
  return l;
}

}  // namespace

Factor::Factor(const SparseMatrix& matrix, const std::vector<int>& node_of_dof, const std::vector<char>& is_interface,
               const std::string& what, Precision precision, double error) {
  Cholmod cholmod;
  order_ = analyse(cholmod, matrix, node_of_dof, is_interface, what);
  n_interior_ = static_cast<int>(std::count(is_interface.begin(), is_interface.end(), 0));
  cholmod_sparse a = view_of(matrix);
  cholmod_common& common = cholmod.common;
  {
    const SerialRegion serial;
    cholmod_factorize(&a, cholmod.l, &common);
  }
  if (common.status == CHOLMOD_NOT_POSDEF) {
    const int dof = order_[cholmod.l->minor];
    throw NumericalError(
        fmt::format("{}: the matrix is not positive definite (node {}): an unconstrained rigid motion, "
                    "or a cell of almost no volume",
                    what, node_of_dof[dof]));
  }
  if (common.status != CHOLMOD_OK) throw NumericalError(what + ": factorisation failed: out of memory");
  interface_ = interface_block(cholmod, size(), n_interior_);
  Vec largest_error(size());
  for (int i = 0; i < size(); ++i) largest_error[i] = error * std::sqrt(matrix.coeff(order_[i], order_[i]));
  interior_ = pack(cholmod, n_interior_, precision, std::move(largest_error));
}

double Factor::predicted_bytes(const SparseMatrix& matrix, const std::vector<int>& node_of_dof,
                               const std::vector<char>& is_interface, Precision precision, double error) {
  // Of the bytes in double precision, fitted to factors of cubes at CFL 2: every bit of accuracy moves some tiles to
  // longer entries.
  const double single_share = (0.15 * std::log2(1.0 / error) - 0.85) / 8.0;
  Cholmod cholmod;
  analyse(cholmod, matrix, node_of_dof, is_interface, "prediction");
  const auto n_interior = static_cast<int>(std::count(is_interface.begin(), is_interface.end(), 0));
  double bytes = 0.0;
  for (size_t s = 0; s < cholmod.n_supernodes(); ++s) {
    const SupernodeView view = cholmod.supernode(s, n_interior);
    if (view.n_columns == 0) break;
    bytes += (precision == Precision::double_precision ? 1.0 : single_share) *
                 supernode_bytes(view.n_columns, view.n_below) +
             4.0 * view.n_below;
  }
  return bytes;
}

double Factor::bytes() const { return interior_.bytes() + 8.0 * static_cast<double>(interface_.size()); }
double Factor::nonzeros() const { return interior_.nonzeros(); }

void Factor::forward(Eigen::Ref<Mat> x) const { interior_.forward(x); }
void Factor::backward(Eigen::Ref<Mat> x) const { interior_.backward(x); }

void Factor::solve(Eigen::Ref<Mat> x) const {
  CHECK(interface_.rows() == n_interface(), "the factor's interface was released");
  forward(x);
  if (n_interface() > 0) {
    const auto lower = interface_.triangularView<Eigen::Lower>();
    auto on_interface = x.bottomRows(n_interface());
    lower.solveInPlace(on_interface);
    lower.transpose().solveInPlace(on_interface);
  }
  backward(x);
}

Mat Factor::interface_schur() const {
  CHECK(interface_.rows() == n_interface(), "the factor's interface was released");
  const int n_b = n_interface();
  Mat schur(n_b, n_b);
  // Rows and columns of L_bb end at its diagonal: by block columns, a third of the operations of L_bb L_bb^T.
  constexpr int block = 256;
  for (int j = 0; j < n_b; j += block) {
    const int width = std::min(block, n_b - j), end = j + width;
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, n_b - j, width, end, 1.0, interface_.data() + j, n_b,
                interface_.data() + j, n_b, 0.0, schur.data() + static_cast<size_t>(j) * n_b + j, n_b);
  }
  schur.triangularView<Eigen::StrictlyUpper>() = schur.transpose();
  return schur;
}

Mat inverse_spd(Mat matrix, const std::string& what) {
  const int n = static_cast<int>(matrix.rows());
  if (n == 0) return matrix;
  int info = 0;
  dpotrf_("L", &n, matrix.data(), &n, &info);
  if (info == 0) dpotri_("L", &n, matrix.data(), &n, &info);
  if (info != 0)
    throw NumericalError(
        fmt::format("{}: the interface operator is not positive definite (unknown {} of {})", what, info, n));
  return matrix;
}

void multiply_symmetric(const Mat& lower, const Vec& x, Vec& y) {
  const int n = static_cast<int>(lower.rows());
  y.resize(n);
  if (n > 0) cblas_dsymv(CblasColMajor, CblasLower, n, 1.0, lower.data(), n, x.data(), 1, 0.0, y.data(), 1);
}

void prepare_thread() {
  flush_denormals();
  openblas_set_num_threads(1);
}

const char* better_blas_kernels() {
#if defined(__x86_64__)
  const std::string chosen = openblas_get_corename();
  for (const char* old : {"Prescott", "Core2", "Penryn", "Dunnington", "Nehalem", "Sandybridge", "Generic", "Atom"}) {
    if (chosen != old) continue;
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512dq"))
      return "SkylakeX";
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "Haswell";
  }
#endif
  return nullptr;
}

std::string blas_description() { return fmt::format("{}, kernels {}", openblas_get_config(), openblas_get_corename()); }

std::string cholmod_version() {
  return fmt::format("{}.{}.{}", CHOLMOD_MAIN_VERSION, CHOLMOD_SUB_VERSION, CHOLMOD_SUBSUB_VERSION);
}

}  // namespace dygita
