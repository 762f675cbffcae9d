// Factors of matrices so large that threads share them: the same bits for any number of threads.
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "base/team.hpp"
#include "numerics/factor.hpp"
#include "numerics/repeated_factor.hpp"

namespace dygita {
namespace {

struct Lattice {
  SparseMatrix matrix;
  std::vector<int> node_of_dof;
  std::vector<char> is_interface;

  int size() const { return static_cast<int>(node_of_dof.size()); }
};

// Springs along the edges of an n x n x n lattice, a little more on the diagonal; the plane i = 0 is the interface.
Lattice lattice(int n) {
  Lattice of;
  std::vector<Eigen::Triplet<double>> entries;
  const auto index = [&](int i, int j, int k) { return (i * n + j) * n + k; };
  const auto join = [&](int a, int b, double stiffness) {
    for (const auto& [r, c, sign] : {std::tuple{a, a, 1.0}, {b, b, 1.0}, {a, b, -1.0}, {b, a, -1.0}})
      entries.emplace_back(r, c, sign * stiffness);
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        const int a = index(i, j, k);
        of.node_of_dof.push_back(a);
        of.is_interface.push_back(i == 0);
        entries.emplace_back(a, a, 0.01 + 0.001 * (a % 7));
        if (i + 1 < n) join(a, index(i + 1, j, k), 1.0 + 0.1 * (a % 3));
        if (j + 1 < n) join(a, index(i, j + 1, k), 2.0);
        if (k + 1 < n) join(a, index(i, j, k + 1), 1.5);
      }
  of.matrix.resize(of.size(), of.size());
  of.matrix.setFromTriplets(entries.begin(), entries.end());
  return of;
}

class Threads {
 public:
  ~Threads() { set_thread_limit(before_); }
  void use(int n) { set_thread_limit(n); }

 private:
  const int before_ = thread_limit();
};

constexpr int large = 22;  // 5e8 operations

TEST(Fronts, of_many_threads_have_the_bits_of_one) {
  const Lattice of = lattice(large);
  Threads threads;
  Mat schur;
  Vec forward, backward;
  for (const int n : {1, 2, 5}) {
    threads.use(n);
    Factor factor(of.matrix, of.node_of_dof, of.is_interface, "lattice");
    Mat x = Vec::LinSpaced(of.size(), -1.0, 1.0);
    factor.forward(x);
    const Vec ahead = x;
    factor.backward(x);
    if (n == 1) {
      schur = factor.take_schur(), forward = ahead, backward = x;
      continue;
    }
    EXPECT_EQ(factor.take_schur(), schur);
    EXPECT_EQ(ahead, forward);
    EXPECT_EQ(Vec(x), backward);
  }
}

TEST(Fronts, of_many_threads_tell_the_pivot_that_one_meets_first) {
  Lattice of = lattice(large);
  for (const int at : {4000, 9000}) of.matrix.coeffRef(at, at) = -1.0;
  Threads threads;
  std::string said;
  for (const int n : {1, 3}) {
    threads.use(n);
    try {
      const Factor factor(of.matrix, of.node_of_dof, of.is_interface, "lattice");
      ADD_FAILURE() << "an indefinite matrix was factorised";
    } catch (const NumericalError& error) {
      if (n == 1) said = error.what();
      EXPECT_EQ(error.what(), said);
    }
  }
}

TEST(RepeatedFactor, solves_one_matrix_after_the_other_with_the_same_bits_on_any_number_of_threads) {
  const Lattice of = lattice(large);
  SparseMatrix other = of.matrix;
  for (int i = 0; i < of.size(); i += 5) other.coeffRef(i, i) += 3.0;
  const Mat b = Mat::Random(of.size(), 3);
  Threads threads;
  Mat first, second;
  for (const int n : {1, 2}) {
    threads.use(n);
    RepeatedFactor factor(of.matrix, of.node_of_dof, "lattice");
    ASSERT_TRUE(factor.factorise(of.matrix));
    const Mat x = factor.solve(b);
    EXPECT_LT((of.matrix * x - b).norm(), 1e-12 * b.norm());
    ASSERT_TRUE(factor.factorise(other));
    const Mat y = factor.solve(b);
    EXPECT_LT((other * y - b).norm(), 1e-12 * b.norm());
    ASSERT_TRUE(factor.factorise(of.matrix));
    EXPECT_EQ(factor.solve(b), x) << "nothing stays of the matrix before";
    if (n == 1)
      first = x, second = y;
    else
      EXPECT_TRUE(x == first && y == second);
  }
}

TEST(RepeatedFactor, takes_half_of_a_matrix_that_is_in_its_order_to_the_same_bits) {
  const Lattice of = lattice(large);
  RepeatedFactor factor(of.matrix, of.node_of_dof, "lattice");
  ASSERT_TRUE(factor.factorise(of.matrix));
  const Mat b = Mat::Random(of.size(), 2), x = factor.solve(b);
  std::vector<int> position(of.node_of_dof.size());
  for (int p = 0; p < of.size(); ++p) position[static_cast<size_t>(factor.order()[static_cast<size_t>(p)])] = p;
  std::vector<Eigen::Triplet<double>> upper;
  for (int row = 0; row < of.size(); ++row)
    for (SparseMatrix::InnerIterator e(of.matrix, row); e; ++e)
      if (const int p = position[static_cast<size_t>(row)], q = position[static_cast<size_t>(e.col())]; q >= p)
        upper.emplace_back(p, q, e.value());
  SparseMatrix half(of.size(), of.size());
  half.setFromTriplets(upper.begin(), upper.end());
  ASSERT_TRUE(factor.factorise_in_order(half));
  EXPECT_EQ(factor.solve(b), x);
}

TEST(RepeatedFactor, names_the_unknown_where_a_matrix_is_not_positive_definite) {
  const Lattice of = lattice(large);
  SparseMatrix wrong = of.matrix;
  const int unknown = of.size() / 3;
  wrong.coeffRef(unknown, unknown) = -1e6;
  RepeatedFactor factor(of.matrix, of.node_of_dof, "lattice");
  EXPECT_FALSE(factor.factorise(wrong));
  EXPECT_EQ(factor.not_positive(), unknown);
  EXPECT_TRUE(factor.factorise(of.matrix));
  EXPECT_EQ(factor.not_positive(), -1);
}

// All of a dense matrix is one front.
TEST(RepeatedFactor, knows_the_memory_that_it_works_in) {
  constexpr int n = 30;
  std::vector<int> nodes;
  std::vector<Eigen::Triplet<double>> all;
  for (int i = 0; i < n; ++i) {
    nodes.push_back(i);
    for (int j = 0; j < n; ++j) all.emplace_back(i, j, i == j ? n : -0.5);
  }
  SparseMatrix dense(n, n);
  dense.setFromTriplets(all.begin(), all.end());
  EXPECT_EQ(RepeatedFactor(dense, nodes, "dense").bytes_at_work(), 8.0 * n * n);
  const Lattice of = lattice(large);
  const RepeatedFactor factor(of.matrix, of.node_of_dof, "lattice");
  constexpr double separator = large * large;  // the last front has about as many unknowns
  EXPECT_GT(factor.bytes_at_work(), 8.0 * separator * separator / 2.0);
  EXPECT_LT(factor.bytes_at_work(), factor.bytes());
}

TEST(RepeatedFactor, answers_where_it_is_asked_through_what_lies_between_alone) {
  const Lattice of = lattice(large);
  RepeatedFactor factor(of.matrix, of.node_of_dof, "lattice");
  ASSERT_TRUE(factor.factorise(of.matrix));
  const std::vector<int> asked = {0, 1, 2, of.size() / 2, of.size() - 1};
  const std::vector<char> reach = factor.reach_of(asked);
  const auto n_reached = std::count(reach.begin(), reach.end(), 1);
  EXPECT_GT(n_reached, 0);
  EXPECT_LT(n_reached, static_cast<long>(reach.size()) / 2);
  Vec b = Vec::Zero(of.size());
  for (const int i : asked) b[i] = 1.0 + i;
  const Vec whole = factor.solve(b), part = factor.solve(b, reach);
  for (const int i : asked) EXPECT_EQ(part[i], whole[i]) << i;
}

TEST(RepeatedFactor, tells_how_far_it_is_and_ends_where_the_watcher_throws) {
  const Lattice of = lattice(large);
  for (const int n : {1, 2}) {
    Threads threads;
    threads.use(n);
    RepeatedFactor factor(of.matrix, of.node_of_dof, "lattice");
    std::vector<double> told;
    ASSERT_TRUE(factor.factorise(of.matrix, [&](double share) { told.push_back(share); }));
    ASSERT_GT(told.size(), 10U);
    EXPECT_LT(told.front(), 0.1);
    EXPECT_GT(told.back(), 0.5);
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    EXPECT_LE(told.back(), 1.0);
    size_t n_heard = 0;
    const auto stop = [&](double) {
      if (++n_heard == told.size() / 2) throw std::runtime_error("stopped");
    };
    EXPECT_THROW(factor.factorise(of.matrix, stop), std::runtime_error);
    EXPECT_LT(n_heard, told.size());
    ASSERT_TRUE(factor.factorise(of.matrix)) << "and serves again";
    const Vec b = Vec::Ones(of.size());
    EXPECT_LT((of.matrix * Vec(factor.solve(b)) - b).norm(), 1e-12 * b.norm());
  }
}

TEST(RepeatedFactor, says_that_a_matrix_is_not_positive_definite_and_takes_the_next_one) {
  const Lattice of = lattice(6);
  SparseMatrix broken = of.matrix;
  broken.coeffRef(7, 7) = -1.0;
  RepeatedFactor factor(of.matrix, of.node_of_dof, "lattice");
  EXPECT_FALSE(factor.factorise(broken));
  ASSERT_TRUE(factor.factorise(of.matrix));
  const Vec b = Vec::Ones(of.size());
  EXPECT_LT((of.matrix * Vec(factor.solve(b)) - b).norm(), 1e-12 * b.norm());
}

}  // namespace
}  // namespace dygita
