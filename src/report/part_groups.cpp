#include "report/part_groups.hpp"

#include <algorithm>
#include <cctype>
#include <map>

#include "base/log.hpp"

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

// "screw #" of "screw 3"; empty where the name has no number.
std::string numbered_stem(const std::string& name) {
  std::string stem;
  bool has_number = false;
  for (const char c : name) {
    const bool is_digit = std::isdigit(static_cast<unsigned char>(c)) != 0;
    if (!is_digit || stem.empty() || stem.back() != '#') stem += is_digit ? '#' : c;
    has_number |= is_digit;
  }
  return has_number ? stem : "";
}

using Key = std::vector<Json>;

Key key_of(const Json& part, const std::string& stem) {
  Key key = {stem};
  for (const char* same : {"material", "nodes", "cells"}) key.push_back(part.value(same, Json()));
  key.push_back(fmt::format("{:.5g}", part.value("mass", 0.0)));
  return key;
}

// Names that differ by numbers alone, where there are several of one kind.
std::map<Key, size_t> count_of_numbered(const Json& parts) {
  std::map<Key, size_t> count;
  for (const Json& part : parts) ++count[key_of(part, numbered_stem(part.value("name", "")))];
  return count;
}

struct Grouping {
  std::vector<PartGroup> groups;
  std::vector<int> of_part;
};

Grouping grouping(const Json& parts) {
  constexpr size_t several = 3;
  Grouping result;
  std::map<Key, int> known;
  const std::map<Key, size_t> count = count_of_numbered(parts);
  for (size_t i = 0; i < parts.size(); ++i) {
    const Json& part = parts[i];
    const std::string name = part.value("name", ""), numbered = numbered_stem(name);
    const bool is_one_of_several = !numbered.empty() && count.at(key_of(part, numbered)) >= several;
    const std::string stem = is_one_of_several ? numbered : stem_of(name);
    const auto next = static_cast<int>(result.groups.size());
    int group = next;
    if (!stem.empty()) group = known.emplace(key_of(part, stem), next).first->second;
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
