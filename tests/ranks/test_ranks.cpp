// What ranks make of messages, on threads of one process.
#include <gtest/gtest.h>

#include <numeric>

#include "ranks/neighbours.hpp"
#include "ranks/ranks.hpp"
#include "ranks/thread_ranks.hpp"

namespace dygita::ranks {
namespace {

constexpr int n_ranks = 3;
constexpr double not_here = -1.0;

// A value that says whose it is and which.
double value_of(int owner, int i) { return 100.0 * owner + i; }

TEST(Ranks, share_what_rank_0_has) {
  run_as_ranks(n_ranks, [] {
    EXPECT_EQ(count(), n_ranks);
    EXPECT_EQ(shared(is_first() ? std::string("the deck") : std::string("nothing")), "the deck");
    EXPECT_EQ(shared(is_first() ? std::vector<double>{1.5, 2.5} : std::vector<double>{}),
              (std::vector<double>{1.5, 2.5}));
    EXPECT_EQ(shared(std::string()), "");
  });
}

TEST(Ranks, gather_texts_on_rank_0_and_numbers_everywhere) {
  run_as_ranks(n_ranks, [] {
    const auto m = static_cast<size_t>(me());
    const std::vector<std::string> texts = gathered(std::string(m, 'a'));
    EXPECT_EQ(texts, is_first() ? (std::vector<std::string>{"", "a", "aa"}) : std::vector<std::string>());
    const std::vector<std::vector<double>> numbers = of_all(std::vector<double>(2 - m, me()));
    EXPECT_EQ(numbers, (std::vector<std::vector<double>>{{0.0, 0.0}, {1.0}, {}}));
  });
}

TEST(Ranks, swap_what_each_has_for_each) {
  run_as_ranks(n_ranks, [] {
    std::vector<std::vector<int>> to_each;
    for (int to = 0; to < n_ranks; ++to) to_each.emplace_back(static_cast<size_t>(to), 10 * me() + to);
    const std::vector<std::vector<int>> from_each = swapped(to_each);
    ASSERT_EQ(from_each.size(), static_cast<size_t>(n_ranks));
    for (int from = 0; from < n_ranks; ++from)
      EXPECT_EQ(from_each[static_cast<size_t>(from)], std::vector<int>(static_cast<size_t>(me()), 10 * from + me()));
  });
}

TEST(Ranks, agree_on_the_largest_and_on_sums) {
  run_as_ranks(n_ranks, [] {
    EXPECT_EQ(largest(-1.0 - me()), -1.0);
    EXPECT_TRUE(any(me() == 2));
    EXPECT_FALSE(any(false));
    EXPECT_EQ(sums({1.0, static_cast<double>(me())}), (std::vector<double>{3.0, 3.0}));
    LaterLargest later;
    later.begin(me());
    EXPECT_TRUE(later.is_begun());
    EXPECT_EQ(largest(5.0 + me()), 7.0) << "another call between the two halves";
    EXPECT_EQ(later.end(), 2.0);
    EXPECT_FALSE(later.is_begun());
  });
}

// Pieces of unlike sizes, the owners in no order, one rank without any.
TEST(Segments, complete_every_rank_and_bring_to_the_first) {
  const std::vector<int> owner{2, 0, 2, 0, 2}, offset{0, 3, 4, 4, 9, 11};
  for (const int width : {1, 3})
    run_as_ranks(n_ranks, [&] {
      const Segments segments(owner, offset);
      const int n = offset.back() * width;
      std::vector<double> values(static_cast<size_t>(n), not_here), expected(static_cast<size_t>(n));
      for (size_t piece = 0; piece < owner.size(); ++piece)
        for (int i = width * offset[piece]; i < width * offset[piece + 1]; ++i) {
          expected[static_cast<size_t>(i)] = value_of(owner[piece], i);
          if (owner[piece] == me()) values[static_cast<size_t>(i)] = value_of(owner[piece], i);
        }
      std::vector<double> on_first = values;
      segments.complete(values.data(), width);
      EXPECT_EQ(values, expected);
      if (width != 1) return;
      const std::vector<double> before = on_first;
      segments.bring(on_first.data());
      EXPECT_EQ(on_first, is_first() ? expected : before);
    });
}

// Four values: of rank 0 read by 1 and 2, of 1 read by 0, of 2 read by itself, of 1 read by nobody.
class Passing : public testing::Test {
 protected:
  const std::vector<int> owner{0, 1, 2, 1};
  const std::vector<std::vector<int>> readers{{0, 1, 2}, {0, 1}, {2}, {}};

  bool has(int i) const {
    const std::vector<int>& who = readers[static_cast<size_t>(i)];
    return owner[static_cast<size_t>(i)] == me() || std::find(who.begin(), who.end(), me()) != who.end();
  }
  std::vector<double> own(int width, double more = 0.0) const {
    std::vector<double> values;
    for (int i = 0; i < 4; ++i)
      for (int w = 0; w < width; ++w)
        values.push_back(owner[static_cast<size_t>(i)] == me() ? value_of(me(), 10 * i + w) + more : not_here);
    return values;
  }
  std::vector<double> expected(int width, double more = 0.0) const {
    std::vector<double> values;
    for (int i = 0; i < 4; ++i)
      for (int w = 0; w < width; ++w)
        values.push_back(has(i) ? value_of(owner[static_cast<size_t>(i)], 10 * i + w) + more : not_here);
    return values;
  }
};

TEST_F(Passing, gives_values_to_those_who_read_them_and_to_nobody_else) {
  for (const int width : {1, 3})
    run_as_ranks(n_ranks, [&] {
      const Neighbours neighbours(owner, readers, width);
      std::vector<double> values = own(width);
      neighbours.exchange(values.data());
      EXPECT_EQ(values, expected(width));
    });
}

TEST_F(Passing, of_several_fields_goes_in_one_message) {
  run_as_ranks(n_ranks, [&] {
    const Neighbours neighbours(owner, readers, 1);
    std::vector<double> a = own(1), b = own(1, 0.5);
    const double before = traffic().messages[Receivers::neighbours];
    neighbours.exchange({a.data(), b.data()});
    EXPECT_EQ(a, expected(1));
    EXPECT_EQ(b, expected(1, 0.5));
    const double n_sent = traffic().messages[Receivers::neighbours] - before;
    EXPECT_EQ(n_sent, me() == 0 ? 2.0 : me() == 1 ? 1.0 : 0.0);
  });
}

TEST_F(Passing, in_two_halves_sends_what_was_there_at_the_first) {
  run_as_ranks(n_ranks, [&] {
    const Neighbours neighbours(owner, readers, 1);
    std::vector<double> sent = own(1), received(4, not_here);
    neighbours.begin(sent.data());
    sent.assign(4, 7.0);
    EXPECT_EQ(largest(me()), 2.0);
    neighbours.end(received.data());
    for (int i = 0; i < 4; ++i) {
      const bool comes = has(i) && owner[static_cast<size_t>(i)] != me();
      EXPECT_EQ(received[static_cast<size_t>(i)], comes ? value_of(owner[static_cast<size_t>(i)], 10 * i) : not_here);
    }
  });
}

TEST(Ranks, answer_what_the_first_asks_until_it_releases_them) {
  run_as_ranks(n_ranks, [] {
    if (!is_first())
      return answer_until_released([](const Question& question, std::span<const double> with) {
        return std::vector<double>{1.0 * question.what, 1.0 * question.of, with[0] + me()};
      });
    EXPECT_EQ(ask(1, {3, 4}, std::vector<double>{0.5}), (std::vector<double>{3.0, 4.0, 1.5}));
    EXPECT_EQ(ask(2, {5, 6}, std::vector<double>{0.5}), (std::vector<double>{5.0, 6.0, 2.5}));
    release_all();
  });
}

TEST(Ranks, bring_values_of_one_to_the_first) {
  run_as_ranks(n_ranks, [] {
    const std::vector<double> got = to_first(2, {1.0 * me()});
    EXPECT_EQ(got, (std::vector<double>{me() == 0 ? 2.0 : 1.0 * me()}));
  });
}

TEST(Ranks, end_together_with_one_message_whoever_has_failed) {
  for (const int who : {0, 2}) {
    const Ended ended = run_as_ranks(n_ranks, [&] {
      if (me() == who) stop_all("no equilibrium", 3);
      largest(1.0);  // the others wait for it
      ADD_FAILURE() << "rank " << me() << " went on";
    });
    EXPECT_EQ(ended.said, "no equilibrium") << who;
    EXPECT_EQ(ended.code, 3) << who;
  }
}

TEST(Ranks, are_one_where_nobody_has_started_more) {
  EXPECT_EQ(count(), 1);
  EXPECT_TRUE(is_alone());
  EXPECT_EQ(gathered("a"), std::vector<std::string>{"a"});
  EXPECT_EQ(sums({2.0}), std::vector<double>{2.0});
  EXPECT_EQ(largest(-3.0), -3.0);
  std::vector<double> values{1.0, 2.0};
  Segments({0, 0}, {0, 1, 2}).complete(values.data());
  Neighbours({0, 0}, {{0}, {0}}, 1).exchange(values.data());
  EXPECT_EQ(values, (std::vector<double>{1.0, 2.0}));
}

}  // namespace
}  // namespace dygita::ranks
