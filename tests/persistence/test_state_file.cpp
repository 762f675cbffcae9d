// The state file: what is written comes back, and what is damaged is refused.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "base/fnv1a.hpp"
#include "persistence/state_file.hpp"

namespace dygita::state_file_tests {
namespace {

namespace fs = std::filesystem;

class StateFile : public testing::Test {
 protected:
  StateFile() {
    const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
    path_ = fs::temp_directory_path() / ("dygita_state_" + test + "_" + std::to_string(getpid()));
  }
  ~StateFile() override { fs::remove(path_); }

  // memory: bytes of fields kept in memory; the rest of them lies in a file.
  static RunState some_state(double memory) {
    RunState state;
    state.program = "0.1.0", state.problem = "p", state.case_name = "mu 0.3";
    state.deck_path = "/decks/p.lua", state.deck_text = "-- a\nline \"two\"\n", state.solver = "latin{}";
    state.settings = {{"mu", "0.3"}, {"tighten", "0.04*mm"}};
    state.mesh_digests = {{"low", "abc"}};
    state.loads = {0.0, -1.5, 1e300};
    state.steps = {{"press", true, 2, 0.0, 1e-9}, {"shot", false, 30, 3e-5, 2e-7}};
    state.efforts = {{1e-3, 1e-8, 0, 812, 1.5}, {1e-6, 1e-8, 5, 99, 0.5}};
    state.converged = false, state.interrupted = true;
    auto fields = std::make_shared<InterfaceFields>(memory);
    fields->begin_step();
    fields->append(Vec::LinSpaced(7, 0.0, 1.0));
    fields->begin_step();
    for (int i = 0; i < 5; ++i) fields->append(Vec::Constant(11, 1.0 / (i + 3)));
    state.fields = fields;
    return state;
  }
  std::string bytes() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void put(const std::string& bytes) const { std::ofstream(path_, std::ios::binary) << bytes; }
  std::string refusal() const {
    try {
      read_state(path_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  fs::path path_;
};

TEST_F(StateFile, gives_back_what_was_written_to_the_last_bit) {
  for (const double memory : {1e9, 100.0, 0.0}) {
    const RunState written = some_state(memory);
    write_state(path_, written);
    const RunState read = read_state(path_);
    EXPECT_EQ(read.problem, written.problem);
    EXPECT_EQ(read.case_name, written.case_name);
    EXPECT_EQ(read.deck_text, written.deck_text);
    EXPECT_EQ(read.solver, written.solver);
    EXPECT_EQ(read.settings, written.settings);
    EXPECT_EQ(read.mesh_digests, written.mesh_digests);
    EXPECT_EQ(read.loads, written.loads);
    ASSERT_EQ(read.steps.size(), 2u);
    EXPECT_EQ(read.steps[1].name, "shot");
    EXPECT_EQ(read.steps[1].duration, 3e-5);
    EXPECT_TRUE(read.steps[0].is_static);
    ASSERT_EQ(read.efforts.size(), 2u);
    EXPECT_EQ(read.efforts[0].iterations, 812);
    EXPECT_EQ(read.efforts[1].more_iterations, 5);
    EXPECT_FALSE(read.converged);
    EXPECT_TRUE(read.interrupted);
    EXPECT_EQ(read.n_increments(), 6);
    Vec a, b;
    for (const auto& [step, n] : {std::pair{0, 1}, {1, 5}}) {
      for (int i = 0; i < n; ++i) {
        const Eigen::Index size = written.fields->size(step, i);
        ASSERT_TRUE(written.fields->read(step, i, size, a));
        ASSERT_TRUE(read.fields->read(step, i, size, b));
        EXPECT_EQ(a, b);
      }
    }
    EXPECT_FALSE(read.fields->read(1, 5, 11, b));
    EXPECT_FALSE(read.fields->read(0, 0, 8, b));
  }
}

// The state of two ranks, that have unknowns by turns.
class StateInParts : public StateFile {
 protected:
  ~StateInParts() override { fs::remove_all(state_parts_folder(path_)); }

  static Vec whole(int step, int i) {
    const int n = step == 0 ? 7 : 11;
    return Vec::LinSpaced(n, 0.5 * i, 0.5 * i + n - 1);
  }
  RunState write() const {
    const std::vector<std::vector<AssembledRuns>> runs = {{{7, {{0, 2}, {5, 2}}}, {11, {{0, 11}}}},
                                                          {{7, {{2, 3}}}, {11, {}}}};
    RunState state = some_state(1e9);
    state.parts.sizes = {{7}, {11, 11, 11}};
    for (size_t rank = 0; rank < runs.size(); ++rank) {
      InterfaceFields own(60.0);  // bytes: some in memory, some in a file
      for (int step = 0; step < 2; ++step) {
        const AssembledRuns& of_step = runs[rank][static_cast<size_t>(step)];
        own.begin_step(of_step);
        for (int i = 0; i < (step == 0 ? 1 : 4); ++i) {  // one more than all have
          Vec q(of_step.n_kept());
          long at = 0;
          for (const auto& run : of_step.runs)
            q.segment(at, run.n) = whole(step, i).segment(run.first, run.n), at += run.n;
          own.append(q);
        }
      }
      const fs::path file = state_parts_folder(path_) / std::to_string(rank);
      state.parts.of_ranks.push_back(write_state_part(file, own, state.parts.sizes));
    }
    write_state(path_, state);
    return state;
  }
};

TEST_F(StateInParts, gives_back_what_each_rank_has_written_whole_or_what_is_asked_for) {
  write();
  const RunState read = read_state(path_);
  EXPECT_EQ(read.problem, "p");
  EXPECT_EQ(read.n_increments(), 4);
  Vec q;
  for (const auto& [step, n] : {std::pair{0, 1}, {1, 3}})
    for (int i = 0; i < n; ++i) {
      const Vec all = whole(step, i);
      ASSERT_TRUE(read.fields->read(step, i, all.size(), q));
      EXPECT_EQ(q, all);
    }
  EXPECT_FALSE(read.fields->read(1, 3, 11, q));
  EXPECT_FALSE(read.fields->read(0, 0, 8, q));
  for (const AssembledRuns& asked : {AssembledRuns{7, {{0, 7}}},
                                     {7, {{1, 1}}},
                                     {7, {{1, 5}}},
                                     {7, {{0, 1}, {2, 1}, {4, 3}}},
                                     {7, {{5, 1}, {6, 1}}},
                                     {7, {}}}) {
    ASSERT_TRUE(read.fields->read_some(0, 0, asked, q));
    Vec placed = Vec::Zero(7), expected = Vec::Zero(7);
    asked.place(q, placed);
    for (const auto& run : asked.runs) expected.segment(run.first, run.n) = whole(0, 0).segment(run.first, run.n);
    EXPECT_EQ(placed, expected);
  }
  // One process writes them whole again.
  write_state(path_, read_state(path_));
  fs::remove_all(state_parts_folder(path_));
  ASSERT_TRUE(read_state(path_).fields->read(1, 2, 11, q));
  EXPECT_EQ(q, whole(1, 2));
}

TEST_F(StateInParts, that_has_lost_or_changed_a_byte_or_a_part_is_refused) {
  const RunState state = write();
  ASSERT_EQ(refusal(), "");
  for (const fs::path& file : {path_, state_parts_folder(path_) / "0", state_parts_folder(path_) / "1"}) {
    std::ifstream in(file, std::ios::binary);
    const std::string good{std::istreambuf_iterator<char>(in), {}};
    const auto spoil = [&](const std::string& bad) {
      std::ofstream(file, std::ios::binary) << bad;
      EXPECT_NE(refusal(), "") << file;
      std::ofstream(file, std::ios::binary) << good;
    };
    for (size_t i = 0; i < good.size(); ++i) {
      std::string bad = good;
      bad[i] = static_cast<char>(bad[i] ^ 0x40);
      spoil(bad);
    }
    spoil(good.substr(0, good.size() - 8)), spoil(good + "12345678"), spoil("");
    fs::remove(file);
    EXPECT_NE(refusal(), "");
    std::ofstream(file, std::ios::binary) << good;
  }
  ASSERT_EQ(refusal(), "");
  // Checksums that are right do not make up for unknowns that two ranks have, or none.
  for (const AssembledRuns& wrong : {AssembledRuns{7, {{1, 3}}}, {7, {{2, 2}}}, {8, {{2, 3}}}, {7, {{2, 1L << 62}}}}) {
    RunState other = state;
    other.parts.of_ranks[1].runs[0] = wrong;
    write_state(path_, other);
    EXPECT_NE(refusal(), "");
  }
}

TEST_F(StateFile, that_has_lost_or_changed_a_byte_is_refused) {
  write_state(path_, some_state(1e9));
  const std::string good = bytes();
  ASSERT_EQ(refusal(), "");
  for (size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x40);
    put(bad);
    EXPECT_NE(refusal(), "") << "byte " << i;
  }
  for (const size_t n : {size_t{0}, size_t{5}, size_t{40}, good.size() / 2, good.size() - 1}) {
    put(good.substr(0, n));
    EXPECT_NE(refusal(), "") << n << " bytes";
  }
  put(good + "x");
  EXPECT_NE(refusal(), "");
}

// Fields that would be longer than the file, in one whose checksums are right.
TEST_F(StateFile, with_fields_beyond_its_end_is_refused) {
  write_state(path_, some_state(1e9));
  const std::string good = bytes();
  std::uint64_t length = 0;
  std::memcpy(&length, good.data() + 16, 8);
  for (const std::uint64_t size : {std::uint64_t{1} << 60, ~std::uint64_t{0}, std::uint64_t{1000}}) {
    std::string bad = good;
    std::memcpy(bad.data() + 24 + length - 8, &size, 8);
    Checksum sum;
    sum.add(bad.data() + 24, length);
    const std::uint64_t value = sum.value();
    std::memcpy(bad.data() + 24 + length, &value, 8);
    put(bad);
    EXPECT_EQ(refusal(), "'" + path_.string() + "' cannot be used: it has the wrong length\n    run the deck again");
  }
}

TEST_F(StateFile, of_another_version_or_program_says_so) {
  write_state(path_, some_state(1e9));
  std::string other = bytes();
  other[8] = 7;
  put(other);
  EXPECT_EQ(refusal(), "'" + path_.string() +
                           "' cannot be used: it has version 7 of the format, this program reads versions 1 and 2\n    "
                           "run the deck again");
  put("something else altogether, and long enough to be read");
  EXPECT_EQ(refusal(),
            "'" + path_.string() + "' cannot be used: it is not a state file of dygita\n    run the deck again");
}

TEST_F(StateFile, is_not_written_through_a_link_that_lies_in_its_way) {
  const fs::path others = path_.string() + "_others", temporary = path_.string() + ".tmp";
  std::ofstream(others) << "precious";
  fs::create_symlink(others, temporary);
  write_state(path_, some_state(1e9));
  EXPECT_EQ(refusal(), "");
  EXPECT_FALSE(fs::is_symlink(path_));
  EXPECT_EQ(fs::file_size(others), 8u);
  fs::remove(others);
}

TEST_F(StateFile, that_cannot_be_written_leaves_nothing) {
  const fs::path nowhere = path_.string() + "_folder/state.dygita";
  EXPECT_THROW(write_state(nowhere, some_state(1e9)), InputError);
  EXPECT_FALSE(fs::exists(nowhere.string() + ".tmp"));
}

}  // namespace
}  // namespace dygita::state_file_tests
