#include "numerics/factor.hpp"

#include <cblas.h>
#include <cholmod.h>
#include <metis.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>

#include "base/error.hpp"
#include "base/log.hpp"
#include "base/threads.hpp"
#include "numerics/huge_pages.hpp"
#include "numerics/partition.hpp"

extern "C" {
void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info);
void dpotri_(const char* uplo, const int* n, double* a, const int* lda, int* info);
}

namespace dygita {

namespace {

// METIS nested dissection of the graph of nodes; returns the nodes in elimination order.
std::vector<int> nested_dissection(const SparseMatrix& matrix, const std::vector<int>& node_of_dof, int n_nodes) {
  std::vector<idx_t> start{0}, neighbours;
  std::vector<int> last_seen(n_nodes, -1);
  for (int dof = 0; dof < matrix.rows();) {
    const int node = node_of_dof[dof];
    last_seen[node] = node;
    for (; dof < matrix.rows() && node_of_dof[dof] == node; ++dof)
      for (SparseMatrix::InnerIterator entry(matrix, dof); entry; ++entry) {
        const int other = node_of_dof[entry.col()];
        if (last_seen[other] == node) continue;
        last_seen[other] = node;
        neighbours.push_back(other);
      }
    start.push_back(static_cast<idx_t>(neighbours.size()));
  }
  std::vector<idx_t> perm(n_nodes), inverse(n_nodes);
  idx_t n = n_nodes;
  if (neighbours.empty()) {
    std::iota(perm.begin(), perm.end(), 0);
  } else {
    idx_t options[METIS_NOPTIONS];
    METIS_SetDefaultOptions(options);
    options[METIS_OPTION_SEED] = 1;
    const std::scoped_lock lock(metis_mutex());
    const int status = METIS_NodeND(&n, start.data(), neighbours.data(), nullptr, options, perm.data(), inverse.data());
    CHECK(status == METIS_OK, "METIS could not order the unknowns");
  }
  return {perm.begin(), perm.end()};
}

// Unknowns in elimination order: interior nodes as METIS has them, then the interface.
std::vector<int> interface_last_order(const SparseMatrix& matrix, const std::vector<int>& node_of_dof,
                                      const std::vector<char>& is_interface) {
  const int n = static_cast<int>(matrix.rows());
  // Number the nodes that carry unknowns compactly.
  std::vector<int> compact(n);
  std::vector<int> first_dof;
  for (int dof = 0; dof < n; ++dof) {
    if (dof == 0 || node_of_dof[dof] != node_of_dof[dof - 1]) first_dof.push_back(dof);
    compact[dof] = static_cast<int>(first_dof.size()) - 1;
  }
  const int n_nodes = static_cast<int>(first_dof.size());
  first_dof.push_back(n);
  const std::vector<int> nodes = nested_dissection(matrix, compact, n_nodes);
  std::vector<int> order;
  order.reserve(n);
  for (const char wanted : {0, 1})
    for (const int node : nodes)
      for (int dof = first_dof[node]; dof < first_dof[node + 1]; ++dof)
        if ((is_interface[dof] != 0) == (wanted != 0)) order.push_back(dof);
  return order;
}

}  // namespace

namespace {

// CHOLMOD's workspace and, in it, a supernodal factor.
struct Cholmod {
  cholmod_common common;
  cholmod_factor* l = nullptr;

  Cholmod() {
    [[maybe_unused]] static const bool is_set = [] {
      SuiteSparse_config.malloc_func = allocate_huge_pages;
      return true;
    }();
    cholmod_start(&common);
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.print = 0;
    common.quick_return_if_not_posdef = 1;
  }
  ~Cholmod() {
    cholmod_free_factor(&l, &common);
    cholmod_finish(&common);
  }
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;

  size_t n_supernodes() const { return l->nsuper; }
  // Columns of a supernode before `end`, as a dense block with all rows below them.
  SupernodeView supernode(size_t s, int end) const {
    const int* super = static_cast<const int*>(l->super);
    const int* pi = static_cast<const int*>(l->pi);
    const int* px = static_cast<const int*>(l->px);
    const int n_rows = pi[s + 1] - pi[s], m = std::clamp(end - super[s], 0, super[s + 1] - super[s]);
    const double* values = l->x ? static_cast<const double*>(l->x) + px[s] : nullptr;
    return {super[s], m, n_rows - m, static_cast<const int*>(l->s) + pi[s] + m, values, n_rows};
  }
};

}  // namespace

namespace {

// A symmetric matrix by rows is the same by columns: CHOLMOD reads the upper triangle in place.
cholmod_sparse view_of(const SparseMatrix& matrix) {
  cholmod_sparse a{};
  a.nrow = a.ncol = static_cast<size_t>(matrix.rows());
  a.nzmax = static_cast<size_t>(matrix.nonZeros());
  a.p = const_cast<int*>(matrix.outerIndexPtr());
  a.i = const_cast<int*>(matrix.innerIndexPtr());
  a.x = const_cast<double*>(matrix.valuePtr());
  a.stype = 1;
  a.itype = CHOLMOD_INT;
  a.xtype = CHOLMOD_REAL;
  a.dtype = CHOLMOD_DOUBLE;
  a.sorted = a.packed = 1;
  return a;
}

}  // namespace

namespace {

// CHOLMOD opens a team of threads at every supernode, which costs more than it gains and far more on a busy machine.
// Inside our own team that is off already; outside it is switched off here.
class SerialRegion {
 public:
  SerialRegion() : levels_(omp_get_max_active_levels()) {
    if (omp_get_active_level() == 0) omp_set_max_active_levels(0);
  }
  ~SerialRegion() {
    if (omp_get_active_level() == 0) omp_set_max_active_levels(levels_);
  }
  SerialRegion(const SerialRegion&) = delete;
  SerialRegion& operator=(const SerialRegion&) = delete;

 private:
  int levels_;
};

}  // namespace

namespace {

// Ordering and pattern of the factor; returns the order of the unknowns.
std::vector<int> analyse(Cholmod& cholmod, const SparseMatrix& matrix, const std::vector<int>& node_of_dof,
                         const std::vector<char>& is_interface, const std::string& what) {
  const int n = static_cast<int>(matrix.rows());
  CHECK(n > 0 && matrix.cols() == n && static_cast<int>(node_of_dof.size()) == n &&
            static_cast<int>(is_interface.size()) == n,
        "factor of an ill-shaped matrix");
  std::vector<int> given = interface_last_order(matrix, node_of_dof, is_interface), order;
  const auto n_interior = std::count(is_interface.begin(), is_interface.end(), 0);
  cholmod_sparse a = view_of(matrix);
  // Postordering groups the supernodes; where it would move an interface unknown forward it is left out.
  cholmod_common& common = cholmod.common;
  for (const int postorder : {1, 0}) {
    common.postorder = postorder;
    cholmod_free_factor(&cholmod.l, &common);
    cholmod.l = cholmod_analyze_p(&a, given.data(), nullptr, 0, &common);
    if (!cholmod.l)
      throw NumericalError(what + ": the factorisation cannot be laid out: out of memory, or more than 2^31 entries");
    const int* perm = static_cast<const int*>(cholmod.l->Perm);
    order.assign(perm, perm + n);
    if (std::all_of(order.begin() + n_interior, order.end(), [&](int dof) { return is_interface[dof] != 0; })) break;
    CHECK(postorder == 1, "interface unknowns are not last in the factor");
  }
  return order;
}

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
