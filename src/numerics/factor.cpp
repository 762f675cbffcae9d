#include "numerics/factor.hpp"

#include <cblas.h>
#include <cholmod.h>
#include <metis.h>
#include <omp.h>
#include <pmmintrin.h>

#include <algorithm>
#include <mutex>
#include <numeric>

#include "base/error.hpp"
#include "base/log.hpp"
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

// Owns CHOLMOD's supernodal factor and the workspace it was made with.
struct Factor::Supernodes {
  cholmod_common common;
  cholmod_factor* l = nullptr;

  Supernodes() {
    cholmod_start(&common);
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.print = 0;
    common.quick_return_if_not_posdef = 1;
  }
  ~Supernodes() {
    cholmod_free_factor(&l, &common);
    cholmod_finish(&common);
  }
  Supernodes(const Supernodes&) = delete;
  Supernodes& operator=(const Supernodes&) = delete;

  // One supernode: columns [first, first + n_columns), rows listed, dense column-major block.
  struct Block {
    int first, n_columns, n_rows;
    const int* rows;
    const double* values;
  };
  Block block(size_t s) const {
    const int* super = static_cast<const int*>(l->super);
    const int* pi = static_cast<const int*>(l->pi);
    const int* px = static_cast<const int*>(l->px);
    return {super[s], super[s + 1] - super[s], pi[s + 1] - pi[s], static_cast<const int*>(l->s) + pi[s],
            static_cast<const double*>(l->x) + px[s]};
  }
  size_t n_blocks() const { return l->nsuper; }

  // Forward and backward substitution over the columns before `end`; a supernode that crosses it is cut there.
  void forward(double* x, int end, std::vector<double>& work) const;
  void backward(double* x, int end, std::vector<double>& work) const;
};

void Factor::Supernodes::forward(double* x, int end, std::vector<double>& work) const {
  for (size_t s = 0; s < n_blocks(); ++s) {
    const Block b = block(s);
    if (b.first >= end) break;
    const int m = std::min(b.n_columns, end - b.first);
    const int below = b.n_rows - m;
    cblas_dtrsv(CblasColMajor, CblasLower, CblasNoTrans, CblasNonUnit, m, b.values, b.n_rows, x + b.first, 1);
    if (below == 0) continue;
    cblas_dgemv(CblasColMajor, CblasNoTrans, below, m, 1.0, b.values + m, b.n_rows, x + b.first, 1, 0.0, work.data(), 1);
    for (int i = 0; i < below; ++i) x[b.rows[m + i]] -= work[i];
  }
}

void Factor::Supernodes::backward(double* x, int end, std::vector<double>& work) const {
  for (size_t s = n_blocks(); s-- > 0;) {
    const Block b = block(s);
    if (b.first >= end) continue;
    const int m = std::min(b.n_columns, end - b.first);
    const int below = b.n_rows - m;
    if (below > 0) {
      for (int i = 0; i < below; ++i) work[i] = x[b.rows[m + i]];
      cblas_dgemv(CblasColMajor, CblasTrans, below, m, -1.0, b.values + m, b.n_rows, work.data(), 1, 1.0, x + b.first, 1);
    }
    cblas_dtrsv(CblasColMajor, CblasLower, CblasTrans, CblasNonUnit, m, b.values, b.n_rows, x + b.first, 1);
  }
}

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

// CHOLMOD opens a team of threads at every supernode, which costs more than it gains and far more on a busy machine. Inside our own
// team that is off already; outside it is switched off here.
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

Factor::Factor() : supernodes_(std::make_unique<Supernodes>()) {}

void Factor::analyse(const SparseMatrix& matrix, const std::vector<int>& node_of_dof, const std::vector<char>& is_interface,
                     const std::string& what) {
  const int n = static_cast<int>(matrix.rows());
  CHECK(n > 0 && matrix.cols() == n && static_cast<int>(node_of_dof.size()) == n &&
            static_cast<int>(is_interface.size()) == n, "factor of an ill-shaped matrix");
  std::vector<int> order = interface_last_order(matrix, node_of_dof, is_interface);
  n_interior_ = static_cast<int>(std::count(is_interface.begin(), is_interface.end(), 0));
  cholmod_sparse a = view_of(matrix);
  // Postordering groups the supernodes; where it would move an interface unknown forward it is left out.
  cholmod_common& common = supernodes_->common;
  for (const int postorder : {1, 0}) {
    common.postorder = postorder;
    cholmod_free_factor(&supernodes_->l, &common);
    supernodes_->l = cholmod_analyze_p(&a, order.data(), nullptr, 0, &common);
    if (!supernodes_->l)
      throw NumericalError(what + ": the factorisation cannot be laid out: out of memory, or more than 2^31 entries");
    const int* perm = static_cast<const int*>(supernodes_->l->Perm);
    order_.assign(perm, perm + n);
    if (std::all_of(order_.begin() + n_interior_, order_.end(), [&](int dof) { return is_interface[dof] != 0; })) break;
    CHECK(postorder == 1, "interface unknowns are not last in the factor");
  }
}

Factor::Factor(const SparseMatrix& matrix, const std::vector<int>& node_of_dof, const std::vector<char>& is_interface,
               const std::string& what)
    : Factor() {
  analyse(matrix, node_of_dof, is_interface, what);
  cholmod_sparse a = view_of(matrix);
  cholmod_common& common = supernodes_->common;
  {
    const SerialRegion serial;
    cholmod_factorize(&a, supernodes_->l, &common);
  }
  if (common.status == CHOLMOD_NOT_POSDEF) {
    const int dof = order_[supernodes_->l->minor];
    throw NumericalError(fmt::format("{}: the matrix is not positive definite (node {}): a rigid motion that nothing holds, "
                                     "or a cell of almost no volume", what, node_of_dof[dof]));
  }
  if (common.status != CHOLMOD_OK) throw NumericalError(what + ": factorisation failed: out of memory");
}

double Factor::predicted_bytes(const SparseMatrix& matrix, const std::vector<int>& node_of_dof,
                               const std::vector<char>& is_interface) {
  Factor factor;
  factor.analyse(matrix, node_of_dof, is_interface, "prediction");
  return factor.bytes();
}

double Factor::bytes() const { return 8.0 * static_cast<double>(supernodes_->l->xsize) + 4.0 * static_cast<double>(supernodes_->l->ssize); }

Factor::~Factor() = default;
Factor::Factor(Factor&&) noexcept = default;
Factor& Factor::operator=(Factor&&) noexcept = default;

namespace {
// A workspace a thread: solves of different pieces run side by side.
std::vector<double>& thread_work(int n) {
  thread_local std::vector<double> work;
  if (static_cast<int>(work.size()) < n) work.resize(n);
  return work;
}
}  // namespace

void Factor::forward(Eigen::Ref<Vec> x) const { supernodes_->forward(x.data(), n_interior_, thread_work(size())); }
void Factor::backward(Eigen::Ref<Vec> x) const { supernodes_->backward(x.data(), n_interior_, thread_work(size())); }

void Factor::solve(Eigen::Ref<Vec> x) const {
  supernodes_->forward(x.data(), size(), thread_work(size()));
  supernodes_->backward(x.data(), size(), thread_work(size()));
}

Mat Factor::interface_schur() const {
  const int n_b = n_interface();
  Mat l = Mat::Zero(n_b, n_b);
  for (size_t s = 0; s < supernodes_->n_blocks(); ++s) {
    const Supernodes::Block b = supernodes_->block(s);
    for (int j = std::max(0, n_interior_ - b.first); j < b.n_columns; ++j)
      for (int i = j; i < b.n_rows; ++i)
        l(b.rows[i] - n_interior_, b.first + j - n_interior_) = b.values[static_cast<size_t>(j) * b.n_rows + i];
  }
  Mat schur(n_b, n_b);
  if (n_b > 0)
    cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, n_b, n_b, 1.0, l.data(), n_b, 0.0, schur.data(), n_b);
  schur.triangularView<Eigen::StrictlyUpper>() = schur.transpose();
  return schur;
}

double Factor::nonzeros() const {
  double count = 0;
  for (size_t s = 0; s < supernodes_->n_blocks(); ++s) {
    const Supernodes::Block b = supernodes_->block(s);
    const double m = std::clamp(n_interior_ - b.first, 0, b.n_columns);
    count += m * b.n_rows - m * (m - 1) / 2;
  }
  return count;
}

Mat inverse_spd(Mat matrix, const std::string& what) {
  const int n = static_cast<int>(matrix.rows());
  if (n == 0) return matrix;
  int info = 0;
  dpotrf_("L", &n, matrix.data(), &n, &info);
  if (info == 0) dpotri_("L", &n, matrix.data(), &n, &info);
  if (info != 0)
    throw NumericalError(fmt::format("{}: the interface operator is not positive definite (unknown {} of {})", what, info, n));
  return matrix;
}

void multiply_symmetric(const Mat& lower, const Vec& x, Vec& y) {
  const int n = static_cast<int>(lower.rows());
  y.resize(n);
  if (n > 0) cblas_dsymv(CblasColMajor, CblasLower, n, 1.0, lower.data(), n, x.data(), 1, 0.0, y.data(), 1);
}

void prepare_thread() {
  _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
  _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
  openblas_set_num_threads(1);
}

std::string blas_description() { return openblas_get_config(); }

std::string cholmod_version() {
  return fmt::format("{}.{}.{}", CHOLMOD_MAIN_VERSION, CHOLMOD_SUB_VERSION, CHOLMOD_SUBSUB_VERSION);
}

}  // namespace dygita
