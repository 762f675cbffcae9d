// Meshes kept beside a deck: the same bits as without, and nothing but what this user has kept of the same question.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "intake/mesh_cache.hpp"
#include "intake/mesher_process.hpp"
#include "intake/step_assembly.hpp"

namespace dygita::mesh_cache_tests {

namespace {

namespace fs = std::filesystem;

std::string bytes_in(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void write(const fs::path& file, const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; }

// A folder with a CAD file, a user with a secret of his own, a cache of 100 MB.
class MeshCacheTest : public ::testing::Test {
 protected:
  MeshCacheTest() : folder_(fs::temp_directory_path() / ("dygita_cache_" + std::to_string(getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    fs::copy_file(fs::path(DYGITA_SOURCE_DIR) / "tests/intake/ring_on_plate.step", file());
    if (const char* state = std::getenv("XDG_STATE_HOME")) state_ = state;
    be_user("one");
    set_mesh_folder(folder_.string());
    set_limit(1e8);
  }
  ~MeshCacheTest() override {
    set_mesh_limits({});
    set_mesh_folder("");
    if (state_.empty())
      unsetenv("XDG_STATE_HOME");
    else
      setenv("XDG_STATE_HOME", state_.c_str(), 1);
    fs::remove_all(folder_);
  }

  static void set_limit(double bytes) {
    MeshLimits limits;
    limits.cache = bytes;
    set_mesh_limits(limits);
  }
  void be_user(const std::string& name) const { setenv("XDG_STATE_HOME", (folder_ / name).c_str(), 1); }
  fs::path file() const { return folder_ / "assembly.step"; }
  fs::path cache() const { return folder_ / MeshCache::folder_name; }
  StepOptions options(double size = 0.01) const {
    StepOptions options;
    options.file = file().string();
    options.size = size;
    return options;
  }
  std::string found(const StepOptions& asked) const {
    return MeshCache({.options = asked, .path = asked.file}, asked.file, folder_.string()).find();
  }
  std::vector<fs::path> entries() const {
    std::vector<fs::path> all;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(cache(), none)) all.push_back(entry.path());
    return all;
  }
  static void expect_same_bits(const StepAssembly& a, const StepAssembly& b) {
    ASSERT_EQ(a.parts().size(), b.parts().size());
    for (size_t i = 0; i < a.parts().size(); ++i) {
      EXPECT_EQ(a.parts()[i].name, b.parts()[i].name);
      EXPECT_EQ(a.parts()[i].mesh->digest, b.parts()[i].mesh->digest);
      EXPECT_EQ(a.parts()[i].mesh->nodes, b.parts()[i].mesh->nodes);
    }
  }

 private:
  fs::path folder_;
  std::string state_;
};

TEST_F(MeshCacheTest, gives_the_same_bits_as_gmsh) {
  set_limit(0.0);
  const StepAssembly without(options());
  EXPECT_TRUE(entries().empty());
  set_limit(1e8);
  const StepAssembly first(options());
  ASSERT_EQ(entries().size(), 1u);
  EXPECT_FALSE(found(options()).empty());
  const StepAssembly again(options());
  expect_same_bits(without, first);
  expect_same_bits(without, again);
}

TEST_F(MeshCacheTest, answers_no_other_question) {
  const StepAssembly meshed(options());
  EXPECT_FALSE(found(options()).empty());
  EXPECT_EQ(found(options(0.011)), "");
  StepOptions other = options();
  other.order = 2;
  EXPECT_EQ(found(other), "");
  other = options();
  other.parts = {"*"};
  EXPECT_EQ(found(other), "");
  write(file(), bytes_in(file()) + "\n");
  EXPECT_EQ(found(options()), "");
  // The answer to one question under the name of another.
  const fs::path first = entries().front();
  const StepAssembly changed(options());
  ASSERT_EQ(entries().size(), 2u);
  const fs::path second = entries()[0] == first ? entries()[1] : entries()[0];
  write(second, bytes_in(first));
  EXPECT_EQ(found(options()), "");
}

TEST_F(MeshCacheTest, believes_nothing_that_was_changed_and_keeps_it_anew) {
  const StepAssembly meshed(options());
  const fs::path entry = entries().front();
  const std::string whole = bytes_in(entry);
  for (size_t at = 0; at < whole.size(); at += 1 + whole.size() / 97) {
    std::string spoiled = whole;
    spoiled[at] = static_cast<char>(spoiled[at] ^ 1);
    write(entry, spoiled);
    EXPECT_EQ(found(options()), "") << "byte " << at;
    write(entry, whole.substr(0, at));
    EXPECT_EQ(found(options()), "") << "cut at " << at;
  }
  write(entry, whole + "x");
  EXPECT_EQ(found(options()), "");
  expect_same_bits(meshed, StepAssembly(options()));
  EXPECT_EQ(bytes_in(entry), whole);
  EXPECT_FALSE(found(options()).empty());
}

TEST_F(MeshCacheTest, believes_nobody_else) {
  const StepAssembly meshed(options());
  const std::string kept = bytes_in(entries().front());
  be_user("another");  // has a secret of his own: what came with the folder is not his
  EXPECT_EQ(found(options()), "");
  const StepAssembly his(options());
  ASSERT_EQ(entries().size(), 2u);
  for (const fs::path& entry : entries()) write(entry, kept);
  EXPECT_EQ(found(options()), "");
  be_user("one");
  EXPECT_FALSE(found(options()).empty());
}

TEST_F(MeshCacheTest, follows_no_link) {
  const StepAssembly meshed(options());
  const fs::path entry = entries().front(), aside = cache() / "aside";
  fs::rename(entry, aside);
  fs::create_symlink(aside, entry);
  EXPECT_EQ(found(options()), "");
  fs::remove(entry);
  fs::create_hard_link(aside, entry);
  EXPECT_EQ(found(options()), "");
  fs::remove_all(cache());
  const fs::path elsewhere = cache().parent_path() / "elsewhere";
  fs::create_directory(elsewhere);
  fs::create_directory_symlink(elsewhere, cache());
  expect_same_bits(meshed, StepAssembly(options()));
  EXPECT_TRUE(fs::is_empty(elsewhere));
}

TEST_F(MeshCacheTest, does_without_a_folder_or_a_secret) {
  write(cache(), "a file in the place of the folder");
  const StepAssembly meshed(options());
  EXPECT_EQ(bytes_in(cache()), "a file in the place of the folder");
  fs::remove(cache());
  setenv("XDG_STATE_HOME", "/proc/dygita", 1);
  expect_same_bits(meshed, StepAssembly(options()));
  EXPECT_FALSE(fs::exists(cache()));
}

// An entry of holes is not even read, which would show in the time of its last use.
TEST_F(MeshCacheTest, reads_no_file_of_holes) {
  const StepAssembly meshed(options());
  const fs::path entry = entries().front();
  const auto long_ago = fs::last_write_time(entry) - std::chrono::hours(1);
  write(entry, bytes_in(entry) + "x");
  fs::last_write_time(entry, long_ago);
  EXPECT_EQ(found(options()), "");
  EXPECT_GT(fs::last_write_time(entry), long_ago);  // read, and refused
  fs::resize_file(entry, 90'000'000);
  fs::last_write_time(entry, long_ago);
  EXPECT_EQ(found(options()), "");
  EXPECT_EQ(fs::last_write_time(entry), long_ago);
}

TEST_F(MeshCacheTest, has_an_end) {
  const StepAssembly one(options());
  const double bytes = static_cast<double>(fs::file_size(entries().front()));
  set_limit(1.5 * bytes);
  const StepAssembly other(options(0.0101));
  EXPECT_EQ(entries().size(), 1u);
  EXPECT_EQ(found(options()), "");
  EXPECT_FALSE(found(options(0.0101)).empty());
  set_limit(0.5 * bytes);
  EXPECT_EQ(found(options(0.0101)), "");
}

TEST_F(MeshCacheTest, keeps_nothing_of_files_that_name_others) {
  std::string text = bytes_in(file());
  const size_t at = text.find("DATA;");
  ASSERT_NE(at, std::string::npos);
  text.insert(at + 5, "\n#99999=DOCUMENT_FILE('other.step','',$,#99998,'','');");
  write(file(), text);
  EXPECT_EQ(found(options()), "");
  const StepAssembly meshed(options());
  EXPECT_TRUE(entries().empty());
}

}  // namespace

}  // namespace dygita::mesh_cache_tests
