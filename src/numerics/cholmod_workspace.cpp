#include "numerics/cholmod_workspace.hpp"

#include <metis.h>

#include <memory>
#include <mutex>
#include <numeric>
#include <utility>

#include "base/aside.hpp"
#include "base/error.hpp"
#include "numerics/huge_pages.hpp"
#include "numerics/partition.hpp"

namespace dygita {

namespace {

// Beyond so many nodes the libraries take more than a tenth of a second, and nothing interrupts them.
constexpr int quick = 20000;

struct Dissection {
  std::vector<idx_t> start{0}, neighbours, perm, inverse;
  int status = METIS_OK;

  void find() {
    idx_t options[METIS_NOPTIONS];
    METIS_SetDefaultOptions(options);
    options[METIS_OPTION_SEED] = 1;
    auto n = static_cast<idx_t>(perm.size());
    const std::scoped_lock lock(metis_mutex());
    status = METIS_NodeND(&n, start.data(), neighbours.data(), nullptr, options, perm.data(), inverse.data());
  }
};

// METIS nested dissection of the graph of nodes; returns the nodes in elimination order.
std::vector<int> nested_dissection(const SparseMatrix& matrix, const std::vector<int>& node_of_dof, int n_nodes) {
  const auto graph = std::make_shared<Dissection>();
  std::vector<int> last_seen(n_nodes, -1);
  for (int dof = 0; dof < matrix.rows();) {
    const int node = node_of_dof[dof];
    last_seen[node] = node;
    for (; dof < matrix.rows() && node_of_dof[dof] == node; ++dof)
      for (SparseMatrix::InnerIterator entry(matrix, dof); entry; ++entry) {
        const int other = node_of_dof[entry.col()];
        if (last_seen[other] == node) continue;
        last_seen[other] = node;
        graph->neighbours.push_back(other);
      }
    graph->start.push_back(static_cast<idx_t>(graph->neighbours.size()));
  }
  graph->perm.resize(n_nodes);
  graph->inverse.resize(n_nodes);
  if (graph->neighbours.empty())
    std::iota(graph->perm.begin(), graph->perm.end(), 0);
  else if (n_nodes <= quick)
    graph->find();
  else
    do_aside([graph] { graph->find(); });
  CHECK(graph->status == METIS_OK, "METIS could not order the unknowns");
  return {graph->perm.begin(), graph->perm.end()};
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

Cholmod::Cholmod() {
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

namespace {

// A pattern that the analysis of a large matrix has to itself.
struct Analysis {
  std::vector<int> starts, columns, given;
  Cholmod cholmod;

  Analysis(const SparseMatrix& matrix, std::vector<int> order, int postorder)
      : starts(matrix.outerIndexPtr(), matrix.outerIndexPtr() + matrix.rows() + 1),
        columns(matrix.innerIndexPtr(), matrix.innerIndexPtr() + matrix.nonZeros()),
        given(std::move(order)) {
    cholmod.common.postorder = postorder;
  }
  void find() {
    cholmod_sparse a{};
    a.nrow = a.ncol = given.size();
    a.nzmax = columns.size();
    a.p = starts.data();
    a.i = columns.data();
    a.stype = 1;
    a.itype = CHOLMOD_INT;
    a.xtype = CHOLMOD_PATTERN;
    a.dtype = CHOLMOD_DOUBLE;
    a.sorted = a.packed = 1;
    cholmod.l = cholmod_analyze_p(&a, given.data(), nullptr, 0, &cholmod.common);
  }
};

cholmod_factor* laid_out(Cholmod& cholmod, const SparseMatrix& matrix, std::vector<int>& given) {
  if (matrix.rows() <= 3 * quick) {
    cholmod_sparse a = view_of(matrix);
    return cholmod_analyze_p(&a, given.data(), nullptr, 0, &cholmod.common);
  }
  const auto own = std::make_shared<Analysis>(matrix, given, cholmod.common.postorder);
  do_aside([own] { own->find(); });
  return std::exchange(own->cholmod.l, nullptr);
}

}  // namespace

std::vector<int> analyse(Cholmod& cholmod, const SparseMatrix& matrix, const std::vector<int>& node_of_dof,
                         const std::vector<char>& is_interface, const std::string& what) {
  const int n = static_cast<int>(matrix.rows());
  CHECK(n > 0 && matrix.cols() == n && static_cast<int>(node_of_dof.size()) == n &&
            static_cast<int>(is_interface.size()) == n,
        "factor of an ill-shaped matrix");
  std::vector<int> given = interface_last_order(matrix, node_of_dof, is_interface), order;
  const auto n_interior = std::count(is_interface.begin(), is_interface.end(), 0);
  // Postordering groups the supernodes; where it would move an interface unknown forward it is left out.
  cholmod_common& common = cholmod.common;
  for (const int postorder : {1, 0}) {
    common.postorder = postorder;
    cholmod_free_factor(&cholmod.l, &common);
    cholmod.l = laid_out(cholmod, matrix, given);
    if (!cholmod.l)
      throw NumericalError(what + ": the factorisation cannot be laid out: out of memory, or more than 2^31 entries");
    const int* perm = static_cast<const int*>(cholmod.l->Perm);
    order.assign(perm, perm + n);
    if (std::all_of(order.begin() + n_interior, order.end(), [&](int dof) { return is_interface[dof] != 0; })) break;
    CHECK(postorder == 1, "interface unknowns are not last in the factor");
  }
  return order;
}

}  // namespace dygita
