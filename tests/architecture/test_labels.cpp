#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "architecture/labels.hpp"

namespace dygita::architecture {

namespace {

namespace fs = std::filesystem;

std::string read(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

std::set<char> families_of(const std::vector<std::string>& labels) {
  std::set<char> families;
  for (const std::string& label : labels) families.insert(label.front());
  return families;
}

const std::map<std::string, Prose> prose_of_extension = {{".cpp", Prose::cpp_comments},
                                                         {".hpp", Prose::cpp_comments},
                                                         {".lua", Prose::lua_comments},
                                                         {".py", Prose::python_comments},
                                                         {".md", Prose::markdown}};

using Labels = std::vector<std::string>;

}  // namespace

TEST(Labels, are_each_defined_once) {
  const Labels labels = defined_labels(read(fs::path(DYGITA_SOURCE_DIR) / "manual/method.md"));
  EXPECT_GT(labels.size(), 50U) << "is the method where DYGITA_SOURCE_DIR says?";
  for (const std::string& label : std::set<std::string>(labels.begin(), labels.end()))
    EXPECT_EQ(std::count(labels.begin(), labels.end(), label), 1) << label << " in manual/method.md";
}

TEST(Labels, are_defined_wherever_they_are_cited) {
  const fs::path root = fs::path(DYGITA_SOURCE_DIR);
  const Labels defined = defined_labels(read(root / "manual/method.md"));
  int n_cited = 0;
  for (const char* folder : {"src", "tests", "manual", "lua", "decks"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const auto prose = prose_of_extension.find(entry.path().extension().string());
      if (!entry.is_regular_file() || prose == prose_of_extension.end()) continue;
      if (entry.path().filename() == "test_labels.cpp" || entry.path().filename() == "labels.hpp")
        continue;  // examples
      for (const std::string& label : cited_labels(read(entry.path()), prose->second, families_of(defined))) {
        ++n_cited;
        EXPECT_NE(std::find(defined.begin(), defined.end(), label), defined.end())
            << entry.path().lexically_relative(root).string() << " cites " << label
            << ", which manual/method.md does not define";
      }
    }
  }
  EXPECT_GT(n_cited, 100);
}

TEST(Labels, are_found_at_both_ends_of_an_equation_and_not_in_prose) {
  EXPECT_EQ(defined_labels("    S1    M a = f\n          and more\n    e = 1/2 u K u      (Q1)\n(Q2) in prose\nS3  no\n"
                           "    P1 = P0 + W0\n    S1    again\n"),
            (Labels{"S1", "Q1", "S1"}));
}

TEST(Labels, are_cited_in_comments) {
  const std::set<char> families = {'B', 'S'};
  EXPECT_EQ(cited_labels("int B3 = 0;  // manual, eq. B2-B7\n", Prose::cpp_comments, families), (Labels{"B2", "B7"}));
  EXPECT_EQ(cited_labels("-- (S4) and eq. Z9, not Z8, S0, xS1 or S2_old\n", Prose::lua_comments, families),
            (Labels{"S4", "Z9"}));
  EXPECT_EQ(cited_labels("By S3. `S8` is code.\n    S7    an equation\n", Prose::markdown, families), (Labels{"S3"}));
}

}  // namespace dygita::architecture
