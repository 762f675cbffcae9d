#include "foreign/imported_deck.hpp"

#include <algorithm>
#include <filesystem>

#include "base/error.hpp"
#include "base/names.hpp"
#include "foreign/cards.hpp"
#include "foreign/lua_text.hpp"

namespace dygita {

namespace {

// Without a frame where its axes are those of the file in another order.
FileSpring plain(FileSpring spring) {
  const Mat3 size = spring.axes.cwiseAbs();
  constexpr double rounding = 1e-9;
  if ((size * size.transpose() - Mat3::Identity()).norm() > rounding) return spring;
  for (std::array<double, 6>* values : {&spring.stiffness, &spring.damping}) {
    Eigen::Map<Eigen::Matrix<double, 3, 2>> of(values->data());
    of = (size * of).eval();
  }
  spring.axes = Mat3::Identity();
  return spring;
}

// The cells of a part on both sides of a surface inside it.
std::array<ForeignPart, 2> halves_of(const ForeignPart& part, const std::string& surface) {
  const MeshCut cut = cut_along(*part.mesh, part.inner_surfaces.at(surface), "cut");
  std::array<ForeignPart, 2> halves = {part, part};
  for (size_t i = 0; i < 2; ++i) {
    ForeignPart& half = halves[i];
    half.name = fmt::format("{} {}", part.name, i + 1);
    half.mesh = cut.halves[i].mesh;
    half.cut_from = part.name;
    half.cut_by = surface;
    half.is_second = i == 1;
    half.regions = regions_of_half(part.regions, cut.halves[i]);
    half.file_nodes.clear();
    for (const int node : cut.halves[i].nodes) half.file_nodes.push_back(part.file_nodes[static_cast<size_t>(node)]);
  }
  return halves;
}

using Kind = FileAction::Kind;
constexpr double density_of_steel = 7850;  // kg/m^3, where the file gives none and only statics are asked for
constexpr const char* axis_names = "xyz";

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return printable(text);
}

// Of an instance "I1", or one of its pieces "I1[2]".
bool is_of(const ForeignPart& part, const std::string& instance) {
  return in_capitals(part.name.substr(0, part.name.find('['))) == in_capitals(instance);
}

}  // namespace

ImportedDeck::ImportedDeck(const ImportOptions& options, ForeignModel& model, const char* word)
    : options_(options), model_(model), parts_(parts_of(model)), units_(file_units(options.units)), word_(word) {
  for (size_t i = 0; i < model.node_sets.size(); ++i) numbers_of_sets_.emplace(model.node_sets[i].name, i);
}

void ImportedDeck::leave(const std::string& what) { untranslated_.push_back(what); }

std::string ImportedDeck::head() const {
  const std::string name = std::filesystem::path(options_.file).filename().string();
  std::string text = fmt::format(
      "-- What {} says, written by `dygita import`; numbers behind the file's name are its "
      "lines.\n-- The file states no units. These are they, in SI: change all together if the file has others.\n",
      printable(name));
  text += fmt::format("local units = {}\nlocal length, force, pressure, acceleration, time = {}, {}, {}, {}, {}\n\n",
                      lua_quoted(options_.units), lua_number(units_.length), lua_number(units_.force()),
                      lua_number(units_.stress()), lua_number(units_.acceleration()), lua_number(units_.time));
  for (const std::string& line : model_.told) text += "-- " + one_line(line) + "\n";
  for (const std::string& line : remarks_) text += "-- " + one_line(line) + "\n";
  for (const std::string& line : untranslated_) text += "-- NOT TRANSLATED: " + one_line(line) + "\n";
  if (!untranslated_.empty())
    text += fmt::format("error({}, 0)\n",
                        lua_quoted(fmt::format("{0} of {2} {1} not translated: read the comments, complete the deck, "
                                               "then delete this line",
                                               untranslated_.size() == 1 ? "one line" : "some lines",
                                               untranslated_.size() == 1 ? "is" : "are", name)));
  return text + "\n";
}

std::string ImportedDeck::material_of(const ForeignGroup& group, bool needs_density) {
  const auto& all = model_.materials;
  const auto found = std::find_if(all.begin(), all.end(), [&](const ForeignMaterial& one) {
    return in_capitals(one.name) == in_capitals(group.material);
  });
  if (found == all.end()) {
    leave(fmt::format("part '{}' has no material", group.name));
    return "nil";
  }
  if (const auto known = materials_.find(found->name); known != materials_.end()) return known->second;
  const std::string name = materials_[found->name] = names_.of("material", found->name);
  if (!found->doubt.empty()) leave(fmt::format("{}: material '{}': {}", found->where, found->name, found->doubt));
  if (found->density) {
    put("local {} = file:material {}  -- {}", name, lua_quoted(found->name), found->where);
  } else {
    if (needs_density) leave(fmt::format("{}: material '{}' has no {}", found->where, found->name, model_.density));
    put("local {} = file:material{{ name = {}, density = {} }}  -- {}: no {}; statics do not depend on it", name,
        lua_quoted(found->name), density_of_steel, found->where, model_.density);
  }
  is_directed_[name] = found->word == "orthotropic";
  return name;
}

void ImportedDeck::cut_parts(const std::vector<std::string>& surfaces) {
  surfaces_to_tighten_ = surfaces;
  for (const std::string& surface : surfaces) {
    std::vector<ForeignPart> parts;
    for (ForeignPart& part : parts_) {
      const auto inner = part.inner_surfaces.find(surface);
      if (inner == part.inner_surfaces.end() || !part.cut_from.empty()) {
        parts.push_back(std::move(part));
        continue;
      }
      try {
        for (ForeignPart& half : halves_of(part, surface)) parts.push_back(std::move(half));
      } catch (const InputError& error) {
        leave(fmt::format("*PRE-TENSION SECTION of surface '{}' in part '{}': {}", surface, part.name, error.what()));
        parts.push_back(std::move(part));
      }
    }
    parts_ = std::move(parts);
  }
}

void ImportedDeck::write_parts(bool needs_density) {
  std::string skip;
  for (const std::string& type : options_.skip) skip += (skip.empty() ? "" : ", ") + lua_quoted(type);
  put("local file = {}{{ file = {}, units = units{} }}", word_, lua_quoted(options_.file),
      skip.empty() ? "" : ", skip = { " + skip + " }");
  for (const ForeignPart& part : parts_) {
    const ForeignGroup& group = model_.groups[static_cast<size_t>(part.group)];
    const std::string material = material_of(group, needs_density), name = names_.of("part", part.name);
    put("local {} = substructure{{ name = {}, mesh = {}, material = {}{} }}", name, lua_quoted(deck_name_of(part.name)),
        mesh_of(part), material, is_directed_[material] ? orientation_of(group) : "");
    part_names_.push_back(name);
  }
}

std::string ImportedDeck::mesh_of(const ForeignPart& part) {
  if (part.cut_from.empty()) return "file:part " + lua_quoted(part.name);
  if (!part.is_second) {
    halves_ = names_.of("halves", part.cut_from);
    put("local {} = file:part {} :cut {}", halves_, lua_quoted(part.cut_from), lua_quoted(part.cut_by));
  }
  return fmt::format("{}[{}]", halves_, part.is_second ? 2 : 1);
}

void ImportedDeck::write_welds() {
  for (size_t i = 0; i < parts_.size(); ++i)
    for (size_t j = 0; j < i; ++j) {
      if (parts_[i].is_second && j + 1 == i) {
        const std::string name = names_.of("bolt", parts_[i].cut_from);
        put("local {} = interface.bonded{{ name = {}, between = {{ {}:face \"cut\", {}:face \"cut\" }} }}", name,
            lua_quoted(name), part_names_[j], part_names_[i]);
        interfaces_.push_back(tightened_[parts_[i].cut_by] = name);
        continue;
      }
      const auto [n_nodes, n_facets] = shared(parts_[j], parts_[i]);
      if (n_nodes == 0) continue;
      if (n_facets == 0) {
        leave(fmt::format("parts '{}' and '{}' share {} nodes and no facet", parts_[j].name, parts_[i].name, n_nodes));
        continue;
      }
      const std::string name = names_.of("weld", fmt::format("{}_{}", j + 1, i + 1));
      put("local {} = interface.bonded{{ name = {}, between = {{ {}, {} }} }}  -- they share {} nodes", name,
          lua_quoted(name), part_names_[j], part_names_[i], n_nodes);
      for (const ForeignPart* part : {&parts_[j], &parts_[i]}) note_tightened(*part, n_facets, name);
      interfaces_.push_back(name);
    }
}

// Does a surface that is tightened have all facets by which a part is welded to another?
void ImportedDeck::note_tightened(const ForeignPart& part, int n_facets, const std::string& weld) {
  for (const std::string& surface : surfaces_to_tighten_)
    if (const auto face = part.mesh->faces.find(surface);
        face != part.mesh->faces.end() && static_cast<int>(face->second.size()) == n_facets)
      tightened_[surface] = weld;
}

std::pair<size_t, int> ImportedDeck::shared(const ForeignPart& one, const ForeignPart& other) const {
  std::vector<int> common;
  std::set_intersection(one.file_nodes.begin(), one.file_nodes.end(), other.file_nodes.begin(), other.file_nodes.end(),
                        std::back_inserter(common));
  if (common.empty()) return {0, 0};
  int n_facets = 0;
  for (const Facet& facet : boundary_facets(one.mesh->blocks))
    n_facets += std::all_of(facet.corners().begin(), facet.corners().end(), [&](int node) {
      return std::binary_search(common.begin(), common.end(), one.file_nodes[static_cast<size_t>(node)]);
    });
  return {common.size(), n_facets};
}

std::vector<std::string> ImportedDeck::places(const std::string& given, bool is_face) const {
  std::vector<std::string> found;
  const size_t dot = given.find('.');
  const std::string instance = dot == std::string::npos ? "" : given.substr(0, dot);
  const bool is_of_one =
      std::any_of(parts_.begin(), parts_.end(), [&](const ForeignPart& part) { return is_of(part, instance); });
  const std::string name = is_of_one ? known_face(given.substr(dot + 1)) : given;
  for (size_t i = 0; i < parts_.size(); ++i)
    if (is_of_one && !is_of(parts_[i], instance))
      continue;
    else if (is_face ? parts_[i].mesh->faces.contains(name) : parts_[i].regions.contains(name))
      found.push_back(fmt::format("{}:{} {}", part_names_[i], is_face ? "face" : "region", lua_quoted(name)));
  return found;
}

std::string ImportedDeck::put_spring(const FileSpring& given, size_t number) {
  const FileSpring spring = plain(given);
  std::vector<std::string> on;
  for (const std::string& place : {spring.one, spring.other}) {
    if (place.empty()) continue;
    const int part = part_with(place);
    if (part < 0) {
      leave(fmt::format("{}: the nodes of '{}' are on several parts, or none", spring.where, place));
      return "";
    }
    on.push_back(fmt::format("{}:region {}", part_names_[static_cast<size_t>(part)], lua_quoted(place)));
  }
  std::string along;
  for (size_t i = 0; i < 6; ++i) {
    const std::string key = (i < 3 ? "" : "about_") + std::string(1, axis_names[i % 3]), unit = i < 3 ? "/" : "*";
    if (spring.stiffness[i] == 0.0 && spring.damping[i] == 0.0) continue;
    if (spring.stiffness[i] == 0.0) {
      remarks_.push_back(
          fmt::format("{}: a damper alone: a spring of 1e-6 N/m (or N m) stands beside it", spring.where));
      along += fmt::format(", {} = 1e-6", key);
    } else {
      along += fmt::format(", {} = {}*force{}length", key, lua_number(spring.stiffness[i]), unit);
    }
    if (spring.damping[i] != 0.0)
      along += fmt::format(", {}_damping = {}*force*time{}length", key, lua_number(spring.damping[i]), unit);
  }
  if (along.empty()) return "";
  if (!spring.axes.isIdentity(0.0))
    along += fmt::format(", frame = frame{{ x = {}, axis = {} }}", lua_vector(spring.axes.col(0)),
                         lua_vector(spring.axes.col(2)));
  const std::string name = names_.of("spring", std::to_string(number));
  put("local {} = support.spring{{ name = {}, on = {{ {} }}{} }}  -- {}", name, lua_quoted(name), comma_list(on), along,
      spring.where);
  return name;
}

// Has the face of a body all of its nodes? Those inside follow where the whole of the part's surface does.
bool ImportedDeck::is_whole_face(const FileBody& body) const {
  for (const ForeignPart& part : parts_) {
    const auto region = part.regions.find(body.place);
    const auto face = part.mesh->faces.find(body.place);
    if (region == part.regions.end() || face == part.mesh->faces.end()) continue;
    const size_t n = region->second.size();
    if (nodes_of(face->second).size() != n && n != part.file_nodes.size()) return false;
  }
  return true;
}

void ImportedDeck::put_body(const FileBody& body) {
  const std::vector<std::string> faces = places(body.place, true);
  if (faces.size() != 1)
    return leave(
        fmt::format("{}: the nodes that a body moves are a face of {} parts, not of one", body.where, faces.size()));
  if (!is_whole_face(body))
    return leave(fmt::format("{}: some of the nodes that a body moves are on no facet of them", body.where));
  constexpr double negligible = 1e-9;  // kg, the smallest of a deck
  const bool has_mass = body.mass != 0.0;
  const std::string unit = has_mass ? "*force/acceleration" : "";
  const Mat3 j = has_mass ? body.inertia : Mat3(negligible * body.inertia);
  std::vector<std::string> moments, at;
  for (const double value : {j(0, 0), j(1, 1), j(2, 2), j(0, 1), j(0, 2), j(1, 2)})
    moments.push_back(lua_number(value) + unit + "*length^2");
  for (const double value : {body.at[0], body.at[1], body.at[2]}) at.push_back(lua_number(value) + "*length");
  const std::string name = names_.of("body", body.place);
  put("local {} = mass.point{{ name = {}, on = {}, mass = {},\n  inertia = {{ {} }}, at = {{ {} }}, motion = {} }}  -- "
      "{}",
      name, lua_quoted(name), faces[0], lua_number(has_mass ? body.mass : negligible) + unit, comma_list(moments),
      comma_list(at), body.is_mean ? fmt::format("\"mean\", weights = \"{}\"", body.weights) : "\"rigid\"", body.where);
  part_names_.push_back(name);
}

int ImportedDeck::part_with(const std::string& place, int preferred) const {
  const size_t n = nodes_in(place).size();
  const auto has_all = [&](const ForeignPart& part) {
    const auto found = part.regions.find(place);
    return found != part.regions.end() && found->second.size() == n;
  };
  if (preferred >= 0 && has_all(parts_[static_cast<size_t>(preferred)])) return preferred;
  const auto found = std::find_if(parts_.begin(), parts_.end(), has_all);
  return found == parts_.end() ? -1 : static_cast<int>(found - parts_.begin());
}

std::string ImportedDeck::known_face(const std::string& name) const {
  for (const ForeignFace& surface : model_.surfaces)
    if (in_capitals(surface.name) == in_capitals(name)) return surface.name;
  for (const ForeignSet& set : model_.node_sets)
    if (in_capitals(set.name) == in_capitals(name)) return set.name;
  return name;
}

void ImportedDeck::add(const std::vector<FileAction>& actions, std::vector<std::string>& supports,
                       std::vector<std::string>& loads) {
  for (const FileAction& action : merged(actions, supports)) {
    const bool is_held = action.kind == Kind::held, is_on_faces = action.is_on_faces();
    if (action.tightens()) {
      put_tightening(action, loads);
      continue;
    }
    const std::string place = is_on_faces ? known_face(action.place) : action.place;
    const auto on = places(place, is_on_faces);
    if (on.empty() && !action.is_everywhere()) {
      leave(fmt::format("{}: '{}' is on no part", action.where, action.place));
      continue;
    }
    if (action.kind == Kind::force && n_nodes_of(place) != action.n_nodes)
      leave(fmt::format("{}: some nodes of '{}' are of no part, or of several", action.where, action.place));
    const std::string name = names_.of(is_held ? "support" : "load", !action.place.empty()       ? action.place
                                                                     : action.kind == Kind::spin ? "spin"
                                                                                                 : "gravity");
    put("local {} = {}  -- {}", name, text_of(action, comma_list(on), name), action.where);
    (is_held ? supports : loads).push_back(name);
    if (is_held) held_[name] = {nodes_in(place), action.along};
  }
}

void ImportedDeck::put_tightening(const FileAction& action, std::vector<std::string>& loads) {
  const auto on = tightened_.find(action.place);
  if (on == tightened_.end())
    return leave(fmt::format("{}: surface '{}' divides no part, and is no weld of two", action.where, action.place));
  const bool is_force = action.kind == Kind::preload;
  const std::string name = names_.of("load", action.place);
  put("local {} = load.{}{{ on = {}, {} = {} }}  -- {}", name, is_force ? "preload" : "shortening", on->second,
      is_force ? "force" : "by", value_of(action.value[0], is_force ? "force" : "length", action), action.where);
  loads.push_back(name);
}

std::string ImportedDeck::value_of(double value, const char* unit, const FileAction&) {
  return fmt::format("{}*{}", lua_number(value), unit);
}

std::vector<FileAction> ImportedDeck::merged(const std::vector<FileAction>& actions,
                                             std::vector<std::string>& supports) {
  std::vector<FileAction> kept;
  for (FileAction action : actions) {
    if (action.kind == Kind::held) {
      const std::vector<int> nodes = nodes_in(action.place);
      const auto join = [&](const std::array<bool, 3>& other) {
        for (size_t d = 0; d < 3; ++d) action.along[d] = action.along[d] || other[d];
      };
      const auto is_same = [&](const FileAction& one) {
        return one.kind == Kind::held && nodes_in(one.place) == nodes;
      };
      if (const auto same = std::find_if(kept.begin(), kept.end(), is_same); same != kept.end()) {
        join(same->along);
        same->along = action.along;
        continue;
      }
      std::erase_if(supports, [&](const std::string& name) {
        const auto& [its_nodes, its_along] = held_.at(name);
        if (its_nodes == nodes) join(its_along);
        return its_nodes == nodes;
      });
    }
    kept.push_back(std::move(action));
  }
  return kept;
}

std::vector<int> ImportedDeck::nodes_in(const std::string& place) const {
  const auto set = numbers_of_sets_.find(place);
  return set == numbers_of_sets_.end() ? std::vector<int>() : model_.node_sets[set->second].nodes;
}

int ImportedDeck::n_nodes_of(const std::string& place) const {
  int n = 0;
  for (const ForeignPart& part : parts_)
    if (const auto found = part.regions.find(place); found != part.regions.end())
      n += static_cast<int>(found->second.size());
  return n;
}

std::string ImportedDeck::spin_of(const FileAction& action) {
  const Vec3 &axis = action.value, &x = action.through;
  return fmt::format(
      "load.spin{{ speed = {}/time, axis = {{ {}, {}, {} }}, through = {{ {}*length, {}*length, {}*length }} }}",
      lua_number(action.speed), lua_number(axis[0]), lua_number(axis[1]), lua_number(axis[2]), lua_number(x[0]),
      lua_number(x[1]), lua_number(x[2]));
}

std::string ImportedDeck::text_of(const FileAction& action, const std::string& on, const std::string& name) {
  std::string by;
  for (int d = 0; d < 3; ++d) {
    const bool is_said = action.kind == Kind::gravity ? action.value[d] != 0.0 : action.along[static_cast<size_t>(d)];
    if (!is_said) continue;
    if (action.kind == Kind::held) by += fmt::format(", {} = true", axis_names[d]);
    if (action.kind == Kind::moved)
      by += fmt::format(", {} = {}", axis_names[d], value_of(action.value[d], "length", action));
    if (action.kind == Kind::force)
      by += fmt::format(", {} = {}", axis_names[d], value_of(action.n_nodes * action.value[d], "force", action));
    if (action.kind == Kind::resultant)
      by += fmt::format(", {} = {}", axis_names[d], value_of(action.value[d], "force", action));
    if (action.kind == Kind::traction)
      by += fmt::format(", {} = {}", axis_names[d], value_of(action.value[d], "pressure", action));
    if (action.kind == Kind::gravity)
      by += fmt::format("{} {} = {}", by.empty() ? "" : ",", axis_names[d],
                        value_of(action.value[d], "acceleration", action));
  }
  const std::string on_list = fmt::format("on = {{ {} }}", on);
  if (action.kind == Kind::gravity) return fmt::format("load.gravity{{{} }}", by);
  if (action.kind == Kind::spin) return spin_of(action);
  if (action.kind == Kind::pressure)
    return fmt::format("load.pressure{{ {}, history = {} }}", on_list, value_of(action.value[0], "pressure", action));
  if (action.kind == Kind::moved) return fmt::format("load.displacement{{ {}{} }}", on_list, by);
  if (action.kind == Kind::traction) return fmt::format("load.traction{{ {}{} }}", on_list, by);
  if (action.kind == Kind::force || action.kind == Kind::resultant)
    return fmt::format("load.force{{ {}{} }}", on_list, by);
  const bool is_whole = action.along == std::array<bool, 3>{true, true, true};
  return fmt::format("support.{}{{ name = {}, {}{} }}", is_whole ? "fixed" : "held", lua_quoted(name), on_list,
                     is_whole ? "" : by);
}

std::string ImportedDeck::modes_of(const std::string& problem, const std::string& asked) {
  return fmt::format("output.modes{{ name = \"{}\", {} }}", problem == "modes" ? "natural modes" : "modes", asked);
}

void ImportedDeck::write_problem(const std::string& name, const std::vector<std::string>& supports,
                                 const std::vector<std::string>& steps, const std::string& output) {
  put("\nproblem{{ name = {}, substructures = {{ {} }}, interfaces = {{ {} }},\n         supports = {{ {} }}, steps = "
      "{{ {} }}, outputs = {{ {} }} }}:run{{}}",
      lua_quoted(name), comma_list(part_names_), comma_list(interfaces_), comma_list(supports), comma_list(steps),
      output);
}

}  // namespace dygita
