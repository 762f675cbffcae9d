#include "report/part_groups.hpp"

#include <algorithm>
#include <cctype>
#include <map>

namespace dygita {

namespace {

// "upper" of "upper[3]"; empty where it is no name of a pattern.
std::string stem_of(const std::string& name) {
  const size_t open = name.rfind('[');
  if (open == std::string::npos || open + 2 >= name.size() || name.back() != ']') return "";
  const bool is_number = std::all_of(name.begin() + static_cast<long>(open) + 1, name.end() - 1,
                                     [](unsigned char c) { return std::isdigit(c) != 0; });
  return is_number ? name.substr(0, open) : "";
}

struct Grouping {
  std::vector<PartGroup> groups;
  std::vector<int> of_part;
};

Grouping grouping(const Json& parts) {
  Grouping result;
  std::map<std::vector<Json>, int> known;
  for (size_t i = 0; i < parts.size(); ++i) {
    const Json& part = parts[i];
    const std::string name = part.value("name", ""), stem = stem_of(name);
    const auto next = static_cast<int>(result.groups.size());
    int group = next;
    if (!stem.empty()) {
      std::vector<Json> key = {stem};
      for (const char* same : {"material", "nodes", "cells"}) key.push_back(part.value(same, Json()));
      group = known.emplace(key, next).first->second;
    }
    if (group == next) {
      result.groups.push_back({name, i});
    } else {
      PartGroup& of = result.groups[static_cast<size_t>(group)];
      ++of.n;
      of.name = parts[of.first].value("name", "") + " to " + name;
    }
    result.of_part.push_back(group);
  }
  return result;
}

}  // namespace

std::vector<PartGroup> part_groups(const Json& parts) { return grouping(parts).groups; }

std::vector<int> group_of_parts(const Json& parts) { return grouping(parts).of_part; }

}  // namespace dygita
