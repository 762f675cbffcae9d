// The only place that names CHOLMOD, with repeated_factor.cpp: its workspace and what it lays out. METIS is named in
// cholmod_workspace.cpp and in partition.cpp. Nothing outside this folder includes it.
#pragma once

#include <cholmod.h>

#include <algorithm>
#include <string>
#include <vector>

#include "numerics/packed_factor.hpp"
#include "numerics/types.hpp"

namespace dygita {

// CHOLMOD's workspace and, in it, a supernodal factor.
struct Cholmod {
  cholmod_common common;
  cholmod_factor* l = nullptr;

  Cholmod();
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

// A symmetric matrix by rows is the same by columns: CHOLMOD reads the upper triangle in place.
cholmod_sparse view_of(const SparseMatrix& matrix);

// Ordering and pattern of the factor, the unknowns of is_interface last (Factor's docstring); returns the order of the
// unknowns. Throws NumericalError naming `what`.
std::vector<int> analyse(Cholmod& cholmod, const SparseMatrix& matrix, const std::vector<int>& node_of_dof,
                         const std::vector<char>& is_interface, const std::string& what);

}  // namespace dygita
