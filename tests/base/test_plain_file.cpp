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

TEST(PlainFile, is_refused_by_its_size_before_it_is_read) {
  const fs::path file = fs::temp_directory_path() / ("dygita_large_" + std::to_string(getpid()));
  std::ofstream(file) << "1,2\n";
  EXPECT_EQ(text_of_file(file.string()), "1,2\n");
  fs::resize_file(file, std::uintmax_t{50} << 30);  // sparse
  const auto message = [&] {
    try {
      text_of_file(file.string());
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message(), "the file '" + file.string() +
                           "' has 5.12e+04 MB; the limit is 1024 MB\n    --memory-limit raises the limit");
  set_file_limit(100.0 * (1 << 30));
  EXPECT_NO_THROW(require_readable(file));
  set_file_limit(4.0);
  fs::resize_file(file, 4);
  EXPECT_EQ(text_of_file(file.string()), "1,2\n");
  set_file_limit(3.0);
  EXPECT_THROW(text_of_file(file.string()), InputError);
  set_file_limit(1024.0 * (1 << 20));
  fs::remove(file);
}

}  // namespace
}  // namespace dygita
