// Anderson's acceleration against the textbook: a QR of the differences at each iteration.

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <limits>

#include "base/team.hpp"
#include "latin/anderson.hpp"

namespace dygita {
namespace {

double pseudo_random(int i) { return std::fmod(std::abs(std::sin(12.9898 * i + 78.233)) * 43758.5453, 1.0) - 0.5; }

Vec random_vector(int n, int seed) {
  Vec v(n);
  for (int i = 0; i < n; ++i) v[i] = pseudo_random(1000 * seed + i);
  return v;
}

// G(q) = A q + b, a contraction.
struct LinearProblem {
  Mat a;
  Vec b;
  explicit LinearProblem(int n, double radius = 0.9) : a(n, n), b(random_vector(n, 1)) {
    for (int j = 0; j < n; ++j) a.col(j) = random_vector(n, j + 2);
    a *= radius / a.norm();
    for (int j = 0; j < n; ++j) a(j, j) += radius * (j % 2 ? 0.7 : -0.7) * j / n;
  }
  Vec image(const Vec& q) const { return a * q + b; }
  Vec solution() const { return (Mat::Identity(b.size(), b.size()) - a).colPivHouseholderQr().solve(b); }
};

// The same with a QR, as in Walker and Ni.
void textbook_step(std::vector<Vec>& dq, std::vector<Vec>& df, Vec& q, const Vec& residual, const Vec& weight,
                   double relaxation) {
  Mat f(q.size(), df.size());
  for (size_t j = 0; j < df.size(); ++j) f.col(j) = df[j];
  const Vec weighted = residual.cwiseProduct(weight);
  Vec step = relaxation * residual;
  if (!df.empty()) {
    const Vec gamma = f.colPivHouseholderQr().solve(weighted);
    for (size_t j = 0; j < df.size(); ++j) step -= gamma[j] * (dq[j] + relaxation * df[j].cwiseQuotient(weight));
  }
  q += step;
}

TEST(Differences, take_off_what_a_qr_takes_off) {
  const int n = 60, m = 8;
  Differences differences(m, n);
  Mat df(n, m), dq(n, m);
  const Vec zero = Vec::Zero(n);
  for (int j = 0; j < m + 3; ++j) {  // more than there is room for: the oldest three go
    const Vec f = std::pow(10.0, -j) * random_vector(n, 10 + j), q = std::pow(10.0, -j) * random_vector(n, 50 + j);
    differences.add(q, zero, f, zero);
    if (j >= 3) {
      df.col(j - 3) = f;
      dq.col(j - 3) = q;
    }
  }
  const Vec residual = random_vector(n, 99);
  const Vec gamma = df.colPivHouseholderQr().solve(residual);
  Vec q = zero, rest = residual;
  differences.project(rest);
  differences.take_off(q, rest);
  EXPECT_LT((rest - (residual - df * gamma)).norm(), 1e-12 * residual.norm());
  EXPECT_LT((q + dq * gamma).norm(), 1e-10 * (dq * gamma).norm());
}

TEST(Differences, dependent_ones_are_left_out) {
  const int n = 30;
  Differences differences(6, n);
  const Vec zero = Vec::Zero(n), f = random_vector(n, 1), g = random_vector(n, 2);
  differences.add(f, zero, f, zero);
  differences.add(g, zero, g, zero);
  differences.add(f + g, zero, f + g, zero);                       // depends on the others
  differences.add(f, zero, f + 1e-9 * random_vector(n, 3), zero);  // almost the first
  differences.add(f, zero, zero, zero);                            // no difference at all
  Vec q = zero, residual = 3.0 * f - 2.0 * g;
  differences.project(residual);
  differences.take_off(q, residual);
  EXPECT_TRUE(q.allFinite());
  EXPECT_LT(residual.norm(), 1e-7);
  EXPECT_LT((q + 3.0 * f - 2.0 * g).norm(), 1e-6);
}

TEST(Anderson, iterates_are_those_of_a_qr) {
  const int n = 40, depth = 5;
  const LinearProblem problem(n);
  Vec weight(n);
  for (int i = 0; i < n; ++i) weight[i] = 1.0 + 0.5 * std::cos(i);
  Anderson anderson(depth, 0, 0.9, weight);
  anderson.begin();
  Vec q = Vec::Zero(n), expected = q, before, residual_before;
  std::vector<Vec> dq, df;
  for (int iteration = 0; iteration < 12; ++iteration) {
    const Vec residual = problem.image(expected) - expected;
    if (iteration > 0) {
      dq.push_back(expected - before);
      df.push_back((residual - residual_before).cwiseProduct(weight));
      if (static_cast<int>(dq.size()) > depth) {
        dq.erase(dq.begin());
        df.erase(df.begin());
      }
    }
    before = expected;
    residual_before = residual;
    textbook_step(dq, df, expected, residual, weight, 0.9);
    anderson.advance(q, problem.image(q));
    EXPECT_LT((q - expected).norm(), 1e-9 * expected.norm()) << iteration;
  }
}

TEST(Anderson, solves_a_linear_problem_in_as_many_steps_as_it_has_unknowns) {
  const int n = 12;
  const LinearProblem problem(n);
  Anderson anderson(20, 0, 0.8, Vec::Ones(n));
  anderson.begin();
  Vec q = Vec::Zero(n);
  for (int i = 0; i < n + 1; ++i) anderson.advance(q, problem.image(q));
  EXPECT_LT((q - problem.solution()).norm(), 1e-6 * q.norm());
}

// Loads of three shapes: once three problems are solved, the fourth is predicted but for the first evaluation.
TEST(Anderson, past_problems_predict_the_next) {
  const int n = 30;
  LinearProblem problem(n);
  const Mat shapes = (Mat(n, 3) << random_vector(n, 5), random_vector(n, 6), random_vector(n, 7)).finished();
  Anderson with(10, 20, 0.95, Vec::Ones(n)), without(10, 0, 0.95, Vec::Ones(n));
  Vec q = Vec::Zero(n), q_without = q;
  int n_with = 0, n_without = 0;
  for (int k = 1; k <= 8; ++k) {
    problem.b = shapes * Vec3(std::sin(k), std::cos(2.0 * k), k);
    const auto iterate = [&](Anderson& anderson, Vec& at) {
      anderson.begin();
      int count = 1;
      for (; (problem.image(at) - at).norm() > 1e-10 * problem.b.norm(); ++count)
        anderson.advance(at, problem.image(at));
      anderson.end(at, problem.image(at), true);
      return count;
    };
    n_with = iterate(with, q);
    n_without = iterate(without, q_without);
  }
  EXPECT_LE(n_with, 3);
  EXPECT_GE(n_without, 8);
}

// Fields long enough to be shared out among threads.
TEST(Anderson, iterates_to_the_same_bits_on_any_number_of_threads) {
  const int n = 9000;
  const Vec slope = 0.9 * random_vector(n, 3), start = random_vector(n, 4), weight = Vec::Constant(n, 0.3);
  const int before = thread_limit();
  const auto iterated_on = [&](int threads) {
    set_thread_limit(threads);
    Anderson anderson(5, 3, 0.9, weight);
    Vec q = Vec::Zero(n);
    for (int problem = 1; problem < 4; ++problem) {
      anderson.begin();
      const auto image = [&] { return Vec(slope.cwiseProduct(q) + problem * start); };
      for (int i = 0; i < 9; ++i) anderson.advance(q, image());
      anderson.end(q, image(), true);
    }
    return q;
  };
  const Vec on_one = iterated_on(1), on_three = iterated_on(3);
  set_thread_limit(before);
  EXPECT_TRUE((on_one.array() == on_three.array()).all());
  EXPECT_LT((slope.cwiseProduct(on_one) + 3.0 * start - on_one).norm(), 1e-2 * on_one.norm());
}

TEST(Anderson, depth_zero_is_relaxation) {
  const LinearProblem problem(10);
  Anderson anderson(0, 20, 0.7, Vec::Ones(10));
  anderson.begin();
  Vec q = Vec::Zero(10), expected = q;
  for (int i = 0; i < 5; ++i) {
    expected += 0.7 * (problem.image(expected) - expected);
    anderson.advance(q, problem.image(q));
  }
  anderson.end(q, problem.image(q), true);
  EXPECT_LE((q - expected).norm(), 4 * std::numeric_limits<double>::epsilon() * expected.norm());
}

}  // namespace
}  // namespace dygita
