// Sums over the interfaces, piece by piece.
#include <gtest/gtest.h>

#include <cmath>

#include "ranks/thread_ranks.hpp"
#include "step/blocks.hpp"
#include "step/interface_sums.hpp"

namespace dygita {
namespace {

Problem rubbing_cubes() {
  Problem problem = two_cubes(contact(0.3), {}, 2);
  problem.solver.integration = IntegrationChoice::implicitly;
  problem.steps = {dynamic_step("test", 1, 0.5e-6, {})};
  return problem;
}

// Numbers of which the order of a sum is felt in the last bits.
Vec unlike_numbers(Eigen::Index n) {
  Vec values(n);
  for (Eigen::Index i = 0; i < n; ++i) values[i] = std::sin(1.7 * static_cast<double>(i) + 0.3) * std::pow(10.0, i % 7);
  return values;
}

TEST(InterfaceSums, of_each_piece_are_made_alone_and_added_in_their_order) {
  const Modelled of(rubbing_cubes());
  const int n = of.model.n_q(), first = of.model.offset[1];
  ASSERT_GT(first, 0);
  ASSERT_LT(first, n);
  const Vec a = unlike_numbers(n), b = a.reverse();
  InterfaceSums sums(of.model);
  const std::vector<double> found = sums.add(2, [&](Eigen::Index at, Eigen::Index size, double* to) {
    to[0] += a.segment(at, size).dot(b.segment(at, size));
    to[1] += a.segment(at, size).squaredNorm();
  });
  ASSERT_EQ(found.size(), 2);
  EXPECT_EQ(found[0], a.head(first).dot(b.head(first)) + a.tail(n - first).dot(b.tail(n - first)));
  EXPECT_EQ(found[1], a.head(first).squaredNorm() + a.tail(n - first).squaredNorm());
}

// A row of cubes, a piece each, in turn to three ranks: all have the same bits, and those of one process.
TEST(InterfaceSums, have_the_bits_of_one_process_on_several_ranks) {
  Problem problem = rubbing_cubes();
  const auto found = [&](const StepModel& model) {
    Vec field = unlike_numbers(model.n_q());
    field = model.near.part(field);
    InterfaceSums sums(model);
    return sums.add(
        1, [&](Eigen::Index at, Eigen::Index n, double* to) { to[0] += field.segment(at, n).squaredNorm(); })[0];
  };
  const double expected = found(Modelled(problem).model);
  ranks::run_as_ranks(2, [&] {
    const Modelled here(problem);
    EXPECT_FALSE(here.model.near.is_all());
    EXPECT_EQ(found(here.model), expected);
  });
}

TEST(InterfaceSums, of_a_window_take_the_fields_of_a_piece_together) {
  const Modelled of(rubbing_cubes());
  const int n = of.model.n_q(), first = of.model.offset[1];
  const Vec a = unlike_numbers(2 * n);
  InterfaceSums sums(of.model, 2);
  const double found = sums.add(
      1, [&](Eigen::Index at, Eigen::Index size, double* to) { to[0] += a.segment(at, size).squaredNorm(); })[0];
  const auto share = [&](int begin, int size) {
    return a.segment(begin, size).squaredNorm() + a.segment(n + begin, size).squaredNorm();
  };
  EXPECT_EQ(found, share(0, first) + share(first, n - first));
}

TEST(NearUnknowns, of_one_process_are_all_in_the_assembled_order) {
  const Modelled of(rubbing_cubes());
  const NearUnknowns& near = of.model.near;
  EXPECT_TRUE(near.is_all());
  EXPECT_EQ(near.n(), of.model.n_q());
  EXPECT_EQ(near.n_own(), of.model.n_q());
  EXPECT_EQ(near.points().size(), of.model.exchange.points.size());
  EXPECT_EQ(near.start(1), of.model.offset[1]);
  const Vec field = unlike_numbers(near.n());
  EXPECT_EQ(near.part(field), field);
  EXPECT_EQ(near.assembled(field), field);
  EXPECT_EQ(near.kept_part(field), field);
  EXPECT_TRUE(near.kept_runs().is_whole());
}

}  // namespace
}  // namespace dygita
