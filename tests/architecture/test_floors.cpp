#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "architecture/floors.hpp"

namespace dygita::architecture {

namespace {

namespace fs = std::filesystem;

struct Source {
  std::string module, path, text;
};

bool is_source(const fs::path& path) { return path.extension() == ".cpp" || path.extension() == ".hpp"; }

// Every source of src/<module>/, with its path from the repository's root.
std::vector<Source> sources() {
  const fs::path root = fs::path(DYGITA_SOURCE_DIR);
  std::vector<Source> found;
  for (const auto& entry : fs::recursive_directory_iterator(root / "src")) {
    if (!entry.is_regular_file() || !is_source(entry.path())) continue;
    std::ostringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    const fs::path inside = entry.path().lexically_relative(root / "src");
    found.push_back({inside.begin()->string(), ("src" / inside).string(), text.str()});
  }
  return found;
}

}  // namespace

TEST(Floors, are_kept_by_every_include_of_the_sources) {
  const std::vector<Source> all = sources();
  EXPECT_GT(all.size(), 20U) << "are the sources where DYGITA_SOURCE_DIR says?";
  for (const Source& source : all) {
    for (const std::string& violation : violations(source.module, source.text)) {
      ADD_FAILURE() << source.path << ": " << violation;
    }
  }
}

// Two types of one name in one namespace are one to the linker: which of their functions runs is then chance.
TEST(Headers, do_not_name_two_types_alike) {
  const std::regex opens("^namespace ([\\w:]+) \\{"), closes("^\\}  // namespace"),
      names("^(?:class|struct|enum class|enum) (\\w+)(?: final)?(?: :[^:;][^;]*)? \\{");
  std::map<std::string, std::string> first;
  for (const Source& source : sources()) {
    // The mesher is a program of its own.
    if (source.module == "mesher" || fs::path(source.path).extension() != ".hpp") continue;
    std::vector<std::string> inside;
    std::istringstream lines(source.text);
    for (std::string line; std::getline(lines, line);) {
      std::smatch match;
      if (std::regex_search(line, match, opens)) {
        inside.push_back(match[1].str() + "::");
      } else if (std::regex_search(line, closes) && !inside.empty()) {
        inside.pop_back();
      } else if (std::regex_search(line, match, names)) {
        std::string name;
        for (const std::string& space : inside) name += space;
        const auto [other, is_new] = first.emplace(name + match[1].str(), source.path);
        EXPECT_TRUE(is_new || other->second == source.path)
            << other->first << ": " << other->second << " and " << source.path;
      }
    }
  }
  EXPECT_GT(first.size(), 500U);
}

// Each module's page says what it may include, and where to start: in files that are there.
TEST(Floors, are_what_the_page_of_each_module_says) {
  const std::regex in_ticks("`([^`]+)`");
  for (const std::string& module : modules()) {
    const fs::path folder = fs::path(DYGITA_SOURCE_DIR) / "src" / module;
    std::ostringstream text;
    text << std::ifstream(folder / "README.md").rdbuf();
    const std::string page = text.str(), list_begins = "**May include:**";
    const size_t at = page.find(list_begins);
    ASSERT_NE(at, std::string::npos) << "src/" << module << "/README.md says what it may include";
    std::set<std::string> said;
    for (std::sregex_iterator it(page.begin() + static_cast<long>(at), page.end(), in_ticks), end; it != end; ++it)
      said.insert((*it)[1].str());
    EXPECT_EQ(said, below(module)) << "src/" << module << "/README.md";
    const std::string before = page.substr(0, at);
    for (std::sregex_iterator it(before.begin(), before.end(), in_ticks), end; it != end; ++it) {
      const std::string name = (*it)[1].str();
      if (name.find(".hpp") == std::string::npos && name.find(".cpp") == std::string::npos) continue;
      if (name.find('*') != std::string::npos) continue;
      EXPECT_TRUE(fs::exists(folder / name)) << "src/" << module << "/README.md names " << name;
    }
  }
}

// What CMake links must be the same table: else a floor could be skipped through a transitive include path.
TEST(Floors, are_what_cmake_links) {
  std::ostringstream text;
  text << std::ifstream(fs::path(DYGITA_SOURCE_DIR) / "CMakeLists.txt").rdbuf();
  const std::string lists = text.str();
  const std::regex declaration("dygita_module\\((\\w+)(?:\\s+DEPENDS\\s+([\\w\\s]*))?");
  int n_modules = 0;
  for (std::sregex_iterator it(lists.begin(), lists.end(), declaration), end; it != end; ++it, ++n_modules) {
    std::istringstream words((*it)[2].str());
    for (std::string word; words >> word && word != "PRIVATE_LIBRARIES";) {
      EXPECT_EQ(violations((*it)[1], "#include \"" + word + "/any.hpp\"").size(), 0U)
          << "CMakeLists.txt links " << (*it)[1] << " with " << word;
    }
  }
  EXPECT_GE(n_modules, 28);
}

TEST(Floors, let_a_module_include_itself_and_the_floors_below_it) {
  EXPECT_TRUE(violations("latin",
                         "#pragma once\n#include <vector>\n#include \"latin/stages.hpp\"\n"
                         "#include \"step/step_model.hpp\"\n#include <Eigen/Core>\n")
                  .empty());
}

TEST(Floors, refuse_a_higher_floor) {
  EXPECT_EQ(violations("mesh", "#include <map>\n#include \"model/model.hpp\"\n"),
            std::vector<std::string>{"line 2: mesh may not include model/model.hpp"});
}

TEST(Floors, refuse_a_neighbour_on_the_same_floor) {
  EXPECT_EQ(violations("latin", "#include \"reference/monolithic.hpp\"").size(), 1U);
  EXPECT_EQ(violations("signal", "#include \"mesh/mesh.hpp\"").size(), 1U);
}

TEST(Floors, refuse_a_lower_floor_that_is_not_named) {
  EXPECT_EQ(violations("law", "#include \"mesh/mesh.hpp\"").size(), 1U);
  EXPECT_EQ(violations("files", "#include \"step/step_model.hpp\"").size(), 1U);
  EXPECT_EQ(violations("app", "#include \"marching/solve.hpp\"").size(), 1U);
}

TEST(Floors, keep_a_library_in_its_module) {
  const std::vector<std::pair<std::string, std::set<std::string>>> homes = {
      {"cholmod.h", {"numerics"}}, {"metis.h", {"numerics"}},
      {"cblas.h", {"numerics"}},   {"lapacke.h", {"numerics"}},
      {"gmsh.h", {"mesher"}},      {"vtkCellType.h", {"files"}},
      {"lua.hpp", {"deck"}},       {"lauxlib.h", {"deck"}},
      {"CLI/CLI.hpp", {"app"}},    {"nlohmann/json.hpp", {"intake", "files", "drawing", "report"}}};
  for (const auto& [header, home] : homes) {
    for (const std::string& module : modules()) {
      const size_t expected = home.contains(module) ? 0U : 1U;
      EXPECT_EQ(violations(module, "#include <" + header + ">").size(), expected) << header << " in " << module;
    }
  }
}

TEST(Floors, refuse_an_unknown_library_and_an_unknown_module) {
  EXPECT_EQ(violations("base", "#include <boost/graph.hpp>").size(), 1U);
  EXPECT_EQ(violations("attic", "").size(), 1U);
}

TEST(Floors, see_through_spaces_and_not_into_comments) {
  EXPECT_EQ(violations("base", "  #  include  \"deck/deck.hpp\"").size(), 1U);
  EXPECT_EQ(violations("base", "// #include \"deck/deck.hpp\"\n/* kept\n#include \"deck/deck.hpp\"\n*/\n").size(), 0U);
  EXPECT_EQ(violations("base", "/**/\n\n#include \"deck/deck.hpp\"\n"),
            std::vector<std::string>{"line 3: base may not include deck/deck.hpp"});
}

// More lines than the aim need a reason in the first comment, so they are only printed.
TEST(Sources, over_the_aimed_length_are_listed_and_none_is_twice_as_long) {
  for (const Source& source : sources()) {
    const long lines = std::count(source.text.begin(), source.text.end(), '\n');
    const long aim = fs::path(source.path).extension() == ".hpp" ? 150 : 300;
    if (lines > aim) std::cout << "long: " << source.path << " has " << lines << " lines, aim " << aim << "\n";
    EXPECT_LE(lines, 2 * aim) << source.path << ": split it";
  }
}

std::vector<std::string> sources_with(const std::string& pattern) {
  const std::regex sought(pattern);
  std::vector<std::string> found;
  for (const Source& source : sources())
    if (std::regex_search(source.text, sought)) found.push_back(source.path);
  std::sort(found.begin(), found.end());
  return found;
}

// An exception that leaves a thread by itself ends the program without a message: base/parallel.hpp is the one place
// that shares work among threads, and hands on what is thrown.
TEST(Sources, share_work_among_threads_in_one_place) {
  EXPECT_EQ(sources_with("#\\s*pragma\\s+omp\\s+(?!simd\\b)|_Pragma|\\bstd::(thread|jthread|async)\\b"),
            (std::vector<std::string>{"src/base/aside.cpp",  // one thread, whose caller waits and gets what it throws
                                      "src/base/team.cpp", "src/base/watchdog.cpp",
                                      "src/base/watchdog.hpp"}));  // does no work
  EXPECT_EQ(sources_with("\\brun_on_team\\b"),
            (std::vector<std::string>{"src/base/parallel.hpp", "src/base/team.cpp", "src/base/team.hpp"}));
}

TEST(Sources, are_all_in_a_module) {
  for (const Source& source : sources()) {
    const std::vector<std::string> known = modules();
    EXPECT_NE(std::find(known.begin(), known.end(), source.module), known.end()) << source.path;
  }
}

}  // namespace dygita::architecture
