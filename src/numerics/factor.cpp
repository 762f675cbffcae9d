#include "numerics/factor.hpp"

#include <cblas.h>

#include <algorithm>
#include <cmath>

#include "base/aside.hpp"
#include "base/error.hpp"
#include "base/log.hpp"
#include "base/threads.hpp"
#include "numerics/blas_buffers.hpp"
#include "numerics/cholmod_workspace.hpp"
#include "numerics/fronts.hpp"
#include "numerics/spd_inverse.hpp"

// OpenBLAS's own, which it exports without a header; not every build does.
extern "C" {
void* blas_memory_alloc(int) __attribute__((weak));
void blas_memory_free(void*) __attribute__((weak));
}

namespace dygita {

namespace {

std::vector<SupernodeView> interior_supernodes(const Cholmod& cholmod, int n_interior) {
  std::vector<SupernodeView> supernodes;
  for (size_t s = 0; s < cholmod.n_supernodes(); ++s) {
    const SupernodeView view = cholmod.supernode(s, n_interior);
    if (view.n_columns == 0) break;
    supernodes.push_back(view);
  }
  return supernodes;
}

}  // namespace

Factor::Factor(const SparseMatrix& matrix, const std::vector<int>& node_of_dof, const std::vector<char>& is_interface,
               const std::string& what, Precision precision, double error) {
  Cholmod cholmod;
  order_ = analyse(cholmod, matrix, node_of_dof, is_interface, what);
  n_interior_ = static_cast<int>(std::count(is_interface.begin(), is_interface.end(), 0));
  Vec largest_error(size());
  for (int i = 0; i < size(); ++i) largest_error[i] = error * std::sqrt(matrix.coeff(order_[i], order_[i]));
  interior_ = PackedFactor(precision, std::move(largest_error));
  Eliminated left = eliminate(
      matrix, order_, n_interior_, interior_supernodes(cholmod, n_interior_),
      [&](const SupernodeView& supernode, int place) { interior_.add(supernode, place); }, give_up_if_stopped);
  interior_.arrange();
  if (left.not_positive >= 0)
    throw NumericalError(
        fmt::format("{}: the matrix is not positive definite (node {}): an unconstrained rigid motion, "
                    "or a cell of almost no volume",
                    what, node_of_dof[order_[left.not_positive]]));
  schur_ = std::move(left.schur);
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

double Factor::bytes() const { return interior_.bytes() + 8.0 * static_cast<double>(schur_.size()); }
double Factor::nonzeros() const { return interior_.nonzeros(); }

void Factor::forward(Eigen::Ref<Mat> x) const { interior_.forward(x); }
void Factor::backward(Eigen::Ref<Mat> x) const { interior_.backward(x); }

void Factor::solve(Eigen::Ref<Mat> x) const {
  CHECK(n_interface() == 0, "what is left on the interface is not factorised here");
  forward(x);
  backward(x);
}

Mat Factor::take_schur() {
  CHECK(schur_.rows() == n_interface(), "the Schur complement has been taken");
  Mat schur = std::move(schur_);
  schur_.resize(0, 0);
  mirror_lower(schur);
  return schur;
}

void prepare_thread() {
  flush_denormals();
  openblas_set_num_threads(1);
}

void take_blas_buffers(int n_threads) {
  if (!blas_memory_alloc || !blas_memory_free) return;
  std::vector<void*> buffers;  // taken together: one that is given back serves the next
  constexpr int most = 64;     // it has no more in some builds
  for (int i = 0; i < std::min(n_threads, most); ++i) buffers.push_back(blas_memory_alloc(0));
  for (void* buffer : buffers) blas_memory_free(buffer);
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
