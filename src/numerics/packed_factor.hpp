// The interior of a supernodal Cholesky factor, packed for substitution, and a symmetric matrix packed for products.
#pragma once

#include <span>
#include <vector>

#include "numerics/panels.hpp"
#include "numerics/types.hpp"

namespace dygita {

// What a supernode is made from: columns [first, first + n_columns) of L, dense, column-major with leading dimension
// `stride`; the rows are those columns, then `below` (n_below).
struct SupernodeView {
  int first, n_columns, n_below;
  const int* below;
  const double* values;
  int stride;
};

class PackedFactor {
 public:
  // largest_error: of an entry in each row, in single precision.
  explicit PackedFactor(Precision precision = Precision::double_precision, Vec largest_error = {});
  // Adds a supernode, which has a place among all of them: after those whose rows below are its columns.
  void add(const SupernodeView& supernode, int place);
  // All have been added.
  void arrange();
  // Forgets all of them, and keeps the memory for as many.
  void clear();
  // x: all unknowns in factor order, a column a right-hand side. L x' = x over the packed columns; the rows below take
  // their share.
  void forward(Eigen::Ref<Mat> x) const;
  // L^T x' = x over the packed columns, with what the rows below hold given.
  void backward(Eigen::Ref<Mat> x) const;
  // The same of one right-hand side where it reaches alone: supernodes, of all in order of their places, that are to be
  // gone through. The unknowns of the others stay as they are.
  void forward(Vec& x, const std::vector<char>& reach) const { forward_one(x.data(), &reach); }
  void backward(Vec& x, const std::vector<char>& reach) const { backward_one(x.data(), &reach); }

  // The same of up to 16 vectors of n unknowns, side by side. In single precision sums of 16 panels or tiles at most
  // are in single precision, which is not to the bits of one vector by itself.
  void forward_together(std::span<double* const> x, int n) const;
  void backward_together(std::span<double* const> x, int n) const;

  double bytes() const {
    return panels_.bytes() + static_cast<double>(below_.size() * sizeof(int) + blocks_.size() * sizeof(Block));
  }
  // Entries of the lower triangle, without what packing adds or leaves out.
  double nonzeros() const { return nonzeros_; }

 private:
  struct Block {
    int first, n_columns, n_below;
    size_t below, first_panel;
    int place;
  };
  static size_t last_panel(const Block& b) { return b.first_panel + (b.n_columns - 1) / Panels::width; }
  // reach: null, all of them.
  void forward_one(double* x, const std::vector<char>* reach = nullptr) const;
  void backward_one(double* x, const std::vector<char>* reach = nullptr) const;
  // Up to 16 columns side by side.
  void forward_many(Eigen::Ref<Mat> x) const;
  void backward_many(Eigen::Ref<Mat> x) const;

  std::vector<Block> blocks_;
  std::vector<int> below_;
  Panels panels_;
  Vec tolerance_;
  double nonzeros_ = 0.0;
};

// Bytes that a supernode takes in double precision.
double supernode_bytes(int n_columns, int n_below);

// A symmetric matrix for products with vectors, most of whose entries are small: an interface operator.
class SymmetricOperator {
 public:
  SymmetricOperator() = default;
  // Positive definite; only the lower triangle is read. In single precision an entry is off by at most `error`
  // sqrt(a_ii a_jj), and the product is computed in single precision but for its long sums.
  SymmetricOperator(const Mat& lower, Precision precision, double error = 0x1p-30);
  int size() const { return n_; }
  // y = A x.
  void multiply(const Vec& x, Vec& y) const;
  // The same of up to 16 vectors, side by side.
  void multiply_together(std::span<const double* const> x, std::span<double* const> y) const;
  // The matrix as it is stored; its lower triangle is valid.
  Mat lower() const;
  double bytes() const { return panels_.bytes(); }

 private:
  int n_ = 0;
  Panels panels_;
};

}  // namespace dygita
