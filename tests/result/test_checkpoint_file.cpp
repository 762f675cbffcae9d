#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "result/checkpoint_file.hpp"

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

}  // namespace
}  // namespace dygita::checkpoint_file_tests
