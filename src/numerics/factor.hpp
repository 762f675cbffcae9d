// Sparse Cholesky factor with the interface unknowns last, and the solves that stop at the interface.
// CHOLMOD orders and lays out (cholmod_workspace.cpp), the numbers are computed by fronts (fronts.cpp).
#pragma once

#include <string>
#include <vector>

#include "numerics/packed_factor.hpp"
#include "numerics/types.hpp"

namespace dygita {

// A in the order [interior, interface], of which the interior is factorised, L_II L_II^T, and the interface is what is
// left of it. Vectors passed to the solves are in this order (`order`), so that state kept in it is never gathered
// (manual, one solve per step). n_rhs right-hand sides: columns of a matrix.
class Factor {
 public:
  // matrix: symmetric positive definite, n x n, both triangles stored; node_of_dof: graph vertex of each unknown,
  // unknowns of a node contiguous; is_interface: unknowns to order last. Fill is reduced by METIS nested dissection on
  // nodes. error: in single precision, largest error of an entry of L, of the norm of its row (the square root of the
  // diagonal of A). Throws NumericalError, naming `what`, when the matrix is not positive definite.
  Factor(const SparseMatrix& matrix, const std::vector<int>& node_of_dof, const std::vector<char>& is_interface,
         const std::string& what, Precision precision = Precision::double_precision, double error = 0x1p-26);

  int size() const { return static_cast<int>(order_.size()); }
  int n_interior() const { return n_interior_; }
  int n_interface() const { return size() - n_interior_; }
  // order()[i] is the unknown of the matrix at position i of the factor.
  const std::vector<int>& order() const { return order_; }

  // x_I <- L_II^-1 x_I,  x_b <- x_b - L_bI x_I: what is left in x_b is the right-hand side condensed on the interface.
  void forward(Eigen::Ref<Mat> x) const;
  // Given x_b: x_I <- L_II^-T (x_I - L_bI^T x_b).
  void backward(Eigen::Ref<Mat> x) const;
  // The same of up to 16 vectors side by side, in less time where the factor is in single precision (PackedFactor).
  void forward_together(std::span<double* const> x) const { interior_.forward_together(x, size()); }
  void backward_together(std::span<double* const> x) const { interior_.backward_together(x, size()); }
  // x <- A^-1 x, where no unknown is the interface's.
  void solve(Eigen::Ref<Mat> x) const;
  // Schur complement of A on the interface, A_bb - L_bI L_bI^T (n_interface x n_interface, in factor order); once.
  Mat take_schur();

  double nonzeros() const;  // entries of L that a forward or backward solve reads
  double bytes() const;     // held by the factor
  // The same before factorising, from the ordering and the pattern alone, once the Schur complement is taken; in single
  // precision an estimate, since entries take the bytes that their size asks for.
  static double predicted_bytes(const SparseMatrix& matrix, const std::vector<int>& node_of_dof,
                                const std::vector<char>& is_interface,
                                Precision precision = Precision::double_precision, double error = 0x1p-26);

 private:
  std::vector<int> order_;
  int n_interior_ = 0;
  Mat schur_;  // lower triangle, until it is taken
  PackedFactor interior_;
};

// Flushes denormals in this thread; one thread inside BLAS, whoever calls it. Call before solving.
void prepare_thread();

// Kernels to ask OpenBLAS for (its OPENBLAS_CORETYPE): a release older than the processor does not know it and takes
// those of 2004, five times slower. Null where its own choice is good.
const char* better_blas_kernels();

// The BLAS in use ("OpenBLAS 0.3.21 ..."); warns when it is not OpenBLAS (5-10 times slower).
std::string blas_description();
std::string cholmod_version();

}  // namespace dygita
