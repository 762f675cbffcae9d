#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "persistence/checkpoint_file.hpp"

namespace dygita::checkpoint_file_tests {
namespace {

namespace fs = std::filesystem;

class CheckpointLinks : public testing::Test {
 protected:
  fs::path folder_ = fs::path(testing::TempDir()) /
                     testing::UnitTest::GetInstance()->current_test_info()->test_suite_name() /
                     testing::UnitTest::GetInstance()->current_test_info()->name();
  fs::path path_ = folder_ / checkpoint_file_name, others_ = folder_ / "others";

  CheckpointLinks() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    std::ofstream(others_) << "precious";
  }
  ~CheckpointLinks() override { fs::remove_all(folder_); }
};

TEST_F(CheckpointLinks, in_the_way_of_a_new_one_are_replaced) {
  fs::create_symlink(others_, path_);
  fs::create_symlink(others_, path_.string() + ".tmp");
  { const CheckpointFile checkpoint(path_, CheckpointIdentity{}, 60.0); }
  EXPECT_FALSE(fs::is_symlink(path_));
  EXPECT_EQ(fs::file_size(others_), 8u);
  EXPECT_FALSE(CheckpointFile(path_, 60.0).has_entries());
}

// It would be written to as the run goes on.
TEST_F(CheckpointLinks, in_the_place_of_one_are_refused) {
  { const CheckpointFile checkpoint(others_, CheckpointIdentity{}, 60.0); }
  const auto size = fs::file_size(others_);
  fs::create_symlink(others_, path_);
  try {
    const CheckpointFile checkpoint(path_, 60.0);
    FAIL() << "opened";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("is a link, and not a checkpoint of dygita"), std::string::npos);
  }
  EXPECT_EQ(fs::file_size(others_), size);
}

// As a backup by hard links has it.
TEST_F(CheckpointLinks, of_another_name_leave_that_as_it_is) {
  { const CheckpointFile checkpoint(path_, CheckpointIdentity{}, 60.0); }
  const fs::path backup = folder_ / "backup";
  fs::create_hard_link(path_, backup);
  const auto size = fs::file_size(backup);
  {
    CheckpointFile checkpoint(path_, 60.0);
    TrailEntry entry;
    entry.q = entry.uncorrected = Vec::Ones(7);
    entry.moved = {1, 0};
    checkpoint.leave(entry);
    checkpoint.sync();
  }
  EXPECT_EQ(fs::file_size(backup), size);
  EXPECT_TRUE(CheckpointFile(path_, 60.0).has_entries());
}

// Three ranks of seven unknowns and four pieces: what each leaves of an increment.
class CheckpointInParts : public CheckpointLinks {
 protected:
  static constexpr double every = 60.0;
  std::vector<AssembledRuns> runs_{{7, {{1, 2}, {5, 1}}}, {7, {{0, 1}, {6, 1}}}, {7, {{3, 2}}}};

  static TrailEntry whole(double value) {
    TrailEntry entry;
    entry.q = value * Vec::LinSpaced(7, 1.0, 7.0);
    entry.uncorrected = -entry.q;
    entry.moved = {1, 0, 1, 1};
    entry.iterations = 3;
    return entry;
  }
  TrailEntry share(double value, size_t rank) const {
    TrailEntry entry = whole(value);
    const auto own = [&](const Vec& all) {
      Vec kept(0);
      for (const AssembledRuns::Run& run : runs_[rank].runs) {
        kept.conservativeResize(kept.size() + run.n);
        kept.tail(run.n) = all.segment(run.first, run.n);
      }
      return kept;
    };
    entry.q = own(entry.q);
    entry.uncorrected = own(entry.uncorrected);
    for (size_t i = 0; i < 4; ++i) entry.moved[i] = i % 3 == rank ? entry.moved[i] : 0;
    entry.runs = runs_[rank];
    return entry;
  }
  void leave(int n_entries) {
    CheckpointFile first(path_, CheckpointIdentity{}, every);
    CheckpointPart second(path_, 1, first.head(), every), third(path_, 2, first.head(), every);
    for (int i = 0; i < n_entries; ++i) {
      first.leave(share(i + 1, 0));
      second.leave(share(i + 1, 1));
      third.leave(share(i + 1, 2));
    }
  }
  static void expect_whole(CheckpointFile& file, double value) {
    const TrailEntry entry = file.take(), expected = whole(value);
    EXPECT_EQ(entry.q, expected.q);
    EXPECT_EQ(entry.uncorrected, expected.uncorrected);
    EXPECT_EQ(entry.moved, expected.moved);
    EXPECT_TRUE(entry.runs.is_whole());
  }
};

TEST_F(CheckpointInParts, is_read_as_one_whatever_goes_on_with_it) {
  leave(3);
  CheckpointFile file(path_, every);
  ASSERT_EQ(file.n_left(), 3);
  for (int i = 0; i < 3; ++i) expect_whole(file, i + 1);
  // One process goes on.
  EXPECT_FALSE(file.leads(1));
  file.leave(whole(4));
  file.sync();
  CheckpointFile again(path_, every);
  ASSERT_EQ(again.n_left(), 4);
  for (int i = 0; i < 4; ++i) expect_whole(again, i + 1);
}

// Wherever a rank was killed, entries count up to the last that all have; two ranks go on from there.
TEST_F(CheckpointInParts, counts_up_to_where_all_ranks_have_left_theirs) {
  leave(3);
  const fs::path part = parts_folder(path_) / "2";
  const auto size = fs::file_size(part);
  const auto of_entry = (size - 16) / 3;
  for (auto kept = size - 1; kept > size - 2 * of_entry; kept -= 7) {
    leave(3);
    fs::resize_file(part, kept);
    CheckpointFile file(path_, every);
    const long n = kept >= size - of_entry ? 2 : 1;
    ASSERT_EQ(file.n_left(), n) << kept << " of " << size;
    CheckpointPart other(path_, 1, file.head(), every);
    for (long i = 0; i < n; ++i) {
      expect_whole(file, static_cast<double>(i + 1));
      other.take();
    }
    EXPECT_FALSE(file.leads(1));
    // Shared out anew: the second has what the third had.
    TrailEntry first = share(9, 0), second = share(9, 1);
    second.runs = {7, {{0, 1}, {3, 2}, {6, 1}}};
    second.q = whole(9).q({0, 3, 4, 6});
    second.uncorrected = -second.q;
    second.moved = {0, 0, 1, 0};
    first.moved = {1, 0, 0, 1};
    file.leave(first);
    other.leave(second);
  }
  CheckpointFile again(path_, every);
  ASSERT_EQ(again.n_left(), 2);
  expect_whole(again, 1);
  expect_whole(again, 9);
}

TEST_F(CheckpointInParts, takes_none_of_another_run) {
  leave(3);
  fs::copy(parts_folder(path_), folder_ / "kept");
  CheckpointIdentity identity;
  identity.purpose = "another";
  {
    CheckpointFile first(path_, identity, every);
    first.leave(share(1, 0));
  }
  EXPECT_FALSE(fs::exists(parts_folder(path_)));
  fs::copy(folder_ / "kept", parts_folder(path_));
  EXPECT_EQ(CheckpointFile(path_, every).n_left(), 0);
}

}  // namespace
}  // namespace dygita::checkpoint_file_tests
