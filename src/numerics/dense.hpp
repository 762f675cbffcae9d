// Decompositions of dense matrices, compiled once: Eigen's templates take seconds in every file that names them.
#pragma once

#include <vector>

#include "numerics/types.hpp"

namespace dygita {

struct EigenPairs {
  Vec values;   // increasing
  Mat vectors;  // one column a value
};

// Of a symmetric matrix; the lower triangle is read.
EigenPairs symmetric_eigen(const Mat& a);

// The same of 3 x 3.
struct PrincipalAxes {
  Vec3 values;   // increasing
  Mat3 vectors;  // one column a value
};
PrincipalAxes principal_axes(const Mat3& a);

// K x = lambda M x with M positive definite; vectors are orthonormal in M.
EigenPairs generalized_symmetric_eigen(const Mat& k, const Mat& m);

// X of A X = B, by elimination with full pivoting; A square and regular, B with as many rows.
Mat solve_dense(const Mat& a, const Mat& b);

// Of a square and regular matrix.
Mat inverse(const Mat& a);

// Moore and Penrose's, of any matrix.
Mat pseudo_inverse(const Mat& a);

// X of least norm among those of least squares of A X - B, and the rank of A: pivots below `threshold` of the largest
// are zero.
struct LeastNorm {
  Mat x;
  int rank = 0;
};
LeastNorm solve_least_norm(const Mat& a, const Mat& b, double threshold);

// P A = L U of a square matrix, by LAPACK. Where it is singular, solutions are not finite.
class LuFactor {
 public:
  LuFactor() = default;
  explicit LuFactor(Mat a);
  Vec solve(Vec b) const { return solved(std::move(b), 'N'); }
  Vec solve_transposed(Vec b) const { return solved(std::move(b), 'T'); }

 private:
  Vec solved(Vec b, char which) const;

  Mat lu_;
  std::vector<int> pivots_;
};

// A = Q R, A of m rows and n <= m columns: Q m x m, R n x n.
struct QrFactors {
  Mat q, r;
};
QrFactors full_qr(const Mat& a);

// The same with columns pivoted: orthonormal basis of all rows' space and the number of columns that count, diagonal
// entries of R below `threshold` of the largest being zero.
struct RankedBasis {
  Mat q;
  int rank = 0;
};
RankedBasis ranked_basis(const Mat& a, double threshold);

}  // namespace dygita
