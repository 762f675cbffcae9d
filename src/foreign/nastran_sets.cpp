// Sets of a Nastran file: of its case control and of its bulk data (SET1, SET3, OptiStruct's SET).
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <set>

#include "base/error.hpp"
#include "base/names.hpp"
#include "foreign/cards.hpp"
#include "foreign/nastran_model.hpp"

namespace dygita {

namespace {

enum class SetKind { nodes, elements, numbers };

// Numbers of "1, 4 THRU 9 EXCEPT 7, 12"; false where it lists something else.
bool control_numbers(std::string text, std::set<long>& numbers, std::vector<std::array<long, 3>>& ranges) {
  std::replace(text.begin(), text.end(), ',', ' ');
  std::vector<std::string> words;
  for (size_t at = 0; at < text.size();) {
    const size_t begin = text.find_first_not_of(" \t", at);
    if (begin == std::string::npos) break;
    at = std::min(text.find_first_of(" \t", begin), text.size());
    words.push_back(text.substr(begin, at - begin));
  }
  constexpr size_t most_digits = 9;
  const auto number = [&](size_t i) {
    return i < words.size() && is_whole(words[i]) && words[i].size() <= most_digits ? std::stol(words[i]) : -1;
  };
  for (size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "EXCEPT") {
      if (ranges.empty()) return false;
      for (++i; number(i) >= 0 && number(i) <= ranges.back()[1]; ++i) numbers.insert(number(i));  // not meant
      --i;
      continue;
    }
    const long from = number(i);
    if (from < 0) return false;
    long to = from;
    if (i + 1 < words.size() && words[i + 1] == "THRU") {
      to = number(i + 2);
      i += 2;
    }
    if (to < from) return false;
    ranges.push_back({from, to, 1});
  }
  return true;
}

bool asks(const std::string& text, std::initializer_list<const char*> words) {
  return std::any_of(words.begin(), words.end(), [&](const char* word) { return text.starts_with(word); });
}

// What the case control asks for with the set, as DISP = 3 or STRESS(PLOT) = 3.
SetKind kind_of(const std::vector<ControlLine>& control, long number) {
  for (const ControlLine& line : control) {
    const size_t equals = line.text.find('=');
    if (equals == std::string::npos || line.text.starts_with("SET")) continue;
    if (without_blanks_around(std::string_view(line.text).substr(equals + 1)) != std::to_string(number)) continue;
    if (asks(line.text, {"DISP", "VELO", "ACCE", "SPCF", "MPCF", "OLOAD", "GPF", "PRES", "VECT", "SVECT", "SDISP"}))
      return SetKind::nodes;
    if (asks(line.text, {"STRE", "STRA", "FORC", "ELFO", "ELST", "ESE", "EKE", "EDE", "GPSTRE", "GPSTRA"}))
      return SetKind::elements;
    if (asks(line.text, {"OFREQ", "OTIME", "OMODES"})) return SetKind::numbers;
  }
  return SetKind::nodes;
}

}  // namespace

void NastranModel::add_range(const std::array<long, 3>& range, std::vector<int>& nodes) const {
  const auto [from, to, by] = range;
  if ((to - from) / by <= static_cast<long>(places_.grids().size())) {
    for (long number = from; number <= to; number += by)
      if (const int index = places_.index_of(number); index >= 0) nodes.push_back(index);
    return;
  }
  for (size_t i = 0; i < places_.grids().size(); ++i)  // a wide range of few numbers
    if (const long number = places_.grids()[i].number; number >= from && number <= to && (number - from) % by == 0)
      nodes.push_back(static_cast<int>(i));
}

std::vector<int> NastranModel::nodes(const std::vector<std::array<long, 3>>& ranges, const BulkFields& asked) const {
  std::vector<int> nodes;
  for (const auto& range : ranges)
    if (range[0] == range[1])
      nodes.push_back(node(range[0], asked));
    else
      add_range(range, nodes);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

void NastranModel::add_set(long number, const std::vector<std::array<long, 3>>& ranges, const BulkFields& asked) {
  std::vector<std::string> taken;
  for (const ForeignSet& set : model_.node_sets) taken.push_back(set.name);
  model_.node_sets.push_back({unique_name(names_.sets, number, "SET", taken), nodes(ranges, asked)});
}

void NastranModel::read_sets() {
  for (const BulkCard& card : file_.cards()) {
    const BulkFields fields(file_, card);
    constexpr int beside_options = 9;  // of OptiStruct's SET, its numbers begin a line
    const bool is_nodes_alone = card.name == "SET1";
    if (!is_nodes_alone && card.name != "SET3" && card.name != "SET") continue;
    const long number = fields.whole(1, "the number of a set");
    const std::string kind = is_nodes_alone ? "GRID" : fields.word(2);
    if (kind != "GRID" && kind != "POINT") {
      model_.told.push_back(fmt::format("{}: {} {} is not used: a set of {}", file_.where(card), card.name, number,
                                        kind.empty() ? "nothing that is named" : printable(kind)));
      continue;
    }
    const bool has_flag = is_nodes_alone && fields.word(2) == "SKIN";
    add_set(number,
            fields.ranges_from(card.name == "SET"            ? beside_options
                               : is_nodes_alone && !has_flag ? 2
                                                             : 3,
                               "a node"),
            fields);
  }
  for (const ControlLine& line : control_)
    if (line.text.starts_with("SET ") || line.text.starts_with("SET\t")) read_control_set(line);
}

void NastranModel::read_control_set(const ControlLine& line) {
  const size_t equals = line.text.find('=');
  const std::string_view given = without_blanks_around(std::string_view(line.text).substr(3, equals - 3));
  constexpr size_t most_digits = 9;
  if (equals == std::string::npos || !is_whole(given) || given.size() > most_digits) return;
  const long number = std::stol(std::string(given));
  const auto known = names_.kinds_of_sets.find(number);
  const SetKind kind = known == names_.kinds_of_sets.end() ? kind_of(control_, number)
                       : known->second == 1                ? SetKind::nodes
                                                           : SetKind::elements;
  std::set<long> without;
  std::vector<std::array<long, 3>> ranges;
  const bool is_list = control_numbers(line.text.substr(equals + 1), without, ranges);
  if (kind != SetKind::nodes || !is_list) {
    model_.told.push_back(fmt::format("{}: SET {} is not used: {}", line.where, number,
                                      kind == SetKind::elements ? "a set of elements" : "no list of nodes"));
    return;
  }
  std::vector<int> found;
  bool has_missing = false;
  for (const auto& range : ranges) {
    add_range(range, found);
    has_missing = has_missing || (range[0] == range[1] && places_.index_of(range[0]) < 0);
  }
  std::erase_if(found, [&](int i) { return without.contains(places_.grids()[static_cast<size_t>(i)].number); });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  if (has_missing) model_.told.push_back(fmt::format("{}: SET {} lists numbers that no node has", line.where, number));
  if (found.empty()) return;
  std::vector<std::string> taken;
  for (const ForeignSet& set : model_.node_sets) taken.push_back(set.name);
  model_.node_sets.push_back({unique_name(names_.sets, number, "SET", taken), std::move(found)});
}

}  // namespace dygita
