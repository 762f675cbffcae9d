// Inverses of dense symmetric positive definite matrices.
#pragma once

#include <string>

#include "numerics/packed_factor.hpp"
#include "numerics/types.hpp"

namespace dygita {

// Inverse of a symmetric positive definite matrix, lower triangle valid on return. Throws NumericalError naming `what`.
Mat inverse_spd(Mat matrix, const std::string& what);

// The upper triangle from the lower one.
void mirror_lower(Mat& a);

// y = A x with A symmetric, only its lower triangle read.
void multiply_symmetric(const Mat& lower, const Vec& x, Vec& y);

// A^-1 of a symmetric positive definite matrix A (n x n), for products with vectors.
class SpdInverse {
 public:
  // As a matrix, or as the Cholesky factor of A: that takes a third of the operations to make, and a product reads
  // twice as much.
  enum class Form { matrix, factor };

  // How a matrix is kept: as a SymmetricOperator of this precision and error; and beside it, where their errors are not
  // zero, another one in half precision, of which most entries take 8 or 16 bits, and a rough one, most of which is not
  // stored at all.
  struct Storage {
    Precision precision = Precision::double_precision;
    double error = 0.0, half_error = 0.0, rough_error = 0.0;
  };

  // The lower triangle of a is read. A factor is kept in double precision, with nothing beside it. Throws
  // NumericalError naming `what` when a is not positive definite.
  SpdInverse(Mat a, Form form, const Storage& storage, const std::string& what);
  // The form in which that many products cost least, what it takes to make it included.
  static Form cheapest(int n, double n_products);

  int size() const { return n_; }
  Form form() const { return form_; }
  // y = A^-1 x.
  void multiply(const Vec& x, Vec& y) const;
  // The same of several vectors.
  void multiply(std::span<const double* const> x, std::span<double* const> y) const;
  // The same with what is kept of A^-1 in half precision, or roughly.
  bool has_half() const { return half_.size() > 0; }
  void multiply_in_half(const Vec& x, Vec& y) const { half_.multiply(x, y); }
  bool has_rough() const { return rough_.size() > 0; }
  void multiply_roughly(const Vec& x, Vec& y) const { rough_.multiply(x, y); }
  void multiply_roughly(std::span<const double* const> x, std::span<double* const> y) const;
  // A^-1 X of many columns, by dense algebra.
  Mat times(Mat x) const;
  // A^-1, its lower triangle.
  Mat lower() const;
  double bytes() const {
    return form_ == Form::matrix ? matrix_.bytes() + half_.bytes() + rough_.bytes() : factor_.bytes();
  }

 private:
  Mat unpacked_factor() const;
  // By the factor, of up to 16 vectors, side by side.
  void substitute_together(std::span<const double* const> x, std::span<double* const> y) const;

  int n_ = 0;
  Form form_;
  SymmetricOperator matrix_, half_, rough_;
  Panels factor_;
};

}  // namespace dygita
