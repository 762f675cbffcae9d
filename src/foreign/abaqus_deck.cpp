// The deck of an input file. One writer, since each step's loads and supports take the place of those that earlier
// steps have written; hence longer than most.
#include "foreign/abaqus_deck.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <iterator>
#include <optional>
#include <set>

#include "base/error.hpp"
#include "foreign/abaqus_steps.hpp"
#include "foreign/acting_loads.hpp"
#include "mesh/face_nodes.hpp"

namespace dygita {

namespace {

using Kind = FileAction::Kind;

constexpr std::array<bool, 3> nothing{};  // no direction

class AbaqusDeck : public ImportedDeck {
 public:
  AbaqusDeck(const ImportOptions& options, AbaqusModel& read, AbaqusAnalysis analysis)
      : ImportedDeck(options, read.model(), "mesh.abaqus"), read_(read), analysis_(std::move(analysis)) {
    remarks_ = std::move(analysis_.remarks);
    untranslated_ = std::move(analysis_.untranslated);
  }

  std::string text() {
    cut_parts(analysis_.cuts);
    write_parts(needs_density());
    write_welds();
    for (const AbaqusJoint& joint : analysis_.joints) write_joint(joint);
    for (const FileBody& body : analysis_.bodies) put_body(body);
    for (const AbaqusEquation& equation : analysis_.equations) write_equation(equation);
    for (const ObliqueHold& hold : analysis_.obliques) write_oblique(hold);
    for (const FileSpring& spring : analysis_.springs)
      if (const std::string name = put_spring(spring, equations_.size() + 1); !name.empty()) equations_.push_back(name);
    std::vector<std::string> supports, loads;
    drive_what_moves_later();
    add_before(supports, loads);
    const std::vector<std::string> supports_before = supports;
    for (const AbaqusStep& step : analysis_.steps) write_step(step, supports, loads);
    write_problems(supports_before);
    return head() + body_;
  }

 private:
  // Does a step ask for the mass?
  bool needs_density() const {
    const auto is_gravity = [](const FileAction& action) { return action.is_everywhere(); };
    return std::any_of(analysis_.before.begin(), analysis_.before.end(), is_gravity) ||
           std::any_of(analysis_.steps.begin(), analysis_.steps.end(), [&](const AbaqusStep& step) {
             return step.procedure != "STATIC" || std::any_of(step.actions.begin(), step.actions.end(), is_gravity);
           });
  }

  // ", orientation = ..." of a section with one.
  std::string orientation_of(const ForeignGroup& group) override {
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

  std::string ring_of(const AbaqusRing& ring) const {
    const auto vector = [](const Vec3& v, const char* unit) {
      return fmt::format("{{ {}{}, {}{}, {}{} }}", lua_number(v[0]), unit, lua_number(v[1]), unit, lua_number(v[2]),
                         unit);
    };
    return fmt::format(", axis = {}, through = {}, n = {}", vector(ring.to - ring.from, ""),
                       vector(ring.from, "*length"), ring.n);
  }

  static std::string gap_of(const AbaqusJoint& joint) {
    if (!joint.clearance) return "gap = \"geometry\"";
    return *joint.clearance == 0.0 ? "closed = true" : fmt::format("gap = {}*length", lua_number(*joint.clearance));
  }

  void write_joint(const AbaqusJoint& joint) {
    const auto one = places(known_face(joint.one), true), other = places(known_face(joint.other), true);
    if (one.size() != 1 || other.size() != 1)
      return leave(fmt::format("{}: surfaces '{}' and '{}' are on {} and {} parts, not on one each", joint.where,
                               joint.one, joint.other, one.size(), other.size()));
    const std::string name = names_.of(joint.is_tie ? "tie" : "contact", joint.one + "_" + joint.other);
    const std::string more = joint.ring ? ring_of(*joint.ring)
                             : joint.is_tie
                                 ? ""
                                 : fmt::format(", friction = {}, {}", lua_number(joint.friction), gap_of(joint));
    if (joint.is_adjusted && !joint.is_tie && !joint.clearance)
      leave(
          fmt::format("{}: ADJUST moves nodes that are near onto the other surface; where all of it is meant to touch, "
                      "closed = true takes the place of the gap",
                      joint.where));
    put("local {} = interface.{}{{ name = {}, between = {{ {}, {} }}{} }}  -- {}", name,
        joint.ring     ? "cyclic"
        : joint.is_tie ? "bonded"
                       : "contact",
        lua_quoted(name), one[0], other[0], more, joint.where);
    interfaces_.push_back(name);
    has_contact_ = has_contact_ || !joint.is_tie;
  }

  static std::string term_of(const Vec3& factors) {
    std::vector<std::string> along;
    for (int d = 0; d < 3; ++d)
      if (std::abs(factors[d]) > 1e-12 * factors.norm())
        along.push_back(fmt::format("{} = {}", "xyz"[d], lua_number(factors[d])));
    return "{ " + comma_list(along) + " }";
  }

  void write_equation(const AbaqusEquation& equation) {
    std::vector<std::string> on, factors;
    std::string along;
    int part = -1;
    for (const AbaqusEquation::Term& term : equation.terms) {
      part = part_with(term.place, part);
      if (part < 0)
        return leave(fmt::format("{}: *EQUATION: a node of it is on no part, or nodes are on several", equation.where));
      on.push_back(fmt::format("{}:region {}", part_names_[static_cast<size_t>(part)], lua_quoted(term.place)));
      factors.push_back(equation.has_axes() ? lua_number(term.factor) : term_of(term.factor * term.along));
    }
    for (size_t d = 0; d < 3; ++d)
      if (equation.along[d]) along += fmt::format(", {} = true", "xyz"[d]);
    const std::string name = names_.of("equation", std::to_string(equations_.size() + 1));
    put("local {} = support.equation{{ name = {}, on = {{ {} }}, {} = {{ {} }}{} }}  -- {}", name, lua_quoted(name),
        comma_list(on), equation.has_axes() ? "factors" : "terms", comma_list(factors), along, equation.where);
    equations_.push_back(name);
  }

  // Nodes that are held along an oblique direction: the nodes of a plane across it, or each by an equation.
  void write_oblique(const ObliqueHold& hold) {
    constexpr size_t most = 100;
    const int part = part_with(hold.place);
    if (part >= 0 && has_plane(parts_[static_cast<size_t>(part)], hold)) {
      const std::string name = names_.of("plane", hold.place);
      put("local {} = support.symmetry{{ name = {}, on = {}:face {} }}  -- {}", name, lua_quoted(name),
          part_names_[static_cast<size_t>(part)], lua_quoted(hold.place), hold.where);
      equations_.push_back(name);
      return;
    }
    if (hold.nodes.size() > most)
      return leave(
          fmt::format("{}: *BOUNDARY: {} nodes are held along axes of *TRANSFORM that are none of the file's, "
                      "and are on no plane across them",
                      hold.where, hold.nodes.size()));
    for (const std::string& node : hold.nodes) write_equation({{{node, 1.0, hold.along}}, {}, hold.where});
  }

  // Has the face of these nodes all of them, and the direction as its normal?
  static bool has_plane(const ForeignPart& part, const ObliqueHold& hold) {
    constexpr double same = 1e-4;
    const auto face = part.mesh->faces.find(hold.place);
    if (face == part.mesh->faces.end() || nodes_of(face->second).size() != hold.nodes.size()) return false;
    return std::all_of(face->second.begin(), face->second.end(), [&](const Facet& facet) {
      const Vec3 normal = facet_area_vector(part.mesh->nodes, facet).normalized();
      return normal.cross(hold.along).norm() < same;
    });
  }

  std::vector<std::string> with_equations(std::vector<std::string> supports) const {
    supports.insert(supports.end(), equations_.begin(), equations_.end());
    return supports;
  }

  std::string value_of(double value, const char* unit, const FileAction& action) override {
    const std::string number = ImportedDeck::value_of(value, unit, action);
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

  // A motion in a step, and the nodes that it moves.
  struct MovedIn {
    size_t step;
    std::array<bool, 3> along;
    std::set<int> points;
  };

  // What a later step moves is no support until then: it is driven to stay where it is.
  void drive_what_moves_later() {
    std::vector<MovedIn> moved;
    std::set<int> moved_points;
    for (size_t step = 0; step < analysis_.steps.size(); ++step)
      for (const FileAction& by : analysis_.steps[step].actions)
        if (by.kind == Kind::moved) {
          moved.push_back({step, by.along, points_of(by)});
          moved_points.insert(moved.back().points.begin(), moved.back().points.end());
        }
    if (moved.empty()) return;
    for (size_t i = 0; i <= analysis_.steps.size(); ++i) {
      std::vector<FileAction>& actions = i == 0 ? analysis_.before : analysis_.steps[i - 1].actions;
      std::vector<FileAction> driven;
      for (FileAction& action : actions) {
        if (action.kind != Kind::held || action.stays) continue;
        const std::set<int> points = points_of(action);
        if (!have_common(points, moved_points)) continue;
        FileAction still = action;
        still.kind = Kind::moved;
        still.value.setZero();
        still.along = {};
        for (const MovedIn& by : moved)
          if (by.step >= i && have_common(points, by.points))
            let_go(action, by, i == 0 && by.step == 0 && by.points == points, still);
        if (still.along != nothing) driven.push_back(std::move(still));
      }
      std::erase_if(actions,
                    [](const FileAction& action) { return action.kind == Kind::held && action.along == nothing; });
      actions.insert(actions.end(), driven.begin(), driven.end());
    }
  }

  static bool have_common(const std::set<int>& a, const std::set<int>& b) {
    return std::any_of(a.begin(), a.end(), [&](int point) { return b.contains(point); });
  }

  // From what is held to what stands still until it is moved; at once: there is no step before.
  static void let_go(FileAction& held, const MovedIn& by, bool is_at_once, FileAction& still) {
    for (size_t d = 0; d < 3; ++d) {
      if (!held.along[d] || !by.along[d]) continue;
      held.along[d] = false;
      still.along[d] = !is_at_once;
    }
  }

  void add_before(std::vector<std::string>& supports, std::vector<std::string>& loads) {
    for (const FileAction& action : analysis_.before) refuse_amplitude(action);
    add_acting(analysis_.before, supports, loads);
  }

  void add_in(const AbaqusStep& step, std::vector<std::string>& supports, std::vector<std::string>& loads) {
    std::vector<FileAction> actions = step.actions;
    for (FileAction& action : actions) {
      if (step.procedure == "STATIC") take_end_of_amplitude(step, action);
      if (step.procedure != "DYNAMIC") refuse_amplitude(action);
    }
    add_acting(actions, supports, loads);
    add_temperatures(step, loads);
  }

  // What a step says anew of a place takes the place of what steps before have said of it.
  void add_acting(std::vector<FileAction> actions, std::vector<std::string>& supports,
                  std::vector<std::string>& loads) {
    const auto is_tightened = [&](const ActingLoad& one, const FileAction& by) {
      return one.action.tightens() && by.tightens() && one.action.place == by.place;
    };
    for (const FileAction& action : actions)  // frozen, or by another kind of load
      if (action.tightens()) drop([&](const ActingLoad& one) { return is_tightened(one, action); }, loads);
    std::erase_if(actions, [](const FileAction& action) { return action.tightens() && action.stays; });
    for (FileAction& action : actions)
      if (action.kind == Kind::held && !acting_.met_by(action, points_of(action), Kind::moved).empty()) {
        if (action.stays) leave(fmt::format("{}: FIXED of nodes that are moved", action.where));
        action.kind = Kind::moved;  // back to where it was
      }
    for (const ActingLoad& one : acting_.all())
      if (!one.action.amplitude.empty())
        leave(fmt::format("{}: its amplitude goes on into a later step", one.action.where));
    std::vector<FileAction> held;
    std::copy_if(actions.begin(), actions.end(), std::back_inserter(held),
                 [](const FileAction& action) { return action.kind == Kind::held; });
    add(held, supports, loads);
    std::set<std::string> replaced;
    std::vector<ActingLoad> added;
    for (const FileAction& action : actions) {
      if (action.kind == Kind::held) continue;
      const std::set<int> points = points_of(action);
      for (const ActingLoad* one : acting_.met_by(action, points, action.kind))
        if (one->points == points && one->action.along == action.along && one->action.owner == action.owner)
          replaced.insert(one->name);
        else
          leave(fmt::format("{}: it changes a part of what {} says", action.where, one->action.where));
      const size_t n = loads.size();
      add({action}, supports, loads);
      for (size_t i = n; i < loads.size(); ++i) added.push_back({action, loads[i], points});
    }
    drop([&](const ActingLoad& one) { return replaced.contains(one.name); }, loads);
    acting_.add(std::move(added));
  }

  void drop(const std::function<bool(const ActingLoad&)>& which, std::vector<std::string>& loads) {
    const std::set<std::string> names = acting_.drop(which);
    std::erase_if(loads, [&](const std::string& name) { return names.contains(name); });
  }

  // Nodes, or corners of facets, of the place of an action: none where it is everywhere.
  std::set<int> points_of(const FileAction& action) const {
    std::set<int> points;
    if (!action.is_on_faces()) {
      const std::vector<int> nodes = nodes_in(action.place);
      points.insert(nodes.begin(), nodes.end());
    }
    for (const ForeignFace& face : model_.surfaces)
      if (action.is_on_faces() && face.name == known_face(action.place))
        for (const ForeignFacet& facet : face.facets) points.insert(facet.corners.begin(), facet.corners.end());
    points.erase(-1);
    return points;
  }

  // One value for a part.
  std::optional<double> temperature_of(const ForeignPart& part, const std::map<int, double>& of_nodes) const {
    std::optional<double> common;
    for (const int node : part.file_nodes) {
      const auto own = of_nodes.find(node);
      const double value = own == of_nodes.end() ? 0.0 : own->second;
      if (common && *common != value) return std::nullopt;
      common = value;
    }
    return common;
  }

  void add_temperatures(const AbaqusStep& step, std::vector<std::string>& loads) {
    std::map<int, double> temperatures = step.temperatures;  // of other nodes as they were
    temperatures.insert(analysis_.temperatures.begin(), analysis_.temperatures.end());
    for (size_t i = 0; i < parts_.size() && !step.temperatures.empty(); ++i) {
      const ForeignGroup& group = model_.groups[static_cast<size_t>(parts_[i].group)];
      const auto material = std::find_if(model_.materials.begin(), model_.materials.end(), [&](const auto& one) {
        return in_capitals(one.name) == in_capitals(group.material);
      });
      const std::string who = fmt::format("{}: *TEMPERATURE: ", step.temperatures_where);
      const auto from = temperature_of(parts_[i], analysis_.temperatures), to = temperature_of(parts_[i], temperatures);
      if (!from || !to) {
        leave(who + fmt::format("part '{}' has several temperatures; load.temperature has one", parts_[i].name));
      } else if (material == model_.materials.end() || !material->expansion) {
        leave(who + fmt::format("material '{}' has no *EXPANSION that is one number", group.material));
      } else if (!heated_.empty()) {
        leave(who + "a second time");
      } else if (*material->expansion != 0.0) {
        const std::string name = names_.of("load", "temperature_" + parts_[i].name);
        put("local {} = load.temperature{{ parts = {{ {} }}, expansion = {}, by = {} }}  -- {}", name, part_names_[i],
            lua_number(*material->expansion), lua_number(*to - *from), step.temperatures_where);
        loads.push_back(name);
      }
    }
    if (!step.temperatures.empty()) heated_ = step.where;
  }

  void refuse_amplitude(const FileAction& action) {
    if (!action.amplitude.empty()) leave(fmt::format("{}: an amplitude in a step without motion", action.where));
  }

  // A static step ends at the amplitude's value at its end: its answer is that of the last value, except where friction
  // remembers the way.
  void take_end_of_amplitude(const AbaqusStep& step, FileAction& action) {
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
    remarks_.push_back(fmt::format("{}: the amplitude '{}' is {} at the end of its step", action.where,
                                   action.amplitude, lua_number(at_end)));
    action.value *= at_end;
    action.amplitude.clear();
  }

  // OP = NEW, which is of one kind of loads.
  void drop_old(const AbaqusStep& step, std::vector<std::string>& supports, std::vector<std::string>& loads) {
    const auto is_moved = [](const ActingLoad& one) { return one.action.kind == Kind::moved; };
    const auto is_force = [](const ActingLoad& one) { return one.action.kind == Kind::force; };
    const auto n_forces = std::count_if(acting_.all().begin(), acting_.all().end(), is_force),
               n_moved = std::count_if(acting_.all().begin(), acting_.all().end(), is_moved);
    if (step.drops_supports) supports.clear(), drop(is_moved, loads);
    if (!step.drops_loads) return;
    if (n_forces > 0 && static_cast<size_t>(n_forces + n_moved) < acting_.all().size())
      leave(fmt::format("{}: OP = NEW after forces and distributed loads", step.where));
    drop([&](const ActingLoad& one) { return !is_moved(one); }, loads);
  }

  void write_step(const AbaqusStep& step, std::vector<std::string>& supports, std::vector<std::string>& loads) {
    const bool is_dynamic = step.procedure == "DYNAMIC";
    if (step.is_perturbation && step.procedure == "STATIC" && analysis_.steps.size() > 1)
      leave(fmt::format("{}: a static perturbation about the step before", step.where));
    drop_old(step, supports, loads);
    if (step.is_perturbation && !loads.empty() && !step.actions.empty() && step.procedure != "FREQUENCY")
      leave(fmt::format("{}: it changes what earlier steps have loaded or moved", step.where));
    add_in(step, supports, loads);
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
        comma_list(loads), comma_list(with_equations(supports)), how, step.where);
    steps_.push_back(name);
    for (const std::string& support : with_equations(supports))
      if (std::find(all_supports_.begin(), all_supports_.end(), support) == all_supports_.end())
        all_supports_.push_back(support);
  }

  // What is moved stands still in a mode.
  void note_modes(const AbaqusStep& step, std::vector<std::string> supports, std::vector<std::string> loads) {
    for (const ActingLoad& one : acting_.all()) {
      if (one.action.kind != Kind::moved) continue;
      FileAction still = one.action;
      still.kind = Kind::held;
      still.value.setZero();
      still.amplitude.clear();
      add({still}, supports, loads);
      std::erase(loads, one.name);
    }
    if (step.is_perturbation && !loads.empty())
      leave(fmt::format("{}: stresses of the loads before have no stiffness in the model", step.where));
    const std::string rest = names_.of("rest", std::to_string(modes_.size() + 1));
    put("local {} = step.static{{ name = {}, supports = {{ {} }} }}  -- without loads", rest, lua_quoted(rest),
        comma_list(with_equations(supports)));
    const auto number = [&](size_t i) { return i < step.numbers.size() ? step.numbers[i] : 0.0; };
    const double n = number(0), from = number(1), up_to = number(2);
    if (from > 0.0) remarks_.push_back(fmt::format("{}: modes below its lowest frequency are here, too", step.where));
    if (n > 0.0 && up_to > 0.0)
      remarks_.push_back(fmt::format("{}: modes above its highest frequency are here, too", step.where));
    modes_.push_back({rest,
                      n > 0.0 || up_to <= 0.0 ? fmt::format("n = {:.0f}", n > 0.0 ? std::clamp(n, 1.0, 2000.0) : 10.0)
                                              : fmt::format("up_to = {}/time", lua_number(up_to)),
                      with_equations(supports)});
  }

  void write_problems(const std::vector<std::string>& supports_before) {
    const std::string name = deck_name_of(std::filesystem::path(options_.file).stem().string());
    if (!steps_.empty())
      write_problem(name, all_supports_.empty() ? with_equations(supports_before) : all_supports_, steps_,
                    "output.vtk{ frames = 1 }");
    for (size_t i = 0; i < modes_.size(); ++i) {
      const std::string own = modes_.size() + steps_.size() == 1
                                  ? name
                                  : fmt::format("{} modes{}", name, i == 0 ? "" : fmt::format(" {}", i + 1));
      write_problem(own, modes_[i].supports, {modes_[i].rest}, modes_of(own, modes_[i].asked));
    }
    if (steps_.empty() && modes_.empty()) leave("the file has no step that a deck can say");
  }

  struct Modes {
    std::string rest, asked;
    std::vector<std::string> supports;
  };

  AbaqusModel& read_;
  AbaqusAnalysis analysis_;
  std::vector<std::string> steps_, all_supports_, equations_;
  std::vector<Modes> modes_;
  ActingLoads acting_;
  std::string heated_;  // the step that has temperatures
  bool has_contact_ = false;
};

}  // namespace

std::string deck_of_abaqus(const ImportOptions& options) {
  AbaqusModel read({options.file, file_units(options.units).length, options.skip});
  AbaqusAnalysis analysis = analysis_of(read);
  return AbaqusDeck(options, read, std::move(analysis)).text();
}

}  // namespace dygita
