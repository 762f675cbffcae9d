// Two copies of an array in one process stand for those of two ranks.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <numeric>

#include "ranks/machine_copies.hpp"

namespace dygita {
namespace {

namespace fs = std::filesystem;
using Outcome = MachineCopies::Outcome;

class MachineCopiesTest : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  MachineCopies copies() const { return {folder_.string(), "mesh_"}; }
  size_t n_files() const { return static_cast<size_t>(std::distance(fs::directory_iterator(folder_), {})); }
  // Is the memory at the middle of the array that of a file in the folder?
  bool is_mapped(const std::vector<int>& array) const {
    const auto at = reinterpret_cast<std::uintptr_t>(array.data() + array.size() / 2);
    std::ifstream maps("/proc/self/maps");
    for (std::string line; std::getline(maps, line);) {
      const std::uintptr_t from = std::stoull(line, nullptr, 16),
                           to = std::stoull(line.substr(line.find('-') + 1), nullptr, 16);
      if (from <= at && at < to) return line.find(folder_.string()) != std::string::npos;
    }
    return false;
  }

  static std::vector<int> array_of(int n, int first) {
    std::vector<int> array(static_cast<size_t>(n));
    std::iota(array.begin(), array.end(), first);
    return array;
  }
  static size_t bytes_of(const std::vector<int>& array) { return sizeof(int) * array.size(); }

  const fs::path folder_ = fs::temp_directory_path() / ("machine_copies_" + std::to_string(getpid()));
};

TEST_F(MachineCopiesTest, have_one_memory_and_the_same_contents_until_somebody_writes) {
  const std::vector<int> expected = array_of(100000, 7);
  std::vector<int> one = expected, two = expected;
  {
    MachineCopies first = copies(), second = copies();
    EXPECT_EQ(first.share(one.data(), bytes_of(one)), Outcome::shared);
    EXPECT_EQ(second.share(two.data(), bytes_of(two)), Outcome::shared);
    EXPECT_EQ(n_files(), 2U - (reinterpret_cast<std::uintptr_t>(one.data()) % 4096 ==
                               reinterpret_cast<std::uintptr_t>(two.data()) % 4096))
        << "arrays that begin at other places of a page have other whole pages";
    EXPECT_GT(first.bytes(), bytes_of(one) - 2 * 4096);
    EXPECT_TRUE(is_mapped(one));
    EXPECT_TRUE(is_mapped(two));
    first.forget_files();
    second.forget_files();
    EXPECT_EQ(n_files(), 0U);
  }
  EXPECT_EQ(one, expected);
  EXPECT_EQ(two, expected);
  one[50000] = -1;
  EXPECT_EQ(two, expected);
  one.resize(200000, 3);
  EXPECT_EQ(one[50000], -1);
  EXPECT_EQ(one[99999], expected[99999]);
}

TEST_F(MachineCopiesTest, leave_small_arrays_and_what_another_process_is_writing) {
  std::vector<int> few = array_of(1000, 0), many = array_of(100000, 0);
  MachineCopies own = copies();
  EXPECT_EQ(own.share(few.data(), bytes_of(few)), Outcome::too_small);
  EXPECT_EQ(n_files(), 0U);
  {
    MachineCopies other = copies();
    ASSERT_EQ(other.share(many.data(), bytes_of(many)), Outcome::shared);
    const fs::path file = fs::directory_iterator(folder_)->path();
    fs::rename(file, file.string() + ".part");
    EXPECT_EQ(own.share(many.data(), bytes_of(many)), Outcome::being_written);
    fs::rename(file.string() + ".part", file);
  }
  EXPECT_EQ(n_files(), 0U) << "who has written a file takes its name away in the end";
  EXPECT_EQ(own.share(many.data(), bytes_of(many)), Outcome::shared);
}

TEST_F(MachineCopiesTest, are_not_made_of_a_file_of_other_contents) {
  std::vector<int> array = array_of(100000, 0);
  const std::vector<int> expected = array;
  MachineCopies writer = copies(), reader = copies();
  ASSERT_EQ(writer.share(array.data(), bytes_of(array)), Outcome::shared);
  const fs::path path = fs::directory_iterator(folder_)->path();
  {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(fs::file_size(path)) - 8);
    file.write("changed!", 8);
  }
  std::vector<int> same = expected;
  if (reinterpret_cast<std::uintptr_t>(same.data()) % 4096 == reinterpret_cast<std::uintptr_t>(array.data()) % 4096) {
    EXPECT_EQ(reader.share(same.data(), bytes_of(same)), Outcome::impossible);
  }
  EXPECT_EQ(same, expected);
}

TEST_F(MachineCopiesTest, are_given_up_where_nothing_can_be_written) {
  std::vector<int> array = array_of(100000, 0);
  MachineCopies nowhere((folder_ / "missing").string(), "mesh_");
  EXPECT_FALSE(nowhere.is_impossible());
  EXPECT_EQ(nowhere.share(array.data(), bytes_of(array)), Outcome::impossible);
  EXPECT_TRUE(nowhere.is_impossible());
  EXPECT_EQ(array, array_of(100000, 0));
}

}  // namespace
}  // namespace dygita
