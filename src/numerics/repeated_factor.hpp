// A sparse Cholesky factor computed again and again for matrices of one pattern: ordered once.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "numerics/types.hpp"

namespace dygita {

struct Cholmod;

// The same bits for any number of threads: the factorisation runs on one.
class RepeatedFactor {
 public:
  // pattern: n x n, both triangles, unknowns of a node contiguous (node_of_dof). Throws NumericalError naming `what`
  // when the factor cannot be laid out.
  RepeatedFactor(const SparseMatrix& pattern, const std::vector<int>& node_of_dof, const std::string& what);
  ~RepeatedFactor();
  RepeatedFactor(RepeatedFactor&&) noexcept;

  double bytes() const;       // of the factor, once computed
  double operations() const;  // of one factorisation
  // matrix: of the pattern given. false: it is not positive definite. Throws NumericalError when out of memory.
  bool factorise(const SparseMatrix& matrix);
  // A^-1 b of the matrix last factorised; several right-hand sides are columns.
  Mat solve(const Mat& b) const;

 private:
  std::unique_ptr<Cholmod> cholmod_;
  std::string what_;
};

}  // namespace dygita
