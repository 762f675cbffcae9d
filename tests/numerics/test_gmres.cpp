// Generalised minimal residuals against elimination.
#include <gtest/gtest.h>

#include "numerics/dense.hpp"
#include "numerics/gmres.hpp"

namespace dygita::test {
namespace {

constexpr int n_rows = 40;

Mat unlike(unsigned seed) {
  std::srand(seed);
  return Mat::Random(n_rows, n_rows);
}

TEST(Gmres, solves_what_elimination_solves) {
  const Mat a = unlike(1) + 8.0 * Mat(Mat::Identity(n_rows, n_rows));
  const Vec b = unlike(2).col(0);
  const auto x = gmres({[&](const Vec& v) { return Vec(a * v); }, [](const Vec& v) { return v; }}, b, 1e-12, n_rows);
  ASSERT_TRUE(x);
  EXPECT_LT((*x - solve_dense(a, b)).norm(), 1e-10 * x->norm());
}

// A preconditioner that is off in a few rows leaves as many directions.
TEST(Gmres, takes_as_many_products_as_rows_have_changed) {
  const Mat a = unlike(1) + 8.0 * Mat(Mat::Identity(n_rows, n_rows));
  const Vec b = unlike(2).col(0);
  Mat before = a;
  before.row(3).setZero();
  before.row(17).setZero();
  before(3, 3) = before(17, 17) = 1.0;
  const LuFactor factor(before);
  int products = 0;
  const GmresSystem system{[&](const Vec& v) {
                             ++products;
                             return Vec(a * v);
                           },
                           [&](const Vec& v) { return factor.solve(v); }};
  const auto x = gmres(system, b, 1e-10, n_rows);
  ASSERT_TRUE(x);
  EXPECT_LE(products, 3);
  EXPECT_LT((a * *x - b).norm(), 1e-9 * b.norm());
  EXPECT_FALSE(gmres(system, b, 1e-10, 2));
}

TEST(Gmres, of_nothing_is_nothing) {
  const auto x =
      gmres({[](const Vec& v) { return v; }, [](const Vec& v) { return v; }}, Vec::Zero(n_rows), 1e-12, n_rows);
  ASSERT_TRUE(x);
  EXPECT_EQ(x->norm(), 0.0);
}

}  // namespace
}  // namespace dygita::test
