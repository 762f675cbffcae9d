// Lowest eigenpairs against the dense solver of Eigen.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "base/error.hpp"
#include "numerics/dense.hpp"
#include "numerics/lowest_modes.hpp"

namespace dygita {
namespace {

// A grid of masses on springs along x and y, held by weak springs: many eigenvalues are double.
struct Membrane {
  SparseMatrix stiffness, mass;
  explicit Membrane(int n) : stiffness(n * n, n * n), mass(n * n, n * n) {
    Mat k = 1e-3 * Mat::Identity(n * n, n * n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        for (const auto& [a, b] : {std::pair{i + 1, j}, {i, j + 1}}) {
          if (a == n || b == n) continue;
          const int p = i * n + j, q = a * n + b;
          k(p, p) += 1;
          k(q, q) += 1;
          k(p, q) -= 1;
          k(q, p) -= 1;
        }
    stiffness = k.sparseView();
    mass.setIdentity();
    for (int i = 0; i < n * n; ++i) mass.coeffRef(i, i) = 2.0;
  }
  Modes lowest(const ModeRequest& request, double shift = 0.0) const {
    const Eigen::LLT<Mat> factor(Mat(stiffness) + shift * Mat(mass));
    return lowest_modes(
        static_cast<int>(mass.rows()), [&](Eigen::Ref<Mat> x) { x = factor.solve(Mat(x)); }, mass, shift, request,
        "grid");
  }
  Vec exact() const { return generalized_symmetric_eigen(Mat(stiffness), Mat(mass)).values; }
};

TEST(LowestModes, are_those_of_the_dense_solver_double_ones_included) {
  const Membrane grid(14);
  const Vec exact = grid.exact();
  for (const double shift : {0.0, 0.1}) {
    const Modes modes = grid.lowest({30, 0.0}, shift);
    ASSERT_EQ(modes.values.size(), 30);
    EXPECT_LT((modes.values - exact.head(30)).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_FALSE(modes.is_all);
    EXPECT_LT((modes.vectors.transpose() * grid.mass * modes.vectors - Mat::Identity(30, 30)).norm(), 1e-10);
    EXPECT_LT((grid.stiffness * modes.vectors - grid.mass * modes.vectors * modes.values.asDiagonal()).norm(), 1e-6);
  }
}

TEST(LowestModes, up_to_a_bound_are_all_of_them_and_no_more) {
  const Membrane grid(14);
  const Vec exact = grid.exact();
  for (const double bound : {1e-4, 0.01, 0.2, 1.0}) {
    const Modes modes = grid.lowest({0, bound});
    EXPECT_EQ(modes.values.size(), (exact.array() <= bound).count()) << bound;
  }
}

TEST(LowestModes, are_all_there_are_where_more_is_asked_for) {
  const Membrane grid(3);
  for (const ModeRequest& request : {ModeRequest{50, 0.0}, ModeRequest{0, 1e9}}) {
    const Modes modes = grid.lowest(request);
    ASSERT_EQ(modes.values.size(), 9);
    EXPECT_TRUE(modes.is_all);
    EXPECT_LT((modes.values - grid.exact()).cwiseAbs().maxCoeff(), 1e-12);
  }
  EXPECT_EQ(grid.lowest({0, 0.0}).values.size(), 0);
}

TEST(LowestModes, refuse_what_would_never_end) {
  ModeRequest request{0, 1e9};
  request.most = 10;
  EXPECT_THROW(Membrane(14).lowest(request), NumericalError);
}

}  // namespace
}  // namespace dygita
