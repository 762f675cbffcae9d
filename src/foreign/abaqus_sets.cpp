// Sets, surfaces and sections of an .inp.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <set>

#include "base/error.hpp"
#include "base/names.hpp"
#include "foreign/abaqus_cells.hpp"
#include "foreign/abaqus_model.hpp"

namespace dygita {

namespace {

// What the reader of meshes uses, and what says nothing of the structure.
const std::set<std::string> used = {"NODE",         "ELEMENT",  "NSET",        "ELSET",       "SURFACE",
                                    "SOLIDSECTION", "MATERIAL", "ELASTIC",     "DENSITY",     "DAMPING",
                                    "PART",         "ENDPART",  "INSTANCE",    "ENDINSTANCE", "SYSTEM",
                                    "ASSEMBLY",     "HEADING",  "ENDASSEMBLY", "PREPRINT",    "END"};

void sort_once(std::vector<int>& items) {
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

std::vector<std::string> names_of(const std::map<std::string, AbaqusSet>& sets) {
  std::vector<std::string> names;
  for (const auto& [key, set] : sets) names.push_back(set.name);
  return names;
}

// Corners of face k of the cell, in the file's numbering of faces.
ForeignFacet facet_by_number(const ForeignModel& model, int cell, const std::vector<int>& corners) {
  ForeignFacet facet{cell, {-1, -1, -1, -1}};
  const int* nodes = model.nodes_of(model.cells[static_cast<size_t>(cell)]);
  for (size_t a = 0; a < corners.size(); ++a) facet.corners[a] = nodes[corners[a]];
  return facet;
}

}  // namespace

std::vector<int> AbaqusModel::found(const AbaqusScope& scope, const LineFields& fields, std::string_view field,
                                    bool is_node) const {
  const auto& numbers = is_node ? scope.nodes : scope.cells;
  const auto& sets = is_node ? scope.node_sets : scope.cell_sets;
  if (is_whole(field)) {
    const auto item = numbers.find(fields.whole_of(field, "a number"));
    if (item != numbers.end()) return item->second < 0 ? std::vector<int>{} : std::vector<int>{item->second};
    fields.fail(fmt::format("there is no {} {}", is_node ? "node" : "element", field));
  }
  std::string name(field);
  name.erase(std::remove(name.begin(), name.end(), '"'), name.end());
  const auto set = sets.find(in_capitals(name));
  if (set != sets.end()) return set->second.items;
  const size_t dot = name.find('.');
  const auto instance = dot == std::string::npos ? scopes_.end() : scopes_.find(in_capitals(name.substr(0, dot)));
  if (instance != scopes_.end() && &instance->second != &scope)
    return found(instance->second, fields, std::string_view(name).substr(dot + 1), is_node);
  fields.fail(fmt::format("there is no {} of {} '{}'\n    {}", is_node ? "*NSET" : "*ELSET",
                          is_node ? "nodes" : "elements", printable(name), did_you_mean(name, names_of(sets))));
}

std::vector<int> AbaqusModel::nodes_of(const AbaqusScope& scope, const LineFields& fields,
                                       std::string_view field) const {
  return found(scope, fields, field, true);
}

std::vector<int> AbaqusModel::cells_of(const AbaqusScope& scope, const LineFields& fields,
                                       std::string_view field) const {
  return found(scope, fields, field, false);
}

void AbaqusModel::read_range(const PlacedCard& placed, const DataLine& line, Kind kind, std::vector<int>& items) {
  LineFields fields(file_, line);
  const AbaqusScope& scope = scope_of(placed);
  const auto& numbers = kind == &AbaqusScope::node_sets ? scope.nodes : scope.cells;
  const long first = fields.whole("the first number"), last = fields.whole("the last number");
  const auto by = static_cast<long>(fields.real_or(1.0));
  if (by < 1 || last < first || first < 0)
    file_.fail(line, fmt::format("from {} to {} by {} is no range of numbers", first, last, by));
  if ((last - first) / by > static_cast<long>(numbers.size())) {  // a wide range of few numbers
    for (const auto& [number, item] : numbers)
      if (item >= 0 && number >= first && number <= last && (number - first) % by == 0) items.push_back(item);
    return;
  }
  for (long number = first; number <= last; number += by)
    if (const auto item = numbers.find(number); item != numbers.end() && item->second >= 0)
      items.push_back(item->second);
}

void AbaqusModel::read_set(const PlacedCard& placed, Kind kind, const char* option) {
  const FileCard& card = *placed.card;
  const std::string name = card.option(option);
  if (name.empty()) file_.fail(card, fmt::format("{} = NAME is expected", option));
  const bool is_node = kind == &AbaqusScope::node_sets;
  const AbaqusScope& scope = scope_of(placed);
  std::vector<int> items;
  if (is_node && card.has("ELSET")) file_.fail(card, "a set of the nodes of elements is not read: list the nodes");
  for (const DataLine& line : card.data) {
    if (card.has("GENERATE")) {
      read_range(placed, line, kind, items);
      continue;
    }
    LineFields fields(file_, line);
    for (std::string_view field; fields.next(field);) {
      if (field.empty()) continue;
      const std::vector<int> more = is_node ? nodes_of(scope, fields, field) : cells_of(scope, fields, field);
      items.insert(items.end(), more.begin(), more.end());
    }
  }
  AbaqusSet& set = (placed.scope->*kind)[in_capitals(name)];
  if (set.name.empty()) set.name = name;
  set.items.insert(set.items.end(), items.begin(), items.end());
  sort_once(set.items);  // what is nested several times stays as large as it is
}

void AbaqusModel::finish_sets() {
  for (auto& [key, scope] : scopes_) {
    for (auto& [name, set] : scope.cell_sets) sort_once(set.items);
    for (auto& [name, set] : scope.node_sets) sort_once(set.items);
  }
  // The assembly's first: of one name, they count.
  for (const auto& [key, scope] : scopes_)
    for (const auto& [name, set] : scope.node_sets) model_.node_sets.push_back({set.name, set.items});
}

std::vector<ForeignFacet> AbaqusModel::facets_of(const std::vector<int>& cells, std::string_view label,
                                                 const DataLine& line) const {
  std::vector<ForeignFacet> facets;
  if (!label.empty()) {
    const std::string_view digits = label.substr(1);
    const int k = is_whole(digits) && digits.size() == 1 ? digits[0] - '1' : -1;
    for (const int cell : cells) {
      const auto& faces = abaqus_cell_of(model_.cells[static_cast<size_t>(cell)].type).faces;
      if (k < 0 || k >= static_cast<int>(faces.size()))
        file_.fail(line, fmt::format("'{}' is no face of element {}: it has {}1 to {}{}", printable(std::string(label)),
                                     model_.cells[static_cast<size_t>(cell)].number, label[0], label[0], faces.size()));
      facets.push_back(facet_by_number(model_, cell, faces[static_cast<size_t>(k)]));
    }
    return facets;
  }
  std::map<std::array<int, 4>, std::pair<ForeignFacet, int>> times;
  for (const int cell : cells)
    for (const auto& corners : abaqus_cell_of(model_.cells[static_cast<size_t>(cell)].type).faces) {
      const ForeignFacet facet = facet_by_number(model_, cell, corners);
      std::array<int, 4> key = facet.corners;
      std::sort(key.begin(), key.end());
      ++times.try_emplace(key, facet, 0).first->second.second;
    }
  for (const auto& [key, facet] : times)
    if (facet.second == 1) facets.push_back(facet.first);
  return facets;
}

void AbaqusModel::read_surface(const PlacedCard& placed) {
  const FileCard& card = *placed.card;
  const std::string name = card.option("NAME"), type = in_capitals(card.option("TYPE"));
  if (name.empty()) file_.fail(card, "NAME = ... is expected");
  if (type != "NODE" && type != "ELEMENT" && !type.empty()) {
    model_.told.push_back(fmt::format("{}: surface '{}' of type {} is not used", file_.where(card), name, type));
    return;
  }
  const AbaqusScope& scope = scope_of(placed);
  ForeignFace surface{name, {}, file_.where(card)};
  ForeignSet of_nodes{name, {}};
  for (const DataLine& line : card.data) {
    LineFields fields(file_, line);
    std::string_view what, label;
    if (!fields.next(what) || what.empty()) file_.fail(line, "the number or the set of elements or nodes is expected");
    if (type == "NODE") {
      const std::vector<int> nodes = nodes_of(scope, fields, what);
      of_nodes.nodes.insert(of_nodes.nodes.end(), nodes.begin(), nodes.end());
      continue;
    }
    fields.next(label);
    if (!label.empty() && label.front() != 'S' && label.front() != 's')
      file_.fail(line, fmt::format("a face S1 ... S6 is expected, not '{}'", printable(std::string(label))));
    const std::vector<ForeignFacet> facets = facets_of(cells_of(scope, fields, what), label, line);
    surface.facets.insert(surface.facets.end(), facets.begin(), facets.end());
  }
  if (type != "NODE") return model_.surfaces.push_back(std::move(surface));
  sort_once(of_nodes.nodes);
  model_.node_sets.push_back(std::move(of_nodes));
}

void AbaqusModel::read_section(const PlacedCard& placed) {
  const FileCard& card = *placed.card;
  const std::string name = card.option("ELSET");
  if (name.empty()) file_.fail(card, "ELSET = NAME is expected");
  const LineFields at(file_, {name, card.file, card.line});
  const auto g = static_cast<int>(model_.groups.size());
  model_.groups.push_back({name, card.option("MATERIAL"), card.option("ORIENTATION"), placed.scope->instance});
  int n_others = 0;
  for (const int cell : cells_of(scope_of(placed), at, name)) {
    int& group = model_.cells[static_cast<size_t>(cell)].group;
    n_others += group >= 0;
    group = g;
  }
  if (n_others > 0)
    model_.told.push_back(
        fmt::format("{}: {} cells of '{}' have a section already: this one counts", file_.where(card), n_others, name));
}

// Cells without a section, by the set in which they are declared.
void AbaqusModel::group_the_rest() {
  std::map<std::pair<const AbaqusScope*, std::string>, int> group_of;
  int n_cells = 0;
  for (size_t c = 0; c < model_.cells.size(); ++c) {
    if (model_.cells[c].group >= 0) continue;
    const auto& [scope, set] = element_sets_[static_cast<size_t>(element_set_of_cell_[c])];
    const auto [group, is_new] =
        group_of.try_emplace({scope, in_capitals(set)}, static_cast<int>(model_.groups.size()));
    if (is_new) model_.groups.push_back({set.empty() ? "cells" : set, "", "", scope->instance});
    model_.cells[c].group = group->second;
    ++n_cells;
  }
  if (n_cells > 0) model_.told.push_back(fmt::format("{} cells have no *SOLID SECTION, so no material", n_cells));
}

// The only part of an instance has its name, others "instance.set".
void AbaqusModel::name_groups() {
  std::map<std::string, std::set<int>> of_instance;
  for (const ForeignCell& cell : model_.cells)
    of_instance[model_.groups[static_cast<size_t>(cell.group)].instance].insert(cell.group);
  for (const auto& [instance, groups] : of_instance)
    for (const int g : groups)
      if (ForeignGroup& group = model_.groups[static_cast<size_t>(g)]; !instance.empty())
        group.name = groups.size() == 1 ? instance : instance + "." + group.name;
}

void AbaqusModel::list_unused() {
  std::map<std::string, std::vector<const FileCard*>> others;
  for (const FileCard& card : file_.cards())
    if (!used.contains(card.keyword)) others[card.keyword].push_back(&card);
  for (const auto& [keyword, cards] : others) {
    std::vector<std::string> places;
    for (const FileCard* card : cards) places.push_back(file_.where(*card));
    model_.unused.push_back(fmt::format("{}: {}", cards[0]->written, few_of(places)));
  }
}

}  // namespace dygita
