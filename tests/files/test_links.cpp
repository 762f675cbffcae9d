// Links in a folder that came from somebody else: nothing is written through them.
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "files/files.hpp"
#include "files/replacement.hpp"
#include "files/run_lock.hpp"
#include "files/run_writer.hpp"
#include "scratch.hpp"

namespace dygita {
namespace {

namespace fs = std::filesystem;

TEST(Links, in_the_way_of_a_file_are_not_followed) {
  const Scratch scratch;
  const fs::path others = scratch.path() / "others";
  put(others, "precious");
  for (const char* link : {"table.csv", "table.csv.tmp"}) {
    fs::create_symlink(others, scratch.path() / link);
    write_text(scratch.path() / "table.csv", "1,2\n");
    EXPECT_EQ(text_of(others), "precious") << link;
    EXPECT_FALSE(fs::is_symlink(scratch.path() / "table.csv")) << link;
    EXPECT_EQ(text_of(scratch.path() / "table.csv"), "1,2\n") << link;
    fs::remove(scratch.path() / "table.csv");
  }
}

TEST(Links, in_the_place_of_a_lock_are_refused) {
  const Scratch scratch;
  const fs::path others = scratch.path() / "others", lock = scratch.path() / ".base.lock";
  put(others, "precious");
  fs::create_symlink(others, lock);
  std::string message;
  try {
    const RunLock held(scratch.path() / "base");
  } catch (const InputError& error) {
    message = error.what();
  }
  EXPECT_EQ(message, "'" + lock.string() + "' is a link, and not a lock of dygita: remove it");
  EXPECT_EQ(text_of(others), "precious");
}

TEST(Links, of_a_lock_to_another_file_are_refused) {
  const Scratch scratch;
  const fs::path others = scratch.path() / "others", lock = scratch.path() / ".base.lock";
  put(others, "precious");
  fs::create_hard_link(others, lock);
  std::string message;
  try {
    const RunLock held(scratch.path() / "base");
  } catch (const InputError& error) {
    message = error.what();
  }
  EXPECT_EQ(message, "'" + lock.string() +
                         "' is no file of its own, but a second name of another, and not a lock of dygita: remove it");
  EXPECT_EQ(text_of(others), "precious");
  fs::remove(lock);
  const RunLock held(scratch.path() / "base");
}

TEST(Links, in_the_place_of_new_results_are_refused) {
  const Scratch scratch;
  const fs::path base = scratch.path() / "base", work = scratch.path() / ".base.continued";
  fs::create_directories(base);
  fs::create_directory_symlink(base, work);
  std::string message;
  try {
    const Replacement replacement(base);
  } catch (const InputError& error) {
    message = error.what();
  }
  EXPECT_EQ(message, "'" + work.string() + "' is a link or a file, where new results are to be written: remove it");
  EXPECT_TRUE(fs::is_symlink(work));
  fs::remove(work);
  fs::create_directory(work);  // as a killed run leaves it
  const Replacement replacement(base);
}

TEST(Links, in_the_place_of_the_folders_of_frames_are_refused_before_a_run) {
  for (const char* link : {"frames", "frames/interfaces"}) {
    const Scratch scratch;
    const fs::path run = scratch.path() / "base", others = scratch.path() / "others";
    fs::create_directories(run / fs::path(link).parent_path());
    fs::create_directories(others);
    fs::create_directory_symlink(others, run / link);
    std::string message;
    try {
      const RunWriter writer(run, "rod");
    } catch (const InputError& error) {
      message = error.what();
    }
    EXPECT_EQ(message,
              "'" + (run / link).string() + "' is a link, and files would be written where it leads: remove it");
    EXPECT_TRUE(fs::is_empty(others)) << link;
  }
}

}  // namespace
}  // namespace dygita
