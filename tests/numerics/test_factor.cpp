// The factor with the interface last, against dense algebra.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "base/aside.hpp"
#include "base/error.hpp"
#include "base/progress.hpp"
#include "base/team.hpp"
#include "numerics/dense.hpp"
#include "numerics/dense_blocks.hpp"
#include "numerics/factor.hpp"
#include "numerics/scratch_pages.hpp"
#include "numerics/spd_inverse.hpp"

namespace dygita {
namespace {

struct Grid {
  SparseMatrix matrix;
  std::vector<int> node_of_dof;
  std::vector<char> is_interface;
};

// A random positive definite matrix on an n x n x n grid with `per_node` unknowns per node; the plane i = 0 is the
// interface.
Grid grid(int n, int per_node) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> in(-1.0, 1.0);
  const auto index = [&](int i, int j, int k) { return (i * n + j) * n + k; };
  const int size = n * n * n * per_node;
  Mat dense = Mat::Zero(size, size);
  Grid g;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        const int a = index(i, j, k);
        for (int d = 0; d < per_node; ++d) {
          g.node_of_dof.push_back(a);
          g.is_interface.push_back(i == 0 && d < 2);
        }
        for (const int b : {i + 1 < n ? index(i + 1, j, k) : -1, j + 1 < n ? index(i, j + 1, k) : -1,
                            k + 1 < n ? index(i, j, k + 1) : -1}) {
          if (b < 0) continue;
          for (int r = 0; r < per_node; ++r)
            for (int c = 0; c < per_node; ++c)
              dense(a * per_node + r, b * per_node + c) = dense(b * per_node + c, a * per_node + r) = in(random);
        }
      }
  for (int r = 0; r < size; ++r) dense(r, r) = dense.row(r).cwiseAbs().sum() + 0.1;
  g.matrix = dense.sparseView();
  return g;
}

// The same without unknowns that are ordered last.
Grid without_interface(int n, int per_node) {
  Grid g = grid(n, per_node);
  g.is_interface.assign(g.is_interface.size(), 0);
  return g;
}

Vec ordered(const Factor& factor, const Vec& x) {
  Vec y(x.size());
  for (int i = 0; i < x.size(); ++i) y[i] = x[factor.order()[i]];
  return y;
}

TEST(Factor, is_left_where_the_user_stops_and_that_is_expected) {
  const Grid g = grid(6, 3);
  const auto make = [&] { return Factor(g.matrix, g.node_of_dof, g.is_interface, "matrix"); };
  request_interrupt();
  EXPECT_NO_THROW(make());
  {
    const MayBeAbandoned may;
    EXPECT_THROW(make(), Abandoned);
    EXPECT_THROW(inverse_spd(Mat::Identity(300, 300), "matrix"), Abandoned);
  }
  withdraw_interrupt();
  EXPECT_NO_THROW(make());
}

TEST(Factor, solves_as_dense_algebra_does) {
  for (const int per_node : {1, 3}) {
    const Grid g = without_interface(7, per_node);
    const Factor factor(g.matrix, g.node_of_dof, g.is_interface, "grid");
    const Vec b = Vec::LinSpaced(g.matrix.rows(), -1.0, 2.0);
    const Vec exact = solve_dense(Mat(g.matrix), b);
    Vec x = ordered(factor, b);
    factor.solve(x);
    EXPECT_LT((x - ordered(factor, exact)).norm(), 1e-12 * exact.norm());
  }
}

TEST(Factor, puts_the_interface_last) {
  const Grid g = grid(6, 3);
  const Factor factor(g.matrix, g.node_of_dof, g.is_interface, "grid");
  EXPECT_EQ(factor.n_interface(), 2 * 36);
  for (int i = 0; i < factor.size(); ++i) EXPECT_EQ(g.is_interface[factor.order()[i]] != 0, i >= factor.n_interior());
}

TEST(Factor, forward_interface_and_backward_make_the_whole_solve) {
  const Grid g = grid(7, 3);
  Factor factor(g.matrix, g.node_of_dof, g.is_interface, "grid");
  const Vec b = Vec::LinSpaced(g.matrix.rows(), -1.0, 2.0);
  const Vec whole = ordered(factor, solve_dense(Mat(g.matrix), b));
  Vec x = ordered(factor, b);
  factor.forward(x);
  const Mat h = inverse_spd(factor.take_schur(), "schur");
  Vec v;
  multiply_symmetric(h, x.tail(factor.n_interface()), v);
  x.tail(factor.n_interface()) = v;
  factor.backward(x);
  EXPECT_LT((x - whole).norm(), 1e-12 * whole.norm());
}

// What other factors have left in it does not matter.
TEST(Factor, has_the_same_bits_in_memory_that_others_have_worked_in) {
  const Grid large = grid(9, 3), small = grid(6, 3);
  const auto solved = [](const Grid& g) {
    Factor factor(g.matrix, g.node_of_dof, g.is_interface, "grid");
    Vec x = Vec::LinSpaced(g.matrix.rows(), -1.0, 2.0);
    factor.forward(x);
    const Mat schur = factor.take_schur();
    return std::pair<Vec, Mat>(x, schur.triangularView<Eigen::Lower>());
  };
  const auto alone = solved(small);
  const KeepScratch kept;
  {
    ScratchPages spoiled(size_t{1} << 24);
    std::fill_n(spoiled.doubles(), (size_t{1} << 24) / sizeof(double), std::numeric_limits<double>::quiet_NaN());
  }
  for (const Grid* g : {&large, &small, &large, &small}) {
    const auto again = solved(*g);
    if (g != &small) continue;
    EXPECT_EQ(again.first, alone.first);
    EXPECT_EQ(again.second, alone.second);
  }
}

TEST(Factor, solves_several_right_hand_sides_as_it_solves_one) {
  const Grid g = without_interface(7, 3);
  for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
    const Factor factor(g.matrix, g.node_of_dof, g.is_interface, "grid", precision);
    Mat together = Mat::Random(g.matrix.rows(), 21), alone = together;
    factor.solve(together);
    for (int c = 0; c < alone.cols(); ++c) factor.solve(alone.col(c));
    EXPECT_LT((together - alone).norm(), (precision == Precision::double_precision ? 1e-13 : 1e-6) * alone.norm());
  }
}

std::vector<double*> columns_of(Mat& x) {
  std::vector<double*> columns;
  for (Eigen::Index c = 0; c < x.cols(); ++c) columns.push_back(x.col(c).data());
  return columns;
}

// Supernodes of more than sixteen panels among them, beyond which sums go into double precision.
TEST(Factor, solves_side_by_side_what_it_solves_one_by_one) {
  const Grid g = grid(9, 3);
  for (const Precision precision : {Precision::double_precision, Precision::single_precision})
    for (const int n : {1, 5, 16}) {
      const Factor factor(g.matrix, g.node_of_dof, g.is_interface, "grid", precision);
      const Mat start = Mat::Random(g.matrix.rows(), n);
      const double tolerance = precision == Precision::double_precision ? 1e-14 : 3e-7;
      Mat together = start, alone = start;
      factor.forward_together(columns_of(together));
      for (int c = 0; c < n; ++c) factor.forward(alone.col(c));
      EXPECT_LT((together - alone).norm(), tolerance * alone.norm()) << n;
      together = alone = start;
      factor.backward_together(columns_of(together));
      for (int c = 0; c < n; ++c) factor.backward(alone.col(c));
      EXPECT_LT((together - alone).norm(), tolerance * alone.norm()) << n;
    }
}

TEST(SpdInverse, multiplies_side_by_side_what_it_multiplies_one_by_one) {
  for (const int n : {1, 17, 300}) {
    const Mat random = Mat::Random(n, n);
    const Mat matrix = random * random.transpose() + n * Mat::Identity(n, n);
    for (const auto form : {SpdInverse::Form::matrix, SpdInverse::Form::factor})
      for (const Precision precision : {Precision::double_precision, Precision::single_precision})
        for (const int n_vectors : {2, 16, 21}) {
          const SpdInverse inverse(matrix, form, {precision, 1e-9}, "matrix");
          Mat in = Mat::Random(n, n_vectors), out = Mat::Zero(n, n_vectors), alone = out;
          const std::vector<double*> to = columns_of(out), from = columns_of(in);
          inverse.multiply(std::vector<const double*>(from.begin(), from.end()), to);
          Vec y;
          for (int c = 0; c < n_vectors; ++c) inverse.multiply(in.col(c), y), alone.col(c) = y;
          EXPECT_LT((out - alone).norm(), (precision == Precision::double_precision ? 1e-14 : 3e-7) * alone.norm())
              << n << ", " << n_vectors;
        }
  }
}

TEST(Factor, in_single_precision_stays_linear_and_symmetric) {
  const Grid g = without_interface(7, 3);
  const Factor exact(g.matrix, g.node_of_dof, g.is_interface, "grid");
  const Factor single(g.matrix, g.node_of_dof, g.is_interface, "grid", Precision::single_precision);
  EXPECT_LT(single.bytes(), 0.6 * exact.bytes());
  const Mat inputs = Mat::Random(g.matrix.rows(), 2);
  Mat a = inputs, b = inputs;
  exact.solve(a);
  single.solve(b);
  EXPECT_LT((a - b).norm(), 1e-6 * a.norm());
  EXPECT_GT((a - b).norm(), 0.0);
  EXPECT_NEAR(inputs.col(0).dot(b.col(1)), inputs.col(1).dot(b.col(0)), 1e-13 * inputs.col(0).norm() * b.col(1).norm());
}

TEST(SymmetricOperator, multiplies_as_the_dense_matrix_does) {
  for (const int n : {1, 7, 8, 9, 40, 101}) {
    const Mat random = Mat::Random(n, n);
    const Mat symmetric = random * random.transpose() + n * Mat::Identity(n, n);
    Mat lower = symmetric;
    lower.triangularView<Eigen::StrictlyUpper>().setConstant(1e30);  // must not be read
    const Vec x = Vec::Random(n);
    Vec y;
    SymmetricOperator(lower, Precision::double_precision).multiply(x, y);
    EXPECT_LT((y - symmetric * x).norm(), 1e-14 * n * (symmetric * x).norm()) << n;
    SymmetricOperator(lower, Precision::single_precision).multiply(x, y);
    EXPECT_LT((y - symmetric * x).norm(), 1e-6 * (symmetric * x).norm()) << n;
  }
}

// Entries that fall off away from the diagonal, as those of an interface operator do.
TEST(SpdInverse, has_a_rough_form_of_few_bytes) {
  const int n = 400;
  const double error = 5e-3;
  Mat matrix = Mat::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    matrix(i, i) = 2.5 + 0.001 * i;
    if (i > 0) matrix(i, i - 1) = matrix(i - 1, i) = -1.0;
  }
  const SpdInverse plain(matrix, SpdInverse::Form::matrix, {}, "matrix"),
      both(matrix, SpdInverse::Form::matrix, {.rough_error = error}, "matrix");
  EXPECT_FALSE(plain.has_rough());
  ASSERT_TRUE(both.has_rough());
  EXPECT_LT(both.bytes() - plain.bytes(), 0.1 * plain.bytes());
  const Mat exact = solve_dense(matrix, Mat::Identity(n, n));
  Vec y;
  double worst = 0.0;
  for (int j = 0; j < n; ++j) {
    both.multiply(Vec::Unit(n, j), y);
    EXPECT_LT((y - exact.col(j)).norm(), 1e-12 * exact.col(j).norm());
    both.multiply_roughly(Vec::Unit(n, j), y);
    for (int i = 0; i < n; ++i)
      worst = std::max(worst, std::abs(y[i] - exact(i, j)) / std::sqrt(exact(i, i) * exact(j, j)));
  }
  EXPECT_LE(worst, 1.001 * error);
  EXPECT_GT(worst, 0.01 * error);
  for (const int n_vectors : {2, 16, 21}) {
    Mat in = Mat::Random(n, n_vectors), out = Mat::Zero(n, n_vectors), alone = out;
    const std::vector<double*> to = columns_of(out), from = columns_of(in);
    both.multiply_roughly(std::vector<const double*>(from.begin(), from.end()), to);
    for (int c = 0; c < n_vectors; ++c) both.multiply_roughly(in.col(c), y), alone.col(c) = y;
    EXPECT_LT((out - alone).norm(), 3e-7 * alone.norm()) << n_vectors;
  }
}

TEST(SpdInverse, has_a_form_in_half_precision) {
  const int n = 300;
  const double error = 0x1p-16;
  const Mat random = Mat::Random(n, n), matrix = random * random.transpose() + 50.0 * Mat::Identity(n, n);
  const SpdInverse plain(matrix, SpdInverse::Form::matrix, {Precision::single_precision, 0x1p-30}, "matrix"),
      both(matrix, SpdInverse::Form::matrix,
           {.precision = Precision::single_precision, .error = 0x1p-30, .half_error = error}, "matrix");
  EXPECT_FALSE(plain.has_half());
  ASSERT_TRUE(both.has_half());
  EXPECT_LT(both.bytes() - plain.bytes(), 0.6 * plain.bytes());
  const Mat exact = solve_dense(matrix, Mat::Identity(n, n));
  Vec y;
  double worst = 0.0;
  for (int j = 0; j < n; ++j) {
    both.multiply_in_half(Vec::Unit(n, j), y);
    for (int i = 0; i < n; ++i)
      worst = std::max(worst, std::abs(y[i] - exact(i, j)) / std::sqrt(exact(i, i) * exact(j, j)));
  }
  EXPECT_LE(worst, 1.01 * error);
  EXPECT_GT(worst, 0.01 * error);
}

TEST(SpdInverse, is_the_same_as_a_matrix_and_by_substitution) {
  for (const int n : {1, 7, 8, 17, 40, 101}) {
    const Mat random = Mat::Random(n, n);
    const Mat symmetric = random * random.transpose() + Mat::Identity(n, n);
    Mat lower = symmetric;
    lower.triangularView<Eigen::StrictlyUpper>().setConstant(1e30);  // must not be read
    const Mat exact = solve_dense(symmetric, Mat::Identity(n, n));
    const Vec x = Vec::Random(n);
    const Mat columns = Mat::Random(n, 3);
    for (const auto form : {SpdInverse::Form::matrix, SpdInverse::Form::factor}) {
      const SpdInverse inverse(lower, form, {}, "matrix");
      Vec y;
      inverse.multiply(x, y);
      EXPECT_LT((y - exact * x).norm(), 1e-12 * (exact * x).norm()) << n;
      EXPECT_LT((inverse.times(columns) - exact * columns).norm(), 1e-12 * (exact * columns).norm()) << n;
      Mat whole = inverse.lower();
      mirror_lower(whole);
      EXPECT_LT((whole - exact).norm(), 1e-12 * exact.norm()) << n;
    }
    lower(n / 2, n / 2) = -1.0;
    EXPECT_THROW(SpdInverse(lower, SpdInverse::Form::factor, {}, "matrix"), NumericalError);
  }
}

// Sizes beside those of blocks; large enough to be shared among threads.
TEST(DenseBlocks, give_the_same_bits_on_any_number_of_threads_and_what_dense_algebra_does) {
  const int threads = thread_limit();
  for (const int n : {191, 192, 193, 500}) {
    const Mat random = Mat::Random(n, n);
    const Mat spd = random * random.transpose() + Mat::Identity(n, n);
    const int n_columns = 2 * n / 3, n_below = n - n_columns;
    std::vector<Mat> results;
    for (const int n_threads : {1, 3}) {
      set_thread_limit(n_threads);
      Mat a = spd;
      ASSERT_EQ(factorise_columns(n, n_columns, a.data(), n), -1);
      subtract_square(n_below, n_columns, a.data() + n_columns, n, 1.0, &a(n_columns, n_columns), n);
      ASSERT_EQ(factorise_columns(n_below, n_below, &a(n_columns, n_columns), n), -1);
      results.push_back(a.triangularView<Eigen::Lower>());
      const Mat l = results.back();
      EXPECT_LT((l * l.transpose() - spd).norm(), 1e-13 * spd.norm()) << n;
      invert_factor(a);
      results.push_back(a.triangularView<Eigen::Lower>());
      mirror_lower(a);
      EXPECT_LT((a * spd - Mat::Identity(n, n)).norm(), 1e-8) << n;
      EXPECT_EQ(factorise_columns(n, n,
                                  Mat(Mat::Identity(n, n) -
                                      2.0 * Mat::Identity(n, n).row(n / 2).transpose() * Mat::Identity(n, n).row(n / 2))
                                      .data(),
                                  n),
                n / 2);
    }
    EXPECT_EQ(results[0], results[2]) << n;
    EXPECT_EQ(results[1], results[3]) << n;
  }
  set_thread_limit(threads);
}

TEST(SpdInverse, is_a_matrix_where_many_products_pay_for_it) {
  EXPECT_EQ(SpdInverse::cheapest(3500, 80.0), SpdInverse::Form::factor);
  EXPECT_EQ(SpdInverse::cheapest(3500, 1000.0), SpdInverse::Form::matrix);
  // Of two increments of 40 iterations (manual, H in a static step): from some 1300 unknowns on.
  EXPECT_EQ(SpdInverse::cheapest(1250, 80.0), SpdInverse::Form::matrix);
  EXPECT_EQ(SpdInverse::cheapest(1350, 80.0), SpdInverse::Form::factor);
}

TEST(Factor, has_the_schur_complement_of_the_matrix) {
  const Grid g = grid(5, 3);
  Factor factor(g.matrix, g.node_of_dof, g.is_interface, "grid");
  const int n_i = factor.n_interior(), n_b = factor.n_interface();
  const Mat dense = g.matrix;
  Mat a(dense.rows(), dense.cols());
  for (int i = 0; i < a.rows(); ++i)
    for (int j = 0; j < a.cols(); ++j) a(i, j) = dense(factor.order()[i], factor.order()[j]);
  const Mat schur = a.bottomRightCorner(n_b, n_b) -
                    a.bottomLeftCorner(n_b, n_i) * solve_dense(a.topLeftCorner(n_i, n_i), a.topRightCorner(n_i, n_b));
  EXPECT_LT((factor.take_schur() - schur).norm(), 1e-11 * schur.norm());
}

TEST(Factor, works_without_interface_and_with_nothing_else) {
  Grid g = grid(4, 3);
  g.is_interface.assign(g.is_interface.size(), 0);
  Factor none(g.matrix, g.node_of_dof, g.is_interface, "grid");
  EXPECT_EQ(none.take_schur().size(), 0);
  g.is_interface.assign(g.is_interface.size(), 1);
  Factor all(g.matrix, g.node_of_dof, g.is_interface, "grid");
  EXPECT_EQ(all.n_interior(), 0);
  const Mat schur = all.take_schur();
  for (int i = 0; i < all.size(); ++i)
    for (int j = 0; j < all.size(); ++j) EXPECT_EQ(schur(i, j), g.matrix.coeff(all.order()[i], all.order()[j]));
  EXPECT_EQ(all.nonzeros(), 0.0);
}

TEST(Factor, predicts_the_entries_it_then_has) {
  const Grid g = grid(7, 3);
  Factor factor(g.matrix, g.node_of_dof, g.is_interface, "grid");
  factor.take_schur();
  const double predicted = Factor::predicted_bytes(g.matrix, g.node_of_dof, g.is_interface);
  EXPECT_NEAR(predicted, factor.bytes(), 0.05 * factor.bytes());
}

TEST(Factor, names_what_is_not_positive_definite) {
  Grid g = grid(4, 3);
  g.matrix.coeffRef(5, 5) = -1e6;
  try {
    const Factor factor(g.matrix, g.node_of_dof, g.is_interface, "substructure 'rod' in step 'shock'");
    FAIL();
  } catch (const NumericalError& error) {
    EXPECT_NE(std::string(error.what()).find("substructure 'rod' in step 'shock': the matrix is not positive definite"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace dygita
