#include "architecture/floors.hpp"

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace dygita::architecture {

namespace {

// Everything below a module that is named for it; itself is understood.
const std::map<std::string, std::set<std::string>> may_use = {
    {"base", {}},
    {"ranks", {"base"}},
    {"numerics", {"base"}},
    {"mesh", {"base", "numerics"}},
    {"signal", {"base"}},
    {"material", {"base", "numerics"}},
    {"meeting", {"base", "numerics", "mesh"}},
    {"fem", {"base", "numerics", "mesh", "material"}},
    {"law", {"base", "numerics", "signal", "material"}},
    {"intake", {"base", "ranks", "numerics", "mesh"}},
    {"mesher", {"base", "numerics", "mesh", "intake"}},
    {"foreign", {"base", "ranks", "numerics", "mesh", "intake"}},
    {"model", {"base", "mesh", "signal", "material", "meeting", "law"}},
    {"checks", {"base", "mesh", "signal", "material", "law", "model"}},
    {"interfaces", {"base", "numerics", "mesh", "meeting", "law", "model"}},
    {"partition", {"base", "ranks", "numerics", "mesh", "fem", "model", "interfaces"}},
    {"exchange", {"base", "ranks", "numerics", "law", "model", "interfaces", "partition"}},
    {"pieces", {"base", "numerics", "mesh", "material", "fem", "model", "interfaces"}},
    {"step",
     {"base", "ranks", "numerics", "meeting", "fem", "law", "model", "interfaces", "partition", "exchange", "pieces"}},
    {"latin", {"base", "ranks", "fem", "law", "model", "interfaces", "partition", "step"}},
    {"marching",
     {"base", "ranks", "numerics", "fem", "law", "interfaces", "partition", "exchange", "pieces", "step", "latin"}},
    {"reference", {"base", "numerics", "fem", "law", "pieces", "step"}},
    {"persistence", {"base", "ranks", "numerics", "model", "interfaces", "step"}},
    {"result", {"base", "mesh", "model", "step"}},
    {"watch",
     {"base", "ranks", "numerics", "meeting", "fem", "law", "model", "interfaces", "partition", "exchange", "step",
      "result"}},
    {"estimates", {"base", "numerics", "signal", "fem", "model", "pieces", "result", "watch"}},
    {"reduction", {"base", "numerics", "mesh", "fem", "law", "model", "exchange", "step", "result", "watch"}},
    {"recording",
     {"base", "numerics", "signal", "meeting", "fem", "law", "model", "step", "result", "watch", "estimates",
      "reduction"}},
    {"files", {"base", "numerics", "law", "model", "result", "recording"}},
    {"drawing", {"base", "mesh", "signal", "model", "result", "files"}},
    {"report", {"base", "signal", "model", "result", "estimates", "files", "drawing"}},
    {"run", {"base",       "ranks",     "numerics",  "mesh",     "law",       "model",       "checks",
             "interfaces", "partition", "step",      "marching", "reference", "persistence", "result",
             "watch",      "reduction", "recording", "files",    "drawing",   "report"}},
    {"deck",
     {"base", "ranks", "numerics", "mesh", "signal", "material", "law", "intake", "foreign", "model", "checks",
      "result", "estimates", "recording", "report", "run"}},
    {"app", {"base", "ranks", "signal", "foreign", "checks", "files", "report", "deck"}},
};

// Third-party headers that everybody may include; the others belong to one module.
const std::regex everybody("^((unsupported/)?Eigen/|spdlog/)");
const std::vector<std::pair<std::string, std::regex>> owners = {
    {"ranks", std::regex("^mpi\\.h$")},
    {"numerics", std::regex("^(cholmod|SuiteSparse|metis|cblas|lapack|openblas)[A-Za-z_]*\\.h$")},
    {"intake", std::regex("^nlohmann/")},
    {"mesher", std::regex("^(gmsh|seccomp\\.h$)")},
    {"files", std::regex("^(vtk|nlohmann/)")},
    {"drawing", std::regex("^nlohmann/")},
    {"report", std::regex("^nlohmann/")},
    {"deck", std::regex("^(lua|lualib|lauxlib)\\.(h|hpp)$")},
    {"app", std::regex("^CLI/")},
};

// The standard library's and the operating system's.
const std::regex system_header(
    "^[a-z_0-9]+$|^(stdlib|signal|fcntl|link|malloc|poll|sched|spawn|ucontext|unistd|linux/[a-z]+|sanitizer/[a-z_]+|"
    "sys/[a-z]+|[a-z]mmintrin)\\.h$");

bool is_owned_by(const std::string& module, const std::string& header) {
  return std::any_of(owners.begin(), owners.end(), [&](const auto& owner) {
    return owner.first == module && std::regex_search(header, owner.second);
  });
}

bool is_allowed(const std::string& module, const std::string& header) {
  if (std::regex_search(header, everybody) || std::regex_search(header, system_header)) return true;
  if (is_owned_by(module, header)) return true;
  const std::string from = header.substr(0, header.find('/'));
  return from == module || may_use.at(module).contains(from);
}

std::string without_block_comments(std::string text) {
  for (size_t open = text.find("/*"); open != std::string::npos; open = text.find("/*", open)) {
    const size_t close = std::min(text.find("*/", open + 2), text.size() - 2) + 2;
    std::replace_if(
        text.begin() + open, text.begin() + close, [](char c) { return c != '\n'; }, ' ');
  }
  return text;
}

}  // namespace

std::vector<std::string> violations(const std::string& module, const std::string& text) {
  static const std::regex include("^\\s*#\\s*include\\s*[\"<]([^\">]+)[\">]");
  std::vector<std::string> found;
  if (!may_use.contains(module)) return {"module '" + module + "' has no floor"};
  std::istringstream lines(without_block_comments(text));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::smatch match;
    if (!std::regex_search(line, match, include) || is_allowed(module, match[1])) continue;
    found.push_back("line " + std::to_string(number) + ": " + module + " may not include " + match[1].str());
  }
  return found;
}

std::vector<std::string> modules() {
  std::vector<std::string> names;
  for (const auto& [name, below] : may_use) names.push_back(name);
  return names;
}

std::set<std::string> below(const std::string& module) { return may_use.at(module); }

}  // namespace dygita::architecture
