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
