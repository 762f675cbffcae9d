// One writer of one text: parts, joints, supports, loads and steps share the names that they have been given, so it is
// not split.
#include "foreign/abaqus_deck.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "base/error.hpp"
#include "base/names.hpp"
#include "foreign/abaqus_steps.hpp"
#include "foreign/file_units.hpp"
#include "foreign/lua_text.hpp"

namespace dygita {

namespace {

using Kind = AbaqusAction::Kind;
constexpr double density_of_steel = 7850;  // kg/m^3, where the file gives none and only statics are asked for
constexpr const char* axis_names = "xyz";

class DeckWriter {
 public:
  DeckWriter(const ImportOptions& options, AbaqusModel& read)
      : options_(options),
        units_(file_units(options.units)),
        read_(read),
        analysis_(analysis_of(read)),
        parts_(parts_of(read.model())) {}

  std::string text() {
    write_parts();
    write_welds();
    for (const AbaqusJoint& joint : analysis_.joints) write_joint(joint);
    std::vector<std::string> supports, loads;
    add(analysis_.before, supports, loads, nullptr);
    const std::vector<std::string> supports_before = supports;
    for (const AbaqusStep& step : analysis_.steps) write_step(step, supports, loads);
    write_problems(supports_before);
    return head() + body_;
  }

 private:
  template <class... Values>
  void put(fmt::format_string<Values...> format, Values&&... values) {
    body_ += fmt::format(format, std::forward<Values>(values)...) + "\n";
  }
  void leave(const std::string& what) { analysis_.untranslated.push_back(what); }

  std::string head() const {
    const std::string name = std::filesystem::path(options_.file).filename().string();
    std::string text = fmt::format(
        "-- What {} says, written by `dygita import`; numbers behind the file's name are its "
        "lines.\n-- The file states no units. These are they, in SI: change all together if the file has others.\n",
        printable(name));
    text += fmt::format("local units = {}\nlocal length, force, pressure, acceleration, time = {}, {}, {}, {}, {}\n\n",
                        lua_quoted(options_.units), lua_number(units_.length), lua_number(units_.force()),
                        lua_number(units_.stress()), lua_number(units_.acceleration()), lua_number(units_.time));
    for (const std::string& line : read_.model().told) text += "-- " + one_line(line) + "\n";
    for (const std::string& line : analysis_.remarks) text += "-- " + one_line(line) + "\n";
    for (const std::string& line : analysis_.untranslated) text += "-- NOT TRANSLATED: " + one_line(line) + "\n";
    if (!analysis_.untranslated.empty())
      text += fmt::format("error({}, 0)\n",
                          lua_quoted(fmt::format("{0} of {2} {1} not translated: read the comments, complete the deck, "
                                                 "then delete this line",
                                                 analysis_.untranslated.size() == 1 ? "one line" : "some lines",
                                                 analysis_.untranslated.size() == 1 ? "is" : "are", name)));
    return text + "\n";
  }

  static std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return printable(text);
  }

  // Does a step ask for the mass?
  bool needs_density() const {
    const auto is_gravity = [](const AbaqusAction& action) { return action.kind == Kind::gravity; };
    return std::any_of(analysis_.before.begin(), analysis_.before.end(), is_gravity) ||
           std::any_of(analysis_.steps.begin(), analysis_.steps.end(), [&](const AbaqusStep& step) {
             return step.procedure != "STATIC" || std::any_of(step.actions.begin(), step.actions.end(), is_gravity);
           });
  }

  std::string material_of(const ForeignGroup& group) {
    const auto& all = read_.model().materials;
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
      if (needs_density()) leave(fmt::format("{}: material '{}' has no *DENSITY", found->where, found->name));
      put("local {} = file:material{{ name = {}, density = {} }}  -- {}: no *DENSITY; statics do not depend on it",
          name, lua_quoted(found->name), density_of_steel, found->where);
    }
    is_directed_[name] = found->word == "orthotropic";
    return name;
  }

  // ", orientation = ..." of a section with one.
  std::string orientation_of(const ForeignGroup& group) {
    if (group.orientation.empty()) return "";
    for (const FileCard& card : read_.file().cards()) {
      if (card.keyword != "ORIENTATION" || in_capitals(card.option("NAME")) != in_capitals(group.orientation)) continue;
      const std::string system = in_capitals(card.option("SYSTEM"));
      if ((!system.empty() && system != "RECTANGULAR") || card.has("DEFINITION") || card.data.size() != 1) break;
      LineFields fields(read_.file(), card.data[0]);
      std::vector<std::string> x;
      for (int i = 0; i < 6; ++i) x.push_back(lua_number(fields.real("a coordinate")));
      return fmt::format(", orientation = {{ {{ {}, {}, {} }}, {{ {}, {}, {} }} }}", x[0], x[1], x[2], x[3], x[4],
                         x[5]);
    }
    leave(fmt::format("*ORIENTATION '{}' of part '{}': only two rectangular axes are written", group.orientation,
                      group.name));
    return "";
  }

  void write_parts() {
    std::string skip;
    for (const std::string& type : options_.skip) skip += (skip.empty() ? "" : ", ") + lua_quoted(type);
    put("local file = mesh.abaqus{{ file = {}, units = units{} }}", lua_quoted(options_.file),
        skip.empty() ? "" : ", skip = { " + skip + " }");
    for (const ForeignPart& part : parts_) {
      const ForeignGroup& group = read_.model().groups[static_cast<size_t>(part.group)];
      const std::string material = material_of(group), name = names_.of("part", part.name);
      put("local {} = substructure{{ name = {}, mesh = file:part {}, material = {}{} }}", name,
          lua_quoted(deck_name_of(part.name)), lua_quoted(part.name), material,
          is_directed_[material] ? orientation_of(group) : "");
      part_names_.push_back(name);
    }
  }

  // Parts that share the nodes of facets in the file are one body there.
  void write_welds() {
    for (size_t i = 0; i < parts_.size(); ++i)
      for (size_t j = 0; j < i; ++j) {
        const auto [n_nodes, n_facets] = shared(parts_[j], parts_[i]);
        if (n_nodes == 0) continue;
        if (n_facets == 0) {
          leave(
              fmt::format("parts '{}' and '{}' share {} nodes and no facet", parts_[j].name, parts_[i].name, n_nodes));
          continue;
        }
        const std::string name = names_.of("weld", fmt::format("{}_{}", j + 1, i + 1));
        put("local {} = interface.bonded{{ name = {}, between = {{ {}, {} }} }}  -- they share {} nodes", name,
            lua_quoted(name), part_names_[j], part_names_[i], n_nodes);
        interfaces_.push_back(name);
      }
  }

  std::pair<size_t, int> shared(const ForeignPart& one, const ForeignPart& other) const {
    std::vector<int> common;
    std::set_intersection(one.file_nodes.begin(), one.file_nodes.end(), other.file_nodes.begin(),
                          other.file_nodes.end(), std::back_inserter(common));
    if (common.empty()) return {0, 0};
    int n_facets = 0;
    for (const Facet& facet : boundary_facets(one.mesh->blocks))
      n_facets += std::all_of(facet.corners().begin(), facet.corners().end(), [&](int node) {
        return std::binary_search(common.begin(), common.end(), one.file_nodes[static_cast<size_t>(node)]);
      });
    return {common.size(), n_facets};
  }

  // Of an instance "I1", or one of its pieces "I1[2]".
  static bool is_of(const ForeignPart& part, const std::string& instance) {
    return in_capitals(part.name.substr(0, part.name.find('['))) == in_capitals(instance);
  }

  // "part_a:face "TOP"" of each part that has it; of "I1.TOP" those of the instance I1.
  std::vector<std::string> places(const std::string& given, bool is_face) const {
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

  std::string known_face(const std::string& name) const {
    for (const ForeignFace& surface : read_.model().surfaces)
      if (in_capitals(surface.name) == in_capitals(name)) return surface.name;
    for (const ForeignSet& set : read_.model().node_sets)
      if (in_capitals(set.name) == in_capitals(name)) return set.name;
    return name;
  }

  void write_joint(const AbaqusJoint& joint) {
    const auto one = places(known_face(joint.one), true), other = places(known_face(joint.other), true);
    if (one.size() != 1 || other.size() != 1)
      return leave(fmt::format("{}: surfaces '{}' and '{}' are on {} and {} parts, not on one each", joint.where,
                               joint.one, joint.other, one.size(), other.size()));
    const std::string name = names_.of(joint.is_tie ? "tie" : "contact", joint.one + "_" + joint.other);
    const std::string more =
        joint.is_tie ? "" : fmt::format(", friction = {}, gap = \"geometry\"", lua_number(joint.friction));
    if (joint.is_adjusted && !joint.is_tie)
      leave(
          fmt::format("{}: ADJUST moves nodes that are near onto the other surface; where all of it is meant to touch, "
                      "closed = true takes the place of the gap",
                      joint.where));
    put("local {} = interface.{}{{ name = {}, between = {{ {}, {} }}{} }}  -- {}", name,
        joint.is_tie ? "bonded" : "contact", lua_quoted(name), one[0], other[0], more, joint.where);
    interfaces_.push_back(name);
    has_contact_ = has_contact_ || !joint.is_tie;
  }

  std::string value_of(double value, const char* unit, const AbaqusAction& action) {
    const std::string number = fmt::format("{}*{}", lua_number(value), unit);
    if (action.amplitude.empty()) return number;
    const auto found = analysis_.amplitudes.find(in_capitals(action.amplitude));
    if (found == analysis_.amplitudes.end() || found->second.size() < 4) {
      leave(fmt::format("{}: there is no amplitude '{}'", action.where, action.amplitude));
      return number;
    }
    std::vector<std::string> times, values;
    for (size_t i = 0; i + 1 < found->second.size(); i += 2) {
      times.push_back(lua_number(found->second[i]) + "*time");
      values.push_back(lua_number(value * found->second[i + 1]) + "*" + unit);
    }
    return fmt::format("history.piecewise{{ times = {{ {} }}, values = {{ {} }} }}", comma_list(times),
                       comma_list(values));
  }

  void add(const std::vector<AbaqusAction>& actions, std::vector<std::string>& supports,
           std::vector<std::string>& loads, const AbaqusStep* step) {
    for (AbaqusAction& action : merged(actions, supports)) {
      const bool is_held = action.kind == Kind::held;
      const std::string place = action.kind == Kind::pressure ? known_face(action.place) : action.place;
      const auto on = places(place, action.kind == Kind::pressure);
      if (on.empty() && action.kind != Kind::gravity) {
        leave(fmt::format("{}: '{}' is on no part", action.where, action.place));
        continue;
      }
      if (step && step->procedure == "STATIC") take_end_of_amplitude(*step, action);
      if (!action.amplitude.empty() && !(step && step->procedure == "DYNAMIC"))
        leave(fmt::format("{}: an amplitude in a step without motion", action.where));
      if (action.kind == Kind::force && n_nodes_of(place) != action.n_nodes)
        leave(fmt::format("{}: some nodes of '{}' are of no part, or of several", action.where, action.place));
      const std::string name = names_.of(is_held ? "support" : "load", action.place.empty() ? "gravity" : action.place);
      put("local {} = {}  -- {}", name, text_of(action, comma_list(on), name), action.where);
      (is_held ? supports : loads).push_back(name);
      if (is_held) held_[name] = {nodes_in(place), action.along};
    }
  }

  // A static step ends at the amplitude's value at its end: its answer is that of the last value, except where friction
  // remembers the way.
  void take_end_of_amplitude(const AbaqusStep& step, AbaqusAction& action) {
    const auto found = analysis_.amplitudes.find(in_capitals(action.amplitude));
    if (action.amplitude.empty() || found == analysis_.amplitudes.end() || found->second.size() < 4) return;
    const std::vector<double>& points = found->second;
    const double end = step.numbers.size() > 1 && step.numbers[1] > 0 ? step.numbers[1] : 1.0;
    size_t i = 0;
    while (i + 3 < points.size() && points[i + 2] < end) i += 2;
    const double from = points[i], to = i + 3 < points.size() ? points[i + 2] : from;
    const double share = to > from ? std::clamp((end - from) / (to - from), 0.0, 1.0) : 0.0;
    const double at_end =
        points[i + 1] + share * ((i + 3 < points.size() ? points[i + 3] : points[i + 1]) - points[i + 1]);
    analysis_.remarks.push_back(fmt::format("{}: the amplitude '{}' is {} at the end of its step", action.where,
                                            action.amplitude, lua_number(at_end)));
    action.value *= at_end;
    action.amplitude.clear();
  }

  // A place has one support: directions in which several lines hold it come together, with those held before.
  std::vector<AbaqusAction> merged(const std::vector<AbaqusAction>& actions, std::vector<std::string>& supports) {
    std::vector<AbaqusAction> kept;
    for (AbaqusAction action : actions) {
      if (action.kind == Kind::held) {
        const std::vector<int> nodes = nodes_in(action.place);
        const auto join = [&](const std::array<bool, 3>& other) {
          for (size_t d = 0; d < 3; ++d) action.along[d] = action.along[d] || other[d];
        };
        const auto is_same = [&](const AbaqusAction& one) {
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

  std::vector<int> nodes_in(const std::string& place) const {
    for (const ForeignSet& set : read_.model().node_sets)
      if (set.name == place) return set.nodes;
    return {};
  }

  int n_nodes_of(const std::string& place) const {
    int n = 0;
    for (const ForeignPart& part : parts_)
      if (const auto found = part.regions.find(place); found != part.regions.end())
        n += static_cast<int>(found->second.size());
    return n;
  }

  std::string text_of(const AbaqusAction& action, const std::string& on, const std::string& name) {
    std::string by;
    for (int d = 0; d < 3; ++d) {
      const bool is_said = action.kind == Kind::gravity ? action.value[d] != 0.0 : action.along[static_cast<size_t>(d)];
      if (!is_said) continue;
      if (action.kind == Kind::held) by += fmt::format(", {} = true", axis_names[d]);
      if (action.kind == Kind::moved)
        by += fmt::format(", {} = {}", axis_names[d], value_of(action.value[d], "length", action));
      if (action.kind == Kind::force)
        by += fmt::format(", {} = {}", axis_names[d], value_of(action.n_nodes * action.value[d], "force", action));
      if (action.kind == Kind::gravity)
        by += fmt::format("{} {} = {}", by.empty() ? "" : ",", axis_names[d],
                          value_of(action.value[d], "acceleration", action));
    }
    const std::string on_list = fmt::format("on = {{ {} }}", on);
    if (action.kind == Kind::gravity) return fmt::format("load.gravity{{{} }}", by);
    if (action.kind == Kind::pressure)
      return fmt::format("load.pressure{{ {}, history = {} }}", on_list, value_of(action.value[0], "pressure", action));
    if (action.kind == Kind::moved) return fmt::format("load.displacement{{ {}{} }}", on_list, by);
    if (action.kind == Kind::force) return fmt::format("load.force{{ {}{} }}", on_list, by);
    const bool is_whole = action.along == std::array<bool, 3>{true, true, true};
    return fmt::format("support.{}{{ name = {}, {}{} }}", is_whole ? "fixed" : "held", lua_quoted(name), on_list,
                       is_whole ? "" : by);
  }

  void write_step(const AbaqusStep& step, std::vector<std::string>& supports, std::vector<std::string>& loads) {
    const bool is_dynamic = step.procedure == "DYNAMIC";
    if ((step.drops_supports || step.drops_loads) && !loads.empty())
      leave(fmt::format("{}: OP = NEW after steps with loads", step.where));
    if (step.is_perturbation && step.procedure == "STATIC" && analysis_.steps.size() > 1)
      leave(fmt::format("{}: a static perturbation about the step before", step.where));
    if (step.drops_supports) supports.clear();
    if (step.drops_loads) loads.clear();
    if (!loads.empty() && !step.actions.empty() && step.procedure != "FREQUENCY")
      leave(fmt::format("{}: it changes what earlier steps have loaded or moved", step.where));
    add(step.actions, supports, loads, &step);
    if (step.procedure == "FREQUENCY") return note_modes(step, supports, loads);
    if (step.procedure.empty()) return leave(fmt::format("{}: a step of another kind", step.where));
    if (step.is_explicit) leave(fmt::format("{}: EXPLICIT: solver.latin chooses by itself", step.where));
    std::string how;
    if (is_dynamic) {
      const double dt = step.numbers.empty() ? 0.0 : step.numbers[0],
                   duration = step.numbers.size() < 2 ? 0.0 : step.numbers[1];
      if (!(dt > 0) || !(duration > 0))
        return leave(fmt::format("{}: *DYNAMIC without time step and duration", step.where));
      const double n = std::ceil(duration / dt * (1 - 1e-9));
      how = fmt::format(", duration = {}*time, dt = {}*time", lua_number(duration), lua_number(duration / n));
    } else if (has_contact_ && step.numbers.size() > 1 && step.numbers[0] > 0) {
      constexpr double most = 100;
      how = fmt::format(", increments = {:.0f}", std::clamp(std::round(step.numbers[1] / step.numbers[0]), 1.0, most));
    }
    const std::string name = names_.of("step", std::to_string(steps_.size() + 1));
    put("local {} = step.{}{{ name = {}{}, loads = {{ {} }}, supports = {{ {} }}{} }}  -- {}", name,
        is_dynamic ? "dynamic" : "static", lua_quoted(name), steps_.empty() ? "" : ", after = " + steps_.back(),
        comma_list(loads), comma_list(supports), how, step.where);
    steps_.push_back(name);
    for (const std::string& support : supports)
      if (std::find(all_supports_.begin(), all_supports_.end(), support) == all_supports_.end())
        all_supports_.push_back(support);
  }

  void note_modes(const AbaqusStep& step, const std::vector<std::string>& supports,
                  const std::vector<std::string>& loads) {
    if (step.is_perturbation && !loads.empty())
      leave(fmt::format("{}: stresses of the loads before have no stiffness in the model", step.where));
    const std::string rest = names_.of("rest", std::to_string(modes_.size() + 1));
    put("local {} = step.static{{ name = {}, supports = {{ {} }} }}  -- without loads", rest, lua_quoted(rest),
        comma_list(supports));
    const int n = step.numbers.empty() ? 10 : static_cast<int>(std::clamp(step.numbers[0], 1.0, 2000.0));
    modes_.push_back({rest, fmt::format("output.modes{{ name = \"modes\", n = {} }}", n), supports});
  }

  void write_problems(const std::vector<std::string>& supports_before) {
    const std::string name = deck_name_of(std::filesystem::path(options_.file).stem().string());
    const auto write = [&](const std::string& of, const std::vector<std::string>& supports,
                           const std::vector<std::string>& steps, const std::string& output) {
      put("\nproblem{{ name = {}, substructures = {{ {} }}, interfaces = {{ {} }},\n         supports = {{ {} }}, "
          "steps = "
          "{{ {} }}, outputs = {{ {} }} }}:run{{}}",
          lua_quoted(of), comma_list(part_names_), comma_list(interfaces_), comma_list(supports), comma_list(steps),
          output);
    };
    if (!steps_.empty())
      write(name, all_supports_.empty() ? supports_before : all_supports_, steps_, "output.vtk{ frames = 1 }");
    for (size_t i = 0; i < modes_.size(); ++i)
      write(modes_.size() + steps_.size() == 1
                ? name
                : fmt::format("{} modes{}", name, i == 0 ? "" : fmt::format(" {}", i + 1)),
            modes_[i].supports, {modes_[i].rest}, modes_[i].output);
    if (steps_.empty() && modes_.empty()) leave("the file has no step that a deck can say");
  }

  struct Modes {
    std::string rest, output;
    std::vector<std::string> supports;
  };

  const ImportOptions& options_;
  FileUnits units_;
  AbaqusModel& read_;
  AbaqusAnalysis analysis_;
  std::vector<ForeignPart> parts_;
  LuaNames names_;
  std::map<std::string, std::string> materials_;
  std::map<std::string, bool> is_directed_;
  std::vector<std::string> part_names_, interfaces_, steps_, all_supports_;
  std::map<std::string, std::pair<std::vector<int>, std::array<bool, 3>>> held_;  // by the names of supports
  std::vector<Modes> modes_;
  bool has_contact_ = false;
  std::string body_;
};

}  // namespace

std::string deck_of_abaqus(const ImportOptions& options) {
  AbaqusModel read({options.file, file_units(options.units).length, options.skip});
  return DeckWriter(options, read).text();
}

}  // namespace dygita
