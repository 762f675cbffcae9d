// A sparse Cholesky factor computed again and again for matrices of one pattern: ordered once.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "numerics/packed_factor.hpp"
#include "numerics/scratch_pages.hpp"
#include "numerics/types.hpp"

namespace dygita {

struct Cholmod;

// The same bits for any number of threads, which share the large fronts.
class RepeatedFactor {
 public:
  // pattern: n x n, both triangles, unknowns of a node contiguous (node_of_dof). Throws NumericalError naming `what`
  // when the factor cannot be laid out.
  RepeatedFactor(const SparseMatrix& pattern, const std::vector<int>& node_of_dof, const std::string& what);
  ~RepeatedFactor();
  RepeatedFactor(RepeatedFactor&&) noexcept;

  double bytes() const;                                     // of the factor, once computed
  double bytes_at_work() const;                             // beside it, while one thread computes it
  const std::vector<int>& order() const { return order_; }  // the unknown at each position of the factor
  double operations() const { return operations_; }         // of one factorisation
  // matrix: of the pattern given. false: it is not positive definite. Throws NumericalError when out of memory.
  // watch: is called with how much of the work is done, 0 to 1; one call at a time, on any thread. What it throws ends
  // the work, and there is no factor then.
  bool factorise(const SparseMatrix& matrix, const std::function<void(double)>& watch = {});
  // The unknown at which the last matrix was found not to be positive definite; -1: it is.
  int not_positive() const { return not_positive_; }
  // The same of a matrix whose unknowns are in that order already, its upper triangle alone.
  bool factorise_in_order(const SparseMatrix& upper, const std::function<void(double)>& watch = {});
  // A^-1 b of the matrix last factorised; several right-hand sides are columns.
  Mat solve(const Mat& b) const;
  // What b of these unknowns alone reaches, and A^-1 b of such a b: right at these unknowns, elsewhere anything.
  std::vector<char> reach_of(const std::vector<int>& unknowns) const;
  Vec solve(const Vec& b, const std::vector<char>& reach) const;

 private:
  bool factorise(const SparseMatrix& matrix, const std::vector<int>& order, const std::function<void(double)>& watch);

  std::unique_ptr<Cholmod> cholmod_;  // the pattern of the factor
  std::vector<int> order_;
  std::vector<SupernodeView> supernodes_;
  PackedFactor factor_;
  std::unique_ptr<KeepScratch> scratch_ = std::make_unique<KeepScratch>();
  double operations_ = 0.0;
  int not_positive_ = -1;
  std::string what_;
};

}  // namespace dygita
