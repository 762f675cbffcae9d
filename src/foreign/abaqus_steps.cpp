// The steps of an input file, card by card: one reader, since what a step keeps of those before it (loads, supports,
// amplitudes) is its state; hence longer than most.
#include "foreign/abaqus_steps.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/error.hpp"
#include "base/names.hpp"
#include "foreign/abaqus_axes.hpp"
#include "foreign/abaqus_pretensions.hpp"
#include "foreign/abaqus_references.hpp"
#include "foreign/loaded_facets.hpp"

namespace dygita {

namespace {

// Says nothing of the motion that is computed: what is printed, headings, what has been read with the mesh, and what
// matters with temperatures alone.
const std::set<std::string> silent = {"NODE",
                                      "ELEMENT",
                                      "NSET",
                                      "ELSET",
                                      "SURFACE",
                                      "SOLIDSECTION",
                                      "MATERIAL",
                                      "ELASTIC",
                                      "DENSITY",
                                      "DAMPING",
                                      "PART",
                                      "ENDPART",
                                      "INSTANCE",
                                      "ENDINSTANCE",
                                      "SYSTEM",
                                      "ASSEMBLY",
                                      "ENDASSEMBLY",
                                      "HEADING",
                                      "PREPRINT",
                                      "END",
                                      "NODEPRINT",
                                      "NODEFILE",
                                      "NODEOUTPUT",
                                      "ELPRINT",
                                      "ELFILE",
                                      "ELEMENTOUTPUT",
                                      "CONTACTPRINT",
                                      "CONTACTFILE",
                                      "CONTACTOUTPUT",
                                      "OUTPUT",
                                      "ENERGYOUTPUT",
                                      "RESTART",
                                      "MONITOR",
                                      "TIMEPOINTS",
                                      "FILEFORMAT",
                                      "PRINT",
                                      "FACEPRINT",
                                      "SECTIONPRINT",
                                      "EXPANSION",
                                      "CONDUCTIVITY",
                                      "SPECIFICHEAT",
                                      "ORIENTATION",
                                      "SURFACEINTERACTION",
                                      "SURFACEBEHAVIOR",
                                      "FRICTION",
                                      "ENDSTEP",
                                      "PHYSICALCONSTANTS",
                                      "CONTROLS",
                                      "USERMATERIAL",
                                      "DEPVAR",
                                      "PLASTIC",
                                      "CREEP",
                                      "HYPERELASTIC",
                                      "HYPERFOAM",
                                      "CYCLICHARDENING",
                                      "DEFORMATIONPLASTICITY"};

// Options that are read, or that say nothing of the motion.
const std::map<std::string, std::set<std::string>> options_of = {
    {"BOUNDARY", {"OP", "AMPLITUDE", "TYPE", "FIXED"}},
    {"CLOAD", {"OP", "AMPLITUDE"}},
    {"DLOAD", {"OP", "AMPLITUDE"}},
    {"DSLOAD", {"OP", "AMPLITUDE"}},
    {"TEMPERATURE", {}},
    {"EQUATION", {}},
    {"MPC", {}},
    {"SPRING", {"ELSET"}},
    {"PRE-TENSIONSECTION", {"SURFACE", "NODE", "ELEMENT"}},
    {"CLEARANCE", {"MASTER", "SLAVE", "VALUE"}},
    {"DASHPOT", {"ELSET"}},
    {"MASS", {"ELSET"}},
    {"RIGIDBODY", {"NSET", "ELSET", "REFNODE", "ROTNODE"}},
    {"COUPLING", {"REFNODE", "SURFACE", "CONSTRAINTNAME"}},
    {"KINEMATIC", {}},
    {"DISTRIBUTING", {}},
    {"AMPLITUDE", {"NAME", "TIME", "VALUE", "DEFINITION"}},
    {"STATIC", {"DIRECT", "SOLVER"}},
    {"DYNAMIC", {"DIRECT", "SOLVER", "EXPLICIT", "ALPHA"}},
    {"FREQUENCY", {"SOLVER", "STORAGE", "GLOBAL", "EIGENSOLVER"}},
    {"STEP", {"NLGEOM", "PERTURBATION", "INC", "INCF", "NAME", "UNSYMM"}},
    {"TIE", {"NAME", "POSITIONTOLERANCE", "ADJUST", "TYPE", "CYCLICSYMMETRY", "MULTISTAGE"}},
    {"CYCLICSYMMETRYMODEL", {"N", "NGRAPH", "TIE", "ELSET"}},  // NGRAPH: of sectors drawn
    {"SELECTCYCLICSYMMETRYMODES", {"NMIN", "NMAX"}},
    {"CONTACTPAIR", {"INTERACTION", "TYPE", "ADJUST", "SMALLSLIDING"}},
    {"SOLIDSECTION", {"ELSET", "MATERIAL", "ORIENTATION", "CONTROLS"}},
    {"FRICTION", {}},
    {"SURFACEBEHAVIOR", {"PRESSURE-OVERCLOSURE"}},
    {"SURFACEINTERACTION", {"NAME"}}};

using Mask = std::array<bool, 3>;
constexpr double rough = 1000;  // coefficient of friction: the largest of a deck, with which nothing slides

class AnalysisReader {
 public:
  explicit AnalysisReader(AbaqusModel& model)
      : model_(model), file_(model.file()), constraints_(model), references_(model), pretensions_(model) {}

  AbaqusAnalysis read() {
    for (const PlacedCard& placed : model_.cards()) {
      try {
        read(placed);
      } catch (const InputError& error) {
        analysis_.untranslated.emplace_back(error.what());
      }
    }
    for (const AbaqusStep& step : analysis_.steps)
      if (is_sector_ && step.procedure == "FREQUENCY" && !step.is_of_diameter_0)
        analysis_.untranslated.push_back(
            fmt::format("{}: modes of all nodal diameters: a deck has those of nodal diameter 0", step.where));
    set_clearances();
    set_obliques();
    constraints_.finish(analysis_.springs, analysis_.untranslated);
    analysis_.equations = std::move(constraints_.equations);
    references_.finish(analysis_);
    pretensions_.finish(analysis_.cuts, analysis_.untranslated);
    return std::move(analysis_);
  }

 private:
  void read(const PlacedCard& placed) {
    const FileCard& card = *placed.card;
    const std::string& word = card.keyword;
    if (const auto known = options_of.find(word); known != options_of.end())
      for (const auto& [option, value] : card.options)
        if (!known->second.contains(option)) leave(card, printable(option) + " is not read");
    if (word == "STEP") return begin_step(card);
    if (word == "BOUNDARY") return read_boundary(placed);
    if (word == "CLOAD") return read_forces(placed);
    if (word == "DLOAD" || word == "DSLOAD") return read_pressures(placed);
    if (word == "AMPLITUDE") return read_amplitude(card);
    if (word == "TIE" || word == "CONTACTPAIR") return read_joint(card);
    if (word == "STATIC" || word == "DYNAMIC" || word == "FREQUENCY") return read_procedure(card);
    if (word == "CYCLICSYMMETRYMODEL") return;  // read with its tie
    if (word == "SELECTCYCLICSYMMETRYMODES") return note_diameters(card);
    if (word == "INITIALCONDITIONS" && in_capitals(card.option("TYPE")) == "TEMPERATURE")
      return read_temperatures(placed, analysis_.temperatures);
    if (word == "TEMPERATURE") return read_step_temperatures(placed);
    if (word == "TRANSFORM") return note_transform(placed);
    if (word == "EQUATION" || word == "MPC" || word == "SPRING" || word == "DASHPOT") {
      if (!analysis_.steps.empty()) return leave(card, "in a step");
      return constraints_.read(placed, turned_);
    }
    if (word == "CLEARANCE") return note_clearance(card);
    if (word == "PRE-TENSIONSECTION") return;  // read before all others
    if (word == "MASS") return references_.read_mass(placed);
    if (!silent.contains(word) && !AbaqusReferences::has_read(word)) leave(card, "a deck has no word for it");
  }

  void leave(const FileCard& card, const std::string& why) {
    analysis_.untranslated.push_back(fmt::format("{}: {}: {}", file_.where(card), card.written, why));
  }

  std::vector<FileAction>& actions() {
    return analysis_.steps.empty() ? analysis_.before : analysis_.steps.back().actions;
  }

  void begin_step(const FileCard& card) {
    AbaqusStep step;
    step.where = file_.where(card);
    step.is_perturbation = card.has("PERTURBATION");
    if (card.has("NLGEOM") && in_capitals(card.option("NLGEOM")) != "NO")
      analysis_.remarks.push_back(fmt::format(
          "{}: NLGEOM: displacements are small in this program, and the run warns where they are not", step.where));
    analysis_.steps.push_back(step);
  }

  void read_procedure(const FileCard& card) {
    if (analysis_.steps.empty()) file_.fail(card, "it stands before the first *STEP");
    AbaqusStep& step = analysis_.steps.back();
    step.procedure = card.keyword;
    step.is_explicit = card.has("EXPLICIT");
    if (!card.data.empty()) {
      LineFields fields(file_, card.data[0]);
      for (std::string_view field; fields.next(field);)
        step.numbers.push_back(field.empty() ? 0.0 : fields.real_of(field, "a number"));
    }
  }

  void note_transform(const PlacedCard& placed) {
    const FileCard& card = *placed.card;
    const std::string set = card.option("NSET"), type = in_capitals(card.option("TYPE"));
    if (!type.empty() && type != "R" && type != "C") return leave(card, "TYPE = " + type);
    if (card.data.empty()) file_.fail(card, "it has no line with two points");
    LineFields fields(file_, card.data[0]);
    std::array<Vec3, 2> points;
    for (Vec3& point : points)
      for (double& x : point) x = fields.real("a coordinate");
    const DataLine line{set, card.file, card.line};
    for (const int node : model_.nodes_of(*placed.scope, LineFields(file_, line), set))
      turned_[node] = axes_of_node(file_, card, type == "C", points, model_.model().nodes[static_cast<size_t>(node)]);
  }

  // The OP of a card, which holds for its kind in the step.
  void note_op(const FileCard& card, bool AbaqusStep::*drops) {
    if (analysis_.steps.empty() || in_capitals(card.option("OP")) != "NEW") return;
    analysis_.steps.back().*drops = true;
  }

  struct Listed {
    DataLine line;
    std::string set;
    std::vector<int> nodes;
  };
  // Lines of a card by what they say: those of one saying and no set are one place.
  using Sayings = std::map<std::pair<std::string, std::array<double, 6>>, Listed>;

  void note(Sayings& sayings, const PlacedCard& placed, const DataLine& line, std::string_view field,
            const std::array<double, 6>& says) {
    std::vector<int> nodes = model_.nodes_of(*placed.scope, LineFields(file_, line), field);
    if (note_turned(sayings, placed, line, says, nodes)) return;
    if (placed.card->keyword == "BOUNDARY" && analysis_.steps.empty() && constraints_.hold_ends(says, nodes)) return;
    const std::string set = is_whole(field) || !placed.scope->instance.empty() ? "" : std::string(field);
    Listed& listed = sayings.try_emplace({set, says}, Listed{line, set, {}}).first->second;
    listed.nodes.insert(listed.nodes.end(), nodes.begin(), nodes.end());
  }

  // The same of nodes in axes of *TRANSFORM, if there are any: along the axes of the file.
  bool note_turned(Sayings& sayings, const PlacedCard& placed, const DataLine& line, const std::array<double, 6>& says,
                   const std::vector<int>& nodes) {
    const auto is_turned = [&](int node) { return turned_.contains(node); };
    const Vec3 by(says[3], says[4], says[5]);
    const bool is_held = placed.card->keyword == "BOUNDARY", is_whole = says[0] != 0 && says[1] != 0 && says[2] != 0;
    if (std::none_of(nodes.begin(), nodes.end(), is_turned) || (is_held && is_whole && by.isZero(0.0))) return false;
    for (const int node : nodes) {
      const Mat3 axes = is_turned(node) ? turned_.at(node) : Mat3(Mat3::Identity());
      const HeldInAxes turned =
          is_held ? held_in(axes, says, file_.where(line.file, line.line)) : HeldInAxes{forced_in(axes, by), {}};
      for (const Vec3& along : turned.oblique) note_oblique(placed, line, along, node);
      if (turned.says != AxesSaying{})
        sayings.try_emplace({"", turned.says}, Listed{line, "", {}}).first->second.nodes.push_back(node);
    }
    return true;
  }

  // Nodes that are held along one direction that is no axis of the file.
  void note_oblique(const PlacedCard& placed, const DataLine& line, const Vec3& along, int node) {
    if (!analysis_.steps.empty())
      LineFields(file_, line)
          .fail("*BOUNDARY: a node is held in a step along axes of *TRANSFORM that are none of the file's");
    constexpr double same = 1e-5;  // as far as the digits of a file go
    const auto fits = [&](const Oblique& one) { return one.card == placed.card && (one.along - along).norm() < same; };
    const auto known = std::find_if(obliques_.begin(), obliques_.end(), fits);
    Oblique& oblique =
        known == obliques_.end() ? obliques_.emplace_back(Oblique{placed.card, line, along, {}}) : *known;
    oblique.nodes.insert(node);
  }

  void set_obliques() {
    for (const Oblique& oblique : obliques_) {
      const std::string n = std::to_string(analysis_.obliques.size() + 1);
      const auto set = [&](const std::string& called, const std::vector<int>& nodes) {
        return place_of(model_.model(), fmt::format("oblique {} {}", n, called), oblique.line, nodes);
      };
      ObliqueHold hold{set("of", {oblique.nodes.begin(), oblique.nodes.end()}),
                       {},
                       oblique.along,
                       file_.where(oblique.line.file, oblique.line.line)};
      for (const int node : oblique.nodes)
        hold.nodes.push_back(set(fmt::format("by {}", hold.nodes.size() + 1), {node}));
      analysis_.obliques.push_back(std::move(hold));
    }
  }

  std::string name_of_set(const PlacedCard& placed, const std::string& set) {
    const auto found = placed.scope->node_sets.find(in_capitals(set));
    return found == placed.scope->node_sets.end() ? "" : found->second.name;
  }

  void add_actions(const PlacedCard& placed, FileAction::Kind kind, const std::string& prefix, const Sayings& sayings) {
    std::map<std::pair<int, int>, int> of_line;
    for (const auto& [key, listed] : sayings) {
      const auto& says = key.second;
      FileAction action{kind, "", {says[3], says[4], says[5]}, {says[0] != 0, says[1] != 0, says[2] != 0}, "", "", 0};
      if (kind == FileAction::Kind::held && !action.value.isZero(0.0)) action.kind = FileAction::Kind::moved;
      action.stays = placed.card->has("FIXED");
      action.where = file_.where(listed.line.file, listed.line.line);
      action.amplitude = placed.card->option("AMPLITUDE");
      action.place = listed.set.empty() ? "" : name_of_set(placed, listed.set);
      if (action.place.empty()) {
        const int n = ++of_line[{listed.line.file, listed.line.line}];  // sayings in axes of *TRANSFORM
        action.place =
            place_of(model_.model(), n == 1 ? prefix : fmt::format("{} ({})", prefix, n), listed.line, listed.nodes);
      }
      std::set<int> once(listed.nodes.begin(), listed.nodes.end());
      action.n_nodes = static_cast<int>(once.size());
      actions().push_back(action);
    }
  }

  // Directions of each node of a card together: a node that is held along x in one line and along y in another is one
  // that is held along both.
  void read_boundary(const PlacedCard& placed) {
    const FileCard& card = *placed.card;
    note_op(card, &AbaqusStep::drops_supports);
    if (const std::string type = in_capitals(card.option("TYPE")); !type.empty() && type != "DISPLACEMENT")
      return leave(card, "TYPE = " + type);
    std::map<std::string, std::array<double, 6>> by_field;
    std::map<std::string, const DataLine*> line_of;
    std::vector<std::string> order;
    for (const DataLine& line : card.data) {
      LineFields fields(file_, line);
      std::string_view what, first, last, value;
      fields.next(what);
      fields.next(first);
      if (!fields.next(last) || last.empty()) last = first;
      const auto [from, to] = directions(fields, first, last);
      const double by = fields.next(value) && !value.empty() ? fields.real_of(value, "a displacement") : 0.0;
      if (is_of_reference(placed, line, true, what, {from, to}, by)) continue;
      const auto [known, is_new] = by_field.try_emplace(std::string(what), std::array<double, 6>{});
      if (is_new) order.emplace_back(what);
      line_of.try_emplace(std::string(what), &line);
      for (long d = from; d <= std::min(to, 3L); ++d) {
        known->second[static_cast<size_t>(d) - 1] = 1;
        known->second[static_cast<size_t>(d) + 2] = by;
      }
    }
    Sayings sayings;
    for (const std::string& what : order)
      if (by_field.at(what)[0] + by_field.at(what)[1] + by_field.at(what)[2] > 0)
        note(sayings, placed, *line_of.at(what), what, by_field.at(what));
    add_actions(placed, FileAction::Kind::held, "boundary", sayings);
  }

  std::pair<long, long> directions(const LineFields& fields, std::string_view first, std::string_view last) const {
    constexpr long last_rotation = 6;
    const std::string word = in_capitals(first);
    if (word == "ENCASTRE" || word == "PINNED") return {1, 3};
    for (const auto& [name, d] : {std::pair("XSYMM", 1L), std::pair("YSYMM", 2L), std::pair("ZSYMM", 3L)})
      if (word == name) return {d, d};
    const long from = fields.whole_of(first, "a direction 1 ... 6"), to = fields.whole_of(last, "a direction 1 ... 6");
    if (from < 1 || to < from || to > last_rotation)
      fields.fail(fmt::format("*BOUNDARY: directions {} to {}: displacements are 1 to 3", from, to));
    return {from, to};
  }

  void read_forces(const PlacedCard& placed) {
    note_op(*placed.card, &AbaqusStep::drops_loads);
    Sayings sayings;
    for (const DataLine& line : placed.card->data) {
      LineFields fields(file_, line);
      std::string_view what;
      fields.next(what);
      const long d = fields.whole("a direction");
      const double by = fields.real("a force");
      if (d >= 1 && d <= 6 && is_of_reference(placed, line, false, what, {d, d}, by)) continue;
      if (d < 1 || d > 3) fields.fail(fmt::format("*CLOAD: direction {}: forces are along 1 to 3", d));
      std::array<double, 6> says{};
      says[static_cast<size_t>(d) - 1] = 1;
      says[static_cast<size_t>(d) + 2] = by;
      if (by != 0.0) note(sayings, placed, line, what, says);
    }
    add_actions(placed, FileAction::Kind::force, "cload", sayings);
  }

  bool is_of_reference(const PlacedCard& placed, const DataLine& line, bool is_held, std::string_view what,
                       std::pair<long, long> directions, double by) {
    const std::vector<int> nodes = model_.nodes_of(*placed.scope, LineFields(file_, line), what);
    std::optional<FileAction> tightened;
    if (pretensions_.read(placed, line, nodes, directions, by, tightened)) {
      if (tightened) actions().push_back(*tightened);
      return true;
    }
    const bool is_turned = std::any_of(nodes.begin(), nodes.end(), [&](int node) { return turned_.contains(node); });
    if (!references_.read({placed, line, static_cast<int>(analysis_.steps.size()) - 1}, is_held, nodes, directions, by))
      return false;
    if (is_turned) leave(*placed.card, "a reference node in axes of *TRANSFORM");
    return true;
  }

  FileAction pressure(const FileCard& card, double by, const DataLine& line) const {
    return {FileAction::Kind::pressure,        "", {by, 0, 0}, {}, card.option("AMPLITUDE"),
            file_.where(line.file, line.line), 0};
  }

  void add_loaded(const FileCard& card, const LoadedFacets& loaded) {
    std::set<std::string> names;
    for (const auto& [value, line, facets] : loaded.by_value()) {
      FileAction action = pressure(card, value, *line);
      action.place =
          line->file > 0 ? fmt::format("dload {}.{}", line->file, line->line) : fmt::format("dload {}", line->line);
      while (!names.insert(action.place).second) action.place += " and";  // several sums of one line
      model_.model().surfaces.push_back({action.place, facets, action.where});
      actions().push_back(action);
    }
  }

  void read_pressures(const PlacedCard& placed) {
    const FileCard& card = *placed.card;
    note_op(card, &AbaqusStep::drops_loads);
    LoadedFacets loaded;
    for (const DataLine& line : card.data) {
      LineFields fields(file_, line);
      std::string_view what, label;
      fields.next(what);
      fields.next(label);
      const double by = fields.real("a load");
      const std::string kind = in_capitals(label);
      if (kind == "GRAV" || kind == "CENTRIF") {
        add_on_all(placed, fields, what, by, kind, line);
        continue;
      }
      const bool is_surface = card.keyword == "DSLOAD";
      if (is_surface ? kind != "P" : kind.size() != 2 || kind[0] != 'P' || !is_whole(kind.substr(1)))
        fields.fail(fmt::format("{}: a load '{}' has no word in a deck", card.written, kind));
      if (is_surface) {
        FileAction action = pressure(card, by, line);
        action.place = std::string(what);
        actions().push_back(action);
        continue;
      }
      for (const ForeignFacet& facet : model_.facets_of(model_.cells_of(*placed.scope, fields, what), label, line))
        loaded.add(facet, by, line);
    }
    add_loaded(card, loaded);
  }

  void add_on_all(const PlacedCard& placed, LineFields& fields, std::string_view what, double by,
                  const std::string& kind, const DataLine& line) {
    const bool is_spin = kind == "CENTRIF";
    if (model_.cells_of(*placed.scope, fields, what).size() != model_.model().cells.size())
      fields.fail(
          fmt::format("*DLOAD: {} on some of the cells: load.{} acts on all", kind, is_spin ? "spin" : "gravity"));
    const auto vector = [&](const char* of) { return Vec3{fields.real(of), fields.real(of), fields.real(of)}; };
    FileAction action{is_spin ? FileAction::Kind::spin : FileAction::Kind::gravity,
                      "",
                      Vec3::Zero(),
                      {},
                      placed.card->option("AMPLITUDE"),
                      file_.where(line.file, line.line),
                      0};
    if (is_spin) {
      if (by < 0.0) fields.fail("*DLOAD: CENTRIF: the square of a speed is expected");
      if (!action.amplitude.empty()) fields.fail("*DLOAD: CENTRIF with an amplitude has no word in a deck");
      action.speed = std::sqrt(by);
      action.through = vector("a coordinate");
    }
    action.value = (is_spin ? 1.0 : by) * vector("a direction").normalized();
    actions().push_back(action);
  }

  void read_temperatures(const PlacedCard& placed, std::map<int, double>& temperatures) {
    for (const DataLine& line : placed.card->data) {
      LineFields fields(file_, line);
      std::string_view what;
      fields.next(what);
      const double by = fields.real("a temperature");
      for (const int node : model_.nodes_of(*placed.scope, LineFields(file_, line), what)) temperatures[node] = by;
    }
  }

  void read_step_temperatures(const PlacedCard& placed) {
    if (analysis_.steps.empty()) file_.fail(*placed.card, "it stands before the first *STEP");
    AbaqusStep& step = analysis_.steps.back();
    step.temperatures_where = file_.where(*placed.card);
    read_temperatures(placed, step.temperatures);
  }

  void read_amplitude(const FileCard& card) {
    for (const char* option : {"TIME", "VALUE", "DEFINITION", "USER"})
      if (card.has(option) && in_capitals(card.option(option)) != "TABULAR" &&
          in_capitals(card.option(option)) != "STEPTIME")
        return leave(card, fmt::format("{} = {}", option, card.option(option)));
    std::vector<double>& numbers = analysis_.amplitudes[in_capitals(card.option("NAME"))];
    for (const DataLine& line : card.data) {
      LineFields fields(file_, line);
      for (std::string_view field; fields.next(field);)
        if (!field.empty()) numbers.push_back(fields.real_of(field, "a time or a value"));
    }
  }

  void read_joint(const FileCard& card) {
    AbaqusJoint joint;
    joint.is_tie = card.keyword == "TIE";
    joint.where = file_.where(card);
    joint.is_adjusted = card.has("ADJUST");
    if (card.has("MULTISTAGE")) return leave(card, "it joins sectors of different rings");
    if (card.has("CYCLICSYMMETRY")) {
      joint.ring = ring_of(file_, card);
      is_sector_ = true;
    }
    if (!joint.is_tie) note_interaction(card.option("INTERACTION"), joint);
    for (const DataLine& line : card.data) {
      LineFields fields(file_, line);
      joint.one = fields.name("a surface");
      joint.other = fields.name("a surface");
      analysis_.joints.push_back(joint);
    }
  }

  void note_clearance(const FileCard& card) {
    const std::string value = card.option("VALUE");
    const DataLine line{value, card.file, card.line};
    if (!analysis_.steps.empty()) return leave(card, "in a step");
    const double clearance = LineFields(file_, line).real_of(value, "VALUE = a distance");
    if (clearance < 0.0) return leave(card, "an overlap");
    clearances_.push_back({&card, clearance, false});
  }

  // Contact pairs are of two surfaces, in either order.
  void set_clearances() {
    for (Clearance& clearance : clearances_) {
      const std::string master = in_capitals(clearance.card->option("MASTER")),
                        slave = in_capitals(clearance.card->option("SLAVE"));
      for (AbaqusJoint& joint : analysis_.joints) {
        const std::string one = in_capitals(joint.one), other = in_capitals(joint.other);
        if (joint.is_tie || !((one == slave && other == master) || (one == master && other == slave))) continue;
        joint.clearance = clearance.by;
        clearance.is_met = true;
      }
      if (!clearance.is_met) leave(*clearance.card, "there is no contact between its surfaces");
    }
  }

  // Modes of all sectors alike are those of nodal diameter 0.
  void note_diameters(const FileCard& card) {
    for (const char* end : {"NMIN", "NMAX"})
      if (!card.has(end) || card.option(end) != "0")
        return leave(card, "modes that differ from sector to sector: a deck has those of nodal diameter 0");
    if (!analysis_.steps.empty()) analysis_.steps.back().is_of_diameter_0 = true;
  }

  // *FRICTION and *SURFACE BEHAVIOR below the *SURFACE INTERACTION of that name.
  void note_interaction(const std::string& interaction, AbaqusJoint& joint) {
    bool is_it = false;
    for (const FileCard& card : file_.cards()) {
      if (card.keyword == "SURFACEINTERACTION") is_it = in_capitals(card.option("NAME")) == in_capitals(interaction);
      if (is_it && card.keyword == "SURFACEBEHAVIOR") {
        const std::string kind = in_capitals(card.option("PRESSURE-OVERCLOSURE"));
        joint.is_tie = kind == "TIED";
        if (kind != "HARD")
          analysis_.remarks.push_back(fmt::format("{}: {} contact is {} here", file_.where(card), printable(kind),
                                                  joint.is_tie ? "a bond" : "hard"));
      }
      if (!is_it || card.keyword != "FRICTION" || card.data.empty()) continue;
      LineFields fields(file_, card.data[0]);
      joint.friction = std::min(fields.real("a coefficient of friction"), rough);
    }
  }

  struct Oblique {
    const FileCard* card;
    DataLine line;
    Vec3 along;
    std::set<int> nodes;
  };
  struct Clearance {
    const FileCard* card;
    double by;
    bool is_met;
  };

  AbaqusModel& model_;
  const CardFile& file_;
  AbaqusAnalysis analysis_;
  std::vector<Clearance> clearances_;
  std::vector<Oblique> obliques_;
  bool is_sector_ = false;      // of a ring
  std::map<int, Mat3> turned_;  // axes of the nodes of *TRANSFORM
  AbaqusConstraints constraints_;
  AbaqusReferences references_;
  AbaqusPretensions pretensions_;
};

}  // namespace

AbaqusAnalysis analysis_of(AbaqusModel& model) { return AnalysisReader(model).read(); }

}  // namespace dygita
