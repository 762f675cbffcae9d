// New results in the place of old ones, and tables read back.
#include "base/error.hpp"
#include "files/csv.hpp"
#include "files/manifest.hpp"
#include "files/replacement.hpp"
#include "scratch.hpp"

namespace dygita {
namespace {

namespace fs = std::filesystem;

// A folder of results as a run leaves it, with a note of the user's beside them.
void put_results(const fs::path& folder, const std::string& text) {
  fs::create_directories(folder / "frames");
  Manifest manifest(folder);
  for (const char* file : {"tip.csv", "frames/a_00000.vtu"}) {
    manifest.add(file);
    put(folder / file, text);
  }
}

// A killed run's folder of new results may have been prepared by somebody: nothing is moved through its links.
TEST(Replacement, moves_nothing_through_a_link_in_what_a_killed_run_left) {
  const Scratch scratch;
  const fs::path folder = scratch.path() / "base", elsewhere = scratch.path() / "elsewhere";
  put_results(folder, "old");
  fs::create_directories(folder / "notes");
  put(folder / "notes/script.py", "theirs");
  fs::create_directories(elsewhere);
  fs::create_directories(scratch.path() / ".base.continued");
  fs::create_directory_symlink(elsewhere, scratch.path() / ".base.continued/notes");
  Replacement replacement(folder);
  put_results(replacement.work(), "new");
  replacement.commit();
  EXPECT_TRUE(fs::is_empty(elsewhere));
  EXPECT_EQ(text_of(folder / "tip.csv"), "new");
  EXPECT_EQ(text_of(folder / "notes/script.py"), "theirs");
  EXPECT_TRUE(fs::is_symlink(scratch.path() / "base.kept/notes"));
}

TEST(Replacement, keeps_a_folder_of_the_users_that_has_the_name_of_a_result) {
  const Scratch scratch;
  const fs::path folder = scratch.path() / "base";
  put_results(folder, "old");
  fs::remove(folder / "tip.csv");
  fs::create_directories(folder / "tip.csv");
  put(folder / "tip.csv/mine", "mine");
  Replacement replacement(folder);
  put_results(replacement.work(), "new");
  testing::internal::CaptureStderr();
  replacement.commit();
  EXPECT_NE(testing::internal::GetCapturedStderr().find("keeps what was beside the old results"), std::string::npos);
  EXPECT_EQ(text_of(folder / "tip.csv"), "new");
  EXPECT_EQ(text_of(scratch.path() / "base.kept/tip.csv/mine"), "mine");
  // The next continuation finds nothing in its way, and takes nothing away.
  Replacement again(folder);
  put_results(again.work(), "newer");
  again.commit();
  EXPECT_EQ(text_of(folder / "tip.csv"), "newer");
  EXPECT_EQ(text_of(scratch.path() / "base.kept/tip.csv/mine"), "mine");
  EXPECT_FALSE(fs::exists(again.work()));
}

// A kill right after the exchange leaves the old results and what lay beside them there; the next continuation may
// stop.
TEST(Replacement, gives_back_what_a_killed_run_left_of_others_whether_it_commits_or_not) {
  const Scratch scratch;
  const fs::path folder = scratch.path() / "base", left = scratch.path() / ".base.continued";
  put_results(folder, "new");
  put_results(left, "old");
  put(left / "notes.txt", "mine");
  put(left / "checkpoint", "old");
  fs::create_directories(left / "checkpoint.parts");
  put(left / "checkpoint.parts/1", "old");
  put(left / "checkpoint.parts/list", "mine");
  fs::create_directories(left / ".dygita-files.mine");
  put(left / ".dygita-files.mine/user", "mine");
  {
    Replacement stopped(folder, {"checkpoint"});
    EXPECT_FALSE(fs::exists(left));
    put_results(stopped.work(), "half");
  }
  EXPECT_FALSE(fs::exists(left));
  EXPECT_EQ(text_of(folder / "tip.csv"), "new");
  EXPECT_FALSE(fs::exists(folder / "checkpoint"));
  EXPECT_FALSE(fs::exists(folder / "checkpoint.parts/1"));
  EXPECT_EQ(text_of(folder / "notes.txt"), "mine");
  EXPECT_EQ(text_of(folder / "checkpoint.parts/list"), "mine");
  EXPECT_EQ(text_of(folder / ".dygita-files.mine/user"), "mine");
}

TEST(Replacement, takes_the_place_of_the_old_results_and_keeps_what_others_put_there) {
  const Scratch scratch;
  const fs::path folder = scratch.path() / "base";
  put_results(folder, "old");
  put(folder / "notes.txt", "mine");
  put(folder / "frames/view.pvsm", "mine");
  {
    Replacement replacement(folder);
    put_results(replacement.work(), "new");
    EXPECT_EQ(text_of(folder / "tip.csv"), "old");
    replacement.commit();
    EXPECT_FALSE(fs::exists(replacement.work()));
  }
  EXPECT_EQ(text_of(folder / "tip.csv"), "new");
  EXPECT_EQ(text_of(folder / "frames/a_00000.vtu"), "new");
  EXPECT_EQ(text_of(folder / "notes.txt"), "mine");
  EXPECT_EQ(text_of(folder / "frames/view.pvsm"), "mine");
}

TEST(Replacement, leaves_the_old_results_where_it_is_not_committed) {
  const Scratch scratch;
  const fs::path folder = scratch.path() / "base";
  put_results(folder, "old");
  fs::path work;
  {
    Replacement replacement(folder);
    work = replacement.work();
    put_results(work, "new");
  }
  EXPECT_EQ(text_of(folder / "tip.csv"), "old");
  EXPECT_FALSE(fs::exists(work));
}

TEST(Csv, tables_come_back_as_they_were_written) {
  const Scratch scratch;
  const Table table{{"time", "a, \"b\""}, {"s", ""}, {{0.0, 1e-6, 2e-6}, {1.5, -2.25e300, 0.1}}, {0, 1, 1}};
  const std::vector<std::string> steps = {"press", "a, b"};
  put(scratch.path() / "t.csv", csv_text(table, steps));
  const Table back = read_csv(scratch.path() / "t.csv", steps);
  EXPECT_EQ(back.names, table.names);
  EXPECT_EQ(back.units, table.units);
  EXPECT_EQ(back.columns, table.columns);
  EXPECT_EQ(back.step, table.step);
  put(scratch.path() / "s.csv", "frequency [Hz],maximax [m/s^2]\n100,2\n200,x\n");
  EXPECT_THROW(read_csv(scratch.path() / "s.csv", {}), InputError);
  EXPECT_THROW(read_csv(scratch.path() / "none.csv", {}), InputError);
  EXPECT_THROW(read_csv(scratch.path() / "t.csv", {"press"}), InputError);
}

}  // namespace
}  // namespace dygita
