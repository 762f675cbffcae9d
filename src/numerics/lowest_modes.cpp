#include "numerics/lowest_modes.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <random>

#include "base/error.hpp"
#include "numerics/dense.hpp"

namespace dygita {

namespace {

constexpr int block = 8;
constexpr double dependent = 1e-10;  // of a column's norm: what is left of it is round-off
constexpr double round_off =
    1e-12;  // of the largest eigenvalue of B M: what an exhausted space has beside the true ones

// The Krylov space so far: V, M-orthonormal, and H = V^T M B M V.
class Space {
 public:
  Space(int size, const SparseMatrix& mass) : mass_(mass), v_(size, 4 * block) {}

  int n() const { return n_; }
  auto vectors() const { return v_.leftCols(n_); }

  // Takes the columns of w into the space, less what is in it; returns R, w = V (V^T M w) + (new columns) R.
  Mat add(Mat w, const Vec& scale) {
    const int width = static_cast<int>(w.cols()), before = n_;
    for (int pass = 0; pass < 2 && before > 0; ++pass) w -= vectors() * (vectors().transpose() * (mass_ * w));
    Mat r = Mat::Zero(0, width);
    for (int c = 0; c < width; ++c) {
      Vec column = w.col(c);
      Vec coefficients = Vec::Zero(n_ - before + 1);
      for (int pass = 0; pass < 2 && n_ > 0; ++pass) {
        const Vec along = vectors().transpose() * (mass_ * column);
        column -= vectors() * along;
        coefficients.head(n_ - before) += along.tail(n_ - before);
      }
      const double norm = std::sqrt(column.dot(mass_ * column));
      r.conservativeResize(n_ - before + (norm > dependent * scale[c] ? 1 : 0), width);
      for (int i = 0; i < n_ - before; ++i) r(i, c) = coefficients[i];
      if (norm <= dependent * scale[c]) continue;
      r.row(n_ - before).setZero();
      r(n_ - before, c) = norm;
      if (n_ == v_.cols()) v_.conservativeResize(Eigen::NoChange, 2 * n_);
      v_.col(n_++) = column / norm;
    }
    return r;
  }

 private:
  const SparseMatrix& mass_;
  Mat v_;
  int n_ = 0;
};

Vec norms(const Mat& x, const SparseMatrix& mass) {
  const Mat product = mass * x;
  Vec result(x.cols());
  for (int c = 0; c < x.cols(); ++c) result[c] = std::sqrt(std::max(0.0, x.col(c).dot(product.col(c))));
  return result;
}

}  // namespace

Modes lowest_modes(int size, const std::function<void(Eigen::Ref<Mat>)>& solve, const SparseMatrix& mass, double shift,
                   const ModeRequest& request, const std::string& what) {
  CHECK(mass.rows() == size && mass.cols() == size, "a mass matrix of another size");
  Modes modes;
  if (size == 0 || (request.n == 0 && request.up_to <= 0.0)) return modes;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Mat start(size, std::min(block, size));
  for (int c = 0; c < start.cols(); ++c)
    for (int i = 0; i < size; ++i) start(i, c) = uniform(random);
  // Into the range of B: within the constraints.
  Mat w = mass * start;
  solve(w);
  Space space(size, mass);
  space.add(w, norms(w, mass));
  Mat h = Mat::Zero(0, 0);
  int first = 0, checked = 0;
  while (true) {
    const int end = space.n(), width = end - first;
    Mat residual = Mat::Zero(0, std::max(width, 0));
    if (width > 0) {
      w = mass * space.vectors().rightCols(width);
      solve(w);
      const Mat column = space.vectors().transpose() * (mass * w);
      h.conservativeResize(end, end);
      h.rightCols(width) = column;
      h.bottomRows(width) = column.transpose();
      residual = space.add(w, norms(w, mass));
    }
    modes.is_all = residual.rows() == 0;
    // The small problem grows with the cube of its size: looked at as the space has grown by a tenth.
    if (!modes.is_all && end < 1.1 * checked) {
      first = end;
      continue;
    }
    checked = end;
    const EigenPairs eigen = symmetric_eigen(0.5 * (h + h.transpose()));
    const double smallest = round_off * eigen.values.tail(1)[0];
    const auto n_true = (eigen.values.array() > smallest).count();
    int n = 0;
    double last = 0.0;
    bool is_enough = false;
    for (; n < end && !is_enough; ++n) {
      const int at = end - 1 - n;
      const double theta = eigen.values[at];
      if (theta <= smallest) break;
      if (residual.rows() > 0 && (residual * eigen.vectors.col(at).tail(width)).norm() > request.tolerance * theta)
        break;
      last = 1.0 / theta - shift;
      if (request.n == 0 && last > request.up_to) break;
      is_enough = n + 1 == request.n;
    }
    const bool is_beyond = request.n == 0 && last > request.up_to;
    if (is_enough || is_beyond || modes.is_all) {
      modes.is_all = modes.is_all && n == n_true;
      modes.values.resize(n);
      Mat chosen(end, n);
      for (int i = 0; i < n; ++i) {
        modes.values[i] = 1.0 / eigen.values[end - 1 - i] - shift;
        chosen.col(i) = eigen.vectors.col(end - 1 - i);
      }
      modes.vectors = space.vectors().leftCols(end) * chosen;
      return modes;
    }
    if (n > request.most) throw NumericalError(fmt::format("{}: more than {} modes are asked for", what, request.most));
    first = end;
  }
}

}  // namespace dygita
