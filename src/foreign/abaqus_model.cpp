#include "foreign/abaqus_model.hpp"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

#include "base/error.hpp"
#include "base/names.hpp"
#include "foreign/abaqus_cells.hpp"

namespace dygita {

namespace {

// What generates or moves a mesh in ways that are not read: without it the mesh would be another.
const char* const generators[] = {"NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "IMPORT", "SUBMODEL.MESH"};

Vec3 vector_of(LineFields& fields) {
  const double x = fields.real("a coordinate"), y = fields.real("a coordinate"), z = fields.real("a coordinate");
  return {x, y, z};
}

// Where the coordinates of *NODE, SYSTEM = C or S are.
Vec3 cartesian(const std::string& system, const Vec3& x) {
  constexpr double degree = std::numbers::pi / 180;
  const double angle = x[1] * degree;
  if (system == "C") return {x[0] * std::cos(angle), x[0] * std::sin(angle), x[2]};
  const double up = x[2] * degree;
  return {x[0] * std::cos(up) * std::cos(angle), x[0] * std::cos(up) * std::sin(angle), x[0] * std::sin(up)};
}

// *SYSTEM: the origin, a point of axis 1, a point of the plane of axes 1 and 2.
std::function<Vec3(const Vec3&)> system_of(const CardFile& file, const FileCard& card) {
  if (card.data.empty()) return [](const Vec3& x) { return x; };
  LineFields fields(file, card.data[0]);
  const Vec3 origin = vector_of(fields);
  Mat3 axes = Mat3::Identity();
  if (!fields.is_at_end()) {
    const Vec3 one = vector_of(fields) - origin;
    Vec3 across = Vec3::UnitZ();
    if (card.data.size() > 1) {
      LineFields more(file, card.data[1]);
      across = one.cross(vector_of(more) - origin);
    }
    if (!(one.norm() > 0) || !(one.cross(across).norm() > 0))
      file.fail(card.data[0], "the points of a system lie on one line");
    axes.col(0) = one.normalized();
    axes.col(2) = across.normalized();
    axes.col(1) = axes.col(2).cross(axes.col(0));
  }
  return [=](const Vec3& x) -> Vec3 { return origin + axes * x; };
}

// *INSTANCE: moved first, then turned about a line by an angle in degrees.
std::function<Vec3(const Vec3&)> placement_of(const CardFile& file, const FileCard& card) {
  Vec3 shift = Vec3::Zero(), about = Vec3::Zero();
  Mat3 turn = Mat3::Identity();
  if (!card.data.empty()) {
    LineFields fields(file, card.data[0]);
    shift = vector_of(fields);
  }
  if (card.data.size() > 1) {
    LineFields fields(file, card.data[1]);
    about = vector_of(fields);
    const Vec3 axis = vector_of(fields) - about;
    const double angle = fields.real("an angle") * std::numbers::pi / 180;
    if (!(axis.norm() > 0)) file.fail(card.data[1], "the two points of the axis are one");
    turn = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  }
  return [=](const Vec3& x) -> Vec3 { return about + turn * (x + shift - about); };
}

// What the letters behind the name of a cell become.
std::string meaning_here(const std::string& type) {
  std::string meaning;
  const auto add = [&](const char* text) { meaning += (meaning.empty() ? "" : "; ") + std::string(text); };
  const std::string suffix = type.substr(type.find_last_of("0123456789") + 1);
  const auto has = [&](char letter) { return suffix.find(letter) != std::string::npos; };
  if (has('R')) add("full integration, reduced in the file");
  if (has('H')) add("displacements alone, hybrid in the file");
  if (has('M')) add("as they stand, modified in the file");
  if (type.starts_with("C3D8") && !has('I'))
    add("with incompatible modes (C3D8I), which the file's lack: softer in bending");
  return meaning;
}

std::string known_instances(const std::map<std::string, AbaqusScope>& scopes, const std::string& name) {
  std::vector<std::string> known;
  for (const auto& [key, scope] : scopes)
    if (!key.empty()) known.push_back(scope.instance);
  return did_you_mean(name, known);
}

}  // namespace

AbaqusModel::AbaqusModel(const AbaqusOptions& options) : options_(options), file_(options.file) {
  model_.file = options.file;
  model_.files = file_.files();
  for (std::string& type : options_.skip) type = in_capitals(type);
  place_cards();
  read_meshes();
  for (const PlacedCard& placed : placed_) {
    if (placed.card->keyword == "NSET") read_set(placed, &AbaqusScope::node_sets, "NSET");
    if (placed.card->keyword == "ELSET") read_set(placed, &AbaqusScope::cell_sets, "ELSET");
  }
  finish_sets();
  for (const PlacedCard& placed : placed_) {
    if (placed.card->keyword == "SURFACE") read_surface(placed);
    if (placed.card->keyword == "SOLIDSECTION") read_section(placed);
  }
  group_the_rest();
  name_groups();
  model_.materials = abaqus_materials(file_);
  list_unused();
}

AbaqusScope& AbaqusModel::scope_of(const PlacedCard& placed) {
  const std::string name = placed.card->option("INSTANCE");
  if (name.empty() || placed.card->keyword == "INSTANCE") return *placed.scope;
  const auto found = scopes_.find(in_capitals(name));
  if (found == scopes_.end())
    file_.fail(*placed.card, fmt::format("there is no instance '{}'\n    {}", name, known_instances(scopes_, name)));
  return found->second;
}

// Cards of a part count once for each of its instances.
void AbaqusModel::place_cards() {
  AbaqusScope& whole = scopes_[""];
  const std::vector<FileCard>& cards = file_.cards();
  std::map<std::string, std::vector<const FileCard*>> parts;
  for (size_t i = 0; i < cards.size(); ++i) {
    for (const char* generator : generators)
      if (cards[i].keyword == generator)
        file_.fail(cards[i],
                   "it makes nodes or elements that the file does not list\n    write the mesh out as *NODE "
                   "and *ELEMENT");
    if (cards[i].keyword == "PART") {
      std::vector<const FileCard*>& part = parts[in_capitals(cards[i].option("NAME"))];
      for (++i; i < cards.size() && cards[i].keyword != "ENDPART"; ++i) part.push_back(&cards[i]);
    } else if (cards[i].keyword == "INSTANCE") {
      place_instance(cards, i, parts);
    } else {
      placed_.push_back({&cards[i], &whole});
    }
  }
  if (!parts.empty() && places_.empty())
    throw InputError(fmt::format("mesh file '{}' has parts and no *INSTANCE of any of them", file_.file()));
}

void AbaqusModel::place_instance(const std::vector<FileCard>& cards, size_t& i,
                                 const std::map<std::string, std::vector<const FileCard*>>& parts) {
  const FileCard& card = cards[i];
  const std::string name = card.option("NAME"), part = card.option("PART");
  const auto found = parts.find(in_capitals(part));
  if (name.empty()) file_.fail(card, "NAME = ... is expected");
  if (found == parts.end() && !part.empty()) {
    std::vector<std::string> known;
    for (const auto& [one, its] : parts) known.push_back(one);
    file_.fail(card, fmt::format("there is no part '{}'\n    {}", part, did_you_mean(part, known)));
  }
  const auto [scope, is_new] = scopes_.try_emplace(in_capitals(name));
  if (!is_new) file_.fail(card, fmt::format("there is an instance '{}' already", name));
  scope->second.instance = name;
  places_[in_capitals(name)] = placement_of(file_, card);
  if (found != parts.end())
    for (const FileCard* of_part : found->second) placed_.push_back({of_part, &scope->second});
  for (++i; i < cards.size() && cards[i].keyword != "ENDINSTANCE"; ++i) placed_.push_back({&cards[i], &scope->second});
}

void AbaqusModel::read_meshes() {
  std::map<const AbaqusScope*, Place> systems;
  for (const PlacedCard& placed : placed_) {
    if (placed.card->keyword == "SYSTEM") systems[placed.scope] = system_of(file_, *placed.card);
    if (placed.card->keyword == "NODE") read_nodes(placed, systems[placed.scope]);
  }
  for (const PlacedCard& placed : placed_)
    if (placed.card->keyword == "ELEMENT") read_elements(placed);
  if (model_.cells.empty()) {
    std::string left_out;
    for (const auto& [type, n] : n_left_out_) left_out += fmt::format(" {} of type {} are left out.", n, type);
    throw InputError(fmt::format("mesh file '{}' has no element that is a cell here ({}).{}", file_.file(),
                                 abaqus_cell_names(), left_out));
  }
  for (const auto& [type, n] : n_left_out_)
    model_.told.push_back(fmt::format("{} elements of type {} are no cells here and are left out", n, type));
  for (const auto& [type, n] : n_by_type_)
    if (const std::string meaning = meaning_here(type); !meaning.empty())
      model_.told.push_back(fmt::format("{} elements of type {}: {}", n, type, meaning));
}

void AbaqusModel::read_nodes(const PlacedCard& placed, const Place& system) {
  const std::string kind = in_capitals(placed.card->option("SYSTEM")), set = placed.card->option("NSET");
  if (!kind.empty() && kind != "R" && kind != "C" && kind != "S")
    file_.fail(*placed.card, fmt::format("SYSTEM = {}: R, C and S are known", printable(kind)));
  const auto instance = places_.find(in_capitals(placed.scope->instance));
  AbaqusSet* named = set.empty() ? nullptr : &placed.scope->node_sets[in_capitals(set)];
  if (named && named->name.empty()) named->name = set;
  for (const DataLine& line : placed.card->data) {
    LineFields fields(file_, line);
    const long number = fields.whole("the number of a node");
    Vec3 x{fields.real_or(0.0), fields.real_or(0.0), fields.real_or(0.0)};
    if (!kind.empty() && kind != "R") x = cartesian(kind, x);
    if (system) x = system(x);
    if (instance != places_.end()) x = instance->second(x);
    x *= options_.unit;
    const auto [known, is_new] = placed.scope->nodes.emplace(number, static_cast<int>(model_.nodes.size()));
    if (is_new)
      model_.nodes.push_back(x);
    else if (model_.nodes[static_cast<size_t>(known->second)] != x)
      file_.fail(line, fmt::format("node {} is given twice, at two places", number));
    if (named) named->items.push_back(known->second);
  }
}

bool AbaqusModel::is_left_out(const PlacedCard& placed, const std::string& type) {
  const auto& skip = options_.skip;
  if (!is_between_points(type) && std::find(skip.begin(), skip.end(), type) == skip.end()) return false;
  if (const std::string set = placed.card->option("ELSET"); !set.empty())
    placed.scope->cell_sets.try_emplace(in_capitals(set), AbaqusSet{set, {}});
  for (const DataLine& line : placed.card->data) {
    // Numbers of further lines of one element do no harm: they name no cell either.
    LineFields fields(file_, line);
    if (std::string_view number; fields.next(number) && is_whole(number))
      placed.scope->cells.emplace(fields.whole_of(number, "a number"), -1);
    ++n_left_out_[type];
  }
  return true;
}

void AbaqusModel::read_elements(const PlacedCard& placed) {
  const FileCard& card = *placed.card;
  const std::string type = in_capitals(card.option("TYPE")), set = card.option("ELSET");
  std::string suffix;
  const AbaqusCell* cell = abaqus_cell(type, suffix);
  if (!cell && is_left_out(placed, type)) return;
  if (!cell)
    file_.fail(card, fmt::format("elements of type '{}' are no cells here: {} are, with R, I, H or M behind them\n"
                                 "    skip = {{ \"{}\" }} leaves them out",
                                 printable(type), abaqus_cell_names(), printable(type)));
  element_sets_.emplace_back(placed.scope, set);
  const size_t n_before = model_.cells.size(), n_fields = cell->order.size() + 1;
  std::vector<long> numbers;
  const DataLine* first = nullptr;
  for (const DataLine& line : card.data) {
    if (numbers.empty()) first = &line;
    LineFields fields(file_, line);
    for (std::string_view field; fields.next(field);)
      numbers.push_back(fields.whole_of(field, numbers.empty() ? "the number of an element" : "the number of a node"));
    if (numbers.size() > n_fields)
      file_.fail(line, fmt::format("element {} has more than the {} nodes of a {}", numbers[0], n_fields - 1, type));
    if (numbers.size() < n_fields) continue;
    add_cell(placed, *cell, numbers, *first);
    numbers.clear();
  }
  if (!numbers.empty())
    file_.fail(*first, fmt::format("element {} has {} nodes, and not the {} of a {}", numbers[0], numbers.size() - 1,
                                   n_fields - 1, type));
  n_by_type_[type] += static_cast<int>(model_.cells.size() - n_before);
  if (set.empty()) return;
  AbaqusSet& named = placed.scope->cell_sets[in_capitals(set)];
  if (named.name.empty()) named.name = set;
  for (size_t c = n_before; c < model_.cells.size(); ++c) named.items.push_back(static_cast<int>(c));
}

void AbaqusModel::add_cell(const PlacedCard& placed, const AbaqusCell& cell, const std::vector<long>& numbers,
                           const DataLine& first) {
  if (!placed.scope->cells.emplace(numbers[0], static_cast<int>(model_.cells.size())).second)
    file_.fail(first, fmt::format("element {} is given twice", numbers[0]));
  model_.cells.push_back(
      {cell.type, static_cast<int>(model_.connectivity.size()), -1, first.file, first.line, numbers[0]});
  element_set_of_cell_.push_back(static_cast<int>(element_sets_.size()) - 1);
  for (const int a : cell.order) {
    const long number = numbers[static_cast<size_t>(a) + 1];
    const auto node = placed.scope->nodes.find(number);
    if (node == placed.scope->nodes.end())
      file_.fail(first, fmt::format("element {} has node {}, which the file does not give", numbers[0], number));
    model_.connectivity.push_back(node->second);
  }
}

}  // namespace dygita
