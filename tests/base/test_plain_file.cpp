// What is opened to be read must have an end.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "base/error.hpp"
#include "base/plain_file.hpp"

namespace dygita {
namespace {

namespace fs = std::filesystem;

TEST(PlainFile, is_no_pipe_no_device_and_no_folder) {
  const fs::path folder = fs::temp_directory_path() / ("dygita_plain_" + std::to_string(getpid()));
  fs::create_directories(folder);
  const fs::path file = folder / "file", pipe = folder / "pipe", link = folder / "link";
  std::ofstream(file) << "1,2\n";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  fs::create_symlink(pipe, link);
  for (const fs::path& other : {pipe, link, folder, fs::path("/dev/zero")}) {
    EXPECT_TRUE(is_no_file(other)) << other;
    EXPECT_THROW(require_file(other), InputError) << other;
  }
  fs::remove(link);
  fs::create_symlink(file, link);
  for (const fs::path& good : {file, link, folder / "nothing"}) EXPECT_NO_THROW(require_file(good)) << good;
  fs::remove_all(folder);
}

}  // namespace
}  // namespace dygita
