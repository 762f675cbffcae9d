// What a run may remove from an output directory, and what it must leave.
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "files/manifest.hpp"
#include "scratch.hpp"

namespace dygita {
namespace {

namespace fs = std::filesystem;

TEST(Manifest, removes_what_a_former_run_listed_and_nothing_else) {
  const Scratch scratch;
  const fs::path out = scratch.path() / "out";
  fs::create_directories(out / "frames" / "mine");
  {
    Manifest manifest(out);
    manifest.add("a.csv");
    manifest.add("frames/a_00000.vtu");
    manifest.add("frames/mine/b.vtu");
  }
  for (const char* file :
       {"a.csv", "a.csv.tmp", "notes.txt", "frames/a_00000.vtu", "frames/mine/b.vtu", "frames/keep.vtu"}) {
    put(out / file, "x");
  }
  const Manifest again(out);
  EXPECT_FALSE(fs::exists(out / "a.csv"));
  EXPECT_FALSE(fs::exists(out / "a.csv.tmp"));
  EXPECT_FALSE(fs::exists(out / "frames/a_00000.vtu"));
  EXPECT_FALSE(fs::exists(out / "frames/mine"));  // empty now
  EXPECT_TRUE(fs::exists(out / "frames/keep.vtu"));
  EXPECT_TRUE(fs::exists(out / "notes.txt"));
  EXPECT_TRUE(again.files().empty());
}

TEST(Manifest, with_entries_that_lead_out_of_the_directory_removes_nothing_there) {
  const Scratch scratch;
  const fs::path out = scratch.path() / "out", elsewhere = scratch.path() / "elsewhere";
  fs::create_directories(out / "folder");
  fs::create_directories(elsewhere);
  put(elsewhere / "precious", "x");
  put(out / "folder" / "kept", "x");
  fs::create_directory_symlink(elsewhere, out / "link");
  put(out / Manifest::file_name, "../elsewhere/precious\n" + (elsewhere / "precious").string() +
                                     "\nlink/precious\nfolder/../../elsewhere/precious\nfolder\n\n.\n");
  const Manifest manifest(out);
  EXPECT_TRUE(fs::exists(elsewhere / "precious"));
  EXPECT_TRUE(fs::exists(out / "folder" / "kept"));
  EXPECT_TRUE(fs::exists(out / "link"));
}

TEST(Manifest, removes_a_listed_link_and_not_what_it_points_to) {
  const Scratch scratch;
  put(scratch.path() / "target", "x");
  fs::create_directory(scratch.path() / "out");
  fs::create_symlink(scratch.path() / "target", scratch.path() / "out" / "a.csv");
  put(scratch.path() / "out" / Manifest::file_name, "a.csv\n");
  const Manifest manifest(scratch.path() / "out");
  EXPECT_TRUE(fs::exists(scratch.path() / "target"));
  EXPECT_FALSE(fs::is_symlink(scratch.path() / "out" / "a.csv"));
}

TEST(Manifest, lists_a_file_once_and_before_it_is_there) {
  const Scratch scratch;
  Manifest manifest(scratch.path());
  manifest.add("a.pvd");
  manifest.add("b.pvd");
  manifest.add("a.pvd");
  EXPECT_EQ(manifest.files().size(), 2u);
  EXPECT_TRUE(text_of(scratch.path() / Manifest::file_name).ends_with("\na.pvd\nb.pvd\n"));
}

TEST(Manifest, in_a_directory_that_is_not_there_is_an_input_error) {
  const Scratch scratch;
  EXPECT_THROW(Manifest(scratch.path() / "nowhere"), InputError);
}

}  // namespace
}  // namespace dygita
