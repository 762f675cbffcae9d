// *RIGID BODY and *COUPLING. One source, since a card, a held direction, a force and a mass each add to what others
// have said of the same reference node; hence longer than most.
#include "foreign/abaqus_references.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "foreign/abaqus_steps.hpp"
#include "mesh/cell_types.hpp"
#include "numerics/dense.hpp"

namespace dygita {

namespace {

constexpr double at_one_place = 1e-6;  // of the size of what is around

// All nodes of a facet, those between its corners too.
void add_nodes_of(const ForeignModel& model, const ForeignFacet& facet, std::vector<int>& nodes) {
  const ForeignCell& cell = model.cells[static_cast<size_t>(facet.cell)];
  const int* all = model.nodes_of(cell);
  const auto n_corners = std::count_if(facet.corners.begin(), facet.corners.end(), [](int node) { return node >= 0; });
  for (const LocalFacet& local : cell_shape(cell.type).facets) {
    const auto n_met = std::count_if(facet.corners.begin(), facet.corners.end(), [&](int corner) {
      const auto end = local.nodes.begin() + nodes_per_facet(local.type);
      return corner >= 0 && std::any_of(local.nodes.begin(), end, [&](int a) { return all[a] == corner; });
    });
    if (n_met != n_corners || facet_shape(local.type).n_corners != n_corners) continue;
    for (int a = 0; a < nodes_per_facet(local.type); ++a) nodes.push_back(all[local.nodes[static_cast<size_t>(a)]]);
  }
}

bool any(const std::array<bool, 6>& of) {
  return std::any_of(of.begin(), of.end(), [](bool is) { return is; });
}

bool all(const std::array<bool, 6>& of) {
  return std::all_of(of.begin(), of.end(), [](bool is) { return is; });
}

}  // namespace

AbaqusReferences::AbaqusReferences(AbaqusModel& model) : model_(model), file_(model.file()) {
  const std::vector<PlacedCard>& cards = model.cards();
  for (size_t i = 0; i < cards.size(); ++i) {
    const std::string& word = cards[i].card->keyword;
    try {
      if (word == "RIGIDBODY") add_rigid_body(cards[i]);
      if (word == "COUPLING") add_coupling(cards[i], i + 1 < cards.size() ? cards[i + 1].card : nullptr);
    } catch (const InputError& error) {
      untranslated_.emplace_back(error.what());
    }
  }
}

bool AbaqusReferences::has_read(const std::string& keyword) {
  return keyword == "RIGIDBODY" || keyword == "COUPLING" || keyword == "KINEMATIC" || keyword == "DISTRIBUTING";
}

int AbaqusReferences::node_of(const PlacedCard& placed, const char* option) const {
  const std::string given = placed.card->option(option);
  const LineFields fields(file_, {given, placed.card->file, placed.card->line});
  if (given.empty()) file_.fail(*placed.card, fmt::format("{} = a node is expected", option));
  const std::vector<int> nodes = model_.nodes_of(*placed.scope, fields, given);
  if (nodes.size() != 1) file_.fail(*placed.card, fmt::format("{}: one node is expected", option));
  return nodes[0];
}

void AbaqusReferences::add_rigid_body(const PlacedCard& placed) {
  const FileCard& card = *placed.card;
  const DataLine line{"", card.file, card.line};
  Reference reference{&card, node_of(placed, "REFNODE"), card.has("ROTNODE") ? node_of(placed, "ROTNODE") : -1,
                      false, {true, true, true},         "",
                      {}};
  const LineFields fields(file_, line);
  if (card.has("NSET")) reference.feet = model_.nodes_of(*placed.scope, fields, card.option("NSET"));
  if (card.has("ELSET"))
    for (const int c : model_.cells_of(*placed.scope, fields, card.option("ELSET"))) {
      const ForeignCell& cell = model_.model().cells[static_cast<size_t>(c)];
      const int* nodes = model_.model().nodes_of(cell);
      reference.feet.insert(reference.feet.end(), nodes, nodes + nodes_per_cell(cell.type));
    }
  reference.place = place_of(model_.model(), "rigid body", line, reference.feet);
  reference.feet = model_.model().node_sets.back().nodes;
  choose_three(reference);
  of_node_[reference.node] = {references_.size(), false};
  if (reference.turning >= 0 && reference.turning != reference.node)
    of_node_[reference.turning] = {references_.size(), true};
  references_.push_back(std::move(reference));
}

void AbaqusReferences::add_coupling(const PlacedCard& placed, const FileCard* kind) {
  const FileCard& card = *placed.card;
  if (!kind || (kind->keyword != "KINEMATIC" && kind->keyword != "DISTRIBUTING"))
    file_.fail(card, "*KINEMATIC or *DISTRIBUTING is expected below it");
  Reference reference{&card, node_of(placed, "REFNODE"), -1, kind->keyword == "DISTRIBUTING", {}, "", {}};
  for (const DataLine& line : kind->data) {
    LineFields fields(file_, line);
    const long from = fields.whole("a direction 1 ... 6"), to = fields.is_at_end() ? from : fields.whole("a direction");
    if (from < 1 || to < from || to > 6) fields.fail(fmt::format("directions {} to {}: they are 1 to 6", from, to));
    for (long d = from; d <= std::min(to, 3L); ++d) reference.along[static_cast<size_t>(d) - 1] = true;
  }
  if (kind->data.empty()) reference.along = {true, true, true};
  if (reference.is_mean && reference.along != std::array<bool, 3>{true, true, true})
    file_.fail(*kind, "its node follows in some directions alone");
  take_surface(card.option("SURFACE"), reference);
  if (reference.feet.empty()) file_.fail(card, fmt::format("there is no surface '{}'", card.option("SURFACE")));
  if (!reference.is_mean) {
    reference.place = place_of(model_.model(), "coupling", {"", card.file, card.line}, reference.feet);
    reference.feet = model_.model().node_sets.back().nodes;
  } else if (!(reference.area > 0.0)) {
    file_.fail(card, "*DISTRIBUTING over nodes: a surface of elements has areas, by which its nodes count");
  }
  choose_three(reference);
  if (!of_node_.emplace(reference.node, std::pair(references_.size(), false)).second)
    file_.fail(card, "its node is the reference of another *RIGID BODY or *COUPLING");
  references_.push_back(std::move(reference));
}

// Nodes, area and its middle of a surface; of one of nodes no area.
void AbaqusReferences::take_surface(const std::string& name, Reference& reference) {
  for (const ForeignFace& surface : model_.model().surfaces) {
    if (in_capitals(surface.name) != in_capitals(name)) continue;
    reference.place = surface.name;
    for (const ForeignFacet& facet : surface.facets) {
      add_nodes_of(model_.model(), facet, reference.feet);
      const auto& c = facet.corners;
      for (const std::array<int, 3>& triangle : {std::array{c[0], c[1], c[2]}, std::array{c[0], c[2], c[3]}}) {
        if (triangle[2] < 0) continue;
        const Vec3 &a = place(triangle[0]), &b = place(triangle[1]), &d = place(triangle[2]);
        const double area = (b - a).cross(d - a).norm() / 2;
        reference.area += area;
        reference.middle += area * (a + b + d) / 3;
      }
    }
    reference.middle /= reference.area;
    return;
  }
  for (const ForeignSet& set : model_.model().node_sets)
    if (in_capitals(set.name) == in_capitals(name)) reference.feet = set.nodes;
}

double AbaqusReferences::size_of(const Reference& reference) const {
  double largest = 0.0;
  for (const int node : reference.feet) largest = std::max(largest, (place(node) - place(reference.feet[0])).norm());
  return largest;
}

// Three feet far apart: where they go, the rigid body goes.
void AbaqusReferences::choose_three(Reference& reference) {
  const std::vector<int>& feet = reference.feet;
  if (feet.size() < 3) file_.fail(*reference.card, "three nodes or more are expected");
  const auto farthest = [&](auto&& measure) {
    return *std::max_element(feet.begin(), feet.end(), [&](int a, int b) { return measure(a) < measure(b); });
  };
  const Vec3& x = place(feet[0]);
  const int b = farthest([&](int node) { return (place(node) - x).norm(); });
  const int c = farthest([&](int node) { return (place(node) - x).cross(place(b) - x).norm(); });
  if (!((place(c) - x).cross(place(b) - x).norm() > at_one_place * (place(b) - x).squaredNorm()))
    file_.fail(*reference.card, "its nodes are on one line");
  reference.three_nodes = {feet[0], b, c};
}

// Forces on the three feet, smallest in sum of squares, that come to a force and a moment (about the reference node).
// They weigh motions as well: their work in a rigid motion is that of the force and the moment.
std::vector<Vec3> AbaqusReferences::shared(const Reference& reference, const Vec3& force, const Vec3& moment) const {
  const double size = size_of(reference);
  Mat sums(6, 9);
  for (int i = 0; i < 3; ++i) {
    const Vec3 arm = (place(reference.three_nodes[static_cast<size_t>(i)]) - place(reference.node)) / size;
    for (int d = 0; d < 3; ++d) sums.col(3 * i + d) << Vec3(Vec3::Unit(d)), arm.cross(Vec3::Unit(d));
  }
  Vec given(6);
  given << force, moment / size;
  std::vector<Vec3> found;
  constexpr double rounding = 1e-12;
  const Vec forces = solve_least_norm(sums, given, rounding).x;
  for (int i = 0; i < 3; ++i) {
    Vec3 own = forces.segment<3>(3 * i);
    for (double& value : own)
      if (std::abs(value) < rounding * forces.norm()) value = 0.0;
    found.push_back(own);
  }
  return found;
}

bool AbaqusReferences::read(const Line& line, bool is_held, const std::vector<int>& nodes,
                            std::pair<long, long> directions, double by) {
  const LineFields fields(file_, line.data);
  const auto n = std::count_if(nodes.begin(), nodes.end(), [&](int node) { return of_node_.contains(node); });
  if (n == 0) return false;
  if (n < static_cast<long>(nodes.size()))
    fields.fail(fmt::format("{}: reference nodes and others in one set", line.placed.card->written));
  for (const int node : nodes) {
    const auto [i, turns] = of_node_.at(node);
    Reference& reference = references_[i];
    if (directions.second > 3 && (turns || reference.turning >= 0))
      fields.fail(
          fmt::format("{}: rotations and moments are directions 1 to 3 of the ROT NODE", line.placed.card->written));
    Said& said = reference.said[line.step];
    const DataLine*& at = is_held ? said.held_at : said.loaded_at;
    std::string& amplitude = is_held ? said.motion_amplitude : said.force_amplitude;
    const std::string own = is_held && by == 0.0 ? "" : line.placed.card->option("AMPLITUDE");
    if (at && !own.empty() && amplitude != own && !(is_held && amplitude.empty()))
      fields.fail(fmt::format("{}: several amplitudes on one reference node", line.placed.card->written));
    if (at && !is_held && amplitude != own)
      fields.fail(fmt::format("{}: several amplitudes on one reference node", line.placed.card->written));
    if (!own.empty() || !is_held) amplitude = own;
    if (!at) at = &line.data;
    for (long d = directions.first; d <= directions.second; ++d) {
      const auto k = static_cast<size_t>(d + (turns ? 3 : 0)) - 1;
      (is_held ? said.is_held : said.is_loaded)[k] = true;
      if (is_held)
        said.motion[k] = by;
      else
        said.force[k] += by;
    }
  }
  return true;
}

void AbaqusReferences::read_mass(const PlacedCard& placed) {
  const FileCard& card = *placed.card;
  const std::string set = in_capitals(card.option("ELSET"));
  if (card.data.empty()) file_.fail(card, "it has no mass");
  const double mass = LineFields(file_, card.data[0]).real("a mass");
  int n = 0;
  std::string others;
  for (const PlacedCard& other : model_.cards()) {
    if (other.card->keyword != "ELEMENT" || in_capitals(other.card->option("TYPE")) != "MASS" ||
        in_capitals(other.card->option("ELSET")) != set)
      continue;
    for (const DataLine& line : other.card->data) {
      LineFields fields(file_, line);
      fields.whole("the number of an element");
      const std::string number = fields.name("a node");
      const int node = model_.nodes_of(*other.scope, fields, number).at(0);
      const auto reference = of_node_.find(node);
      if (reference != of_node_.end() && !reference->second.second)
        references_[reference->second.first].mass += mass;
      else
        others = number;
      ++n;
    }
  }
  if (n == 0) file_.fail(card, "its set has no element of type MASS of its own");
  if (!others.empty())
    loose_masses_.push_back(
        fmt::format("{}: *MASS: node {} is no REF NODE: a mass is a body behind a face in a deck; give it to the REF "
                    "NODE of a *RIGID BODY or a *COUPLING, or to the density of its part",
                    file_.where(card), others));
}

void AbaqusReferences::finish(AbaqusAnalysis& analysis) {
  for (Reference& reference : references_) {
    try {
      say(reference, analysis);
    } catch (const InputError& error) {
      untranslated_.emplace_back(error.what());
    }
  }
  const auto weighs = [](const FileAction& action) { return action.is_everywhere(); };
  const bool needs_mass =
      std::any_of(analysis.before.begin(), analysis.before.end(), weighs) ||
      std::any_of(analysis.steps.begin(), analysis.steps.end(), [&](const AbaqusStep& step) {
        return step.procedure != "STATIC" || std::any_of(step.actions.begin(), step.actions.end(), weighs);
      });
  for (const std::string& told : loose_masses_)
    (needs_mass ? untranslated_ : analysis.remarks)
        .push_back(needs_mass ? told : told.substr(0, told.find("node")) + "statics without gravity depend on no mass");
  analysis.untranslated.insert(analysis.untranslated.end(), untranslated_.begin(), untranslated_.end());
}

void AbaqusReferences::say(Reference& reference, AbaqusAnalysis& analysis) {
  if (say_held(reference, analysis)) return;
  if (reference.along != std::array<bool, 3>{true, true, true})
    file_.fail(*reference.card, "it joins some directions alone: read where its REF NODE is held in all six");
  say_loads(reference, analysis);
  if (!reference.is_mean || reference.mass != 0.0) say_body(reference, analysis);
}

// True where its node is held, or moved, in all directions: all has been said, then.
bool AbaqusReferences::say_held(Reference& reference, AbaqusAnalysis& analysis) {
  Said all_said;
  bool is_before = true;
  for (const auto& [step, said] : reference.said) {
    if (!said.held_at) continue;
    const LineFields fields(file_, *said.held_at);
    if (step > 0) fields.fail("*BOUNDARY: a reference node is held or moved anew in a later step");
    is_before = step < 0;
    all_said.held_at = said.held_at;
    all_said.motion_amplitude = said.motion_amplitude;
    for (size_t d = 0; d < 6; ++d) {
      if (!said.is_held[d]) continue;
      all_said.is_held[d] = true;
      all_said.motion[d] = said.motion[d];
    }
  }
  if (!any(all_said.is_held)) return false;
  const LineFields fields(file_, *all_said.held_at);
  const Vec3 motion(all_said.motion[0], all_said.motion[1], all_said.motion[2]);
  const Vec3 rotation(all_said.motion[3], all_said.motion[4], all_said.motion[5]);
  if (!rotation.isZero(0.0)) fields.fail("*BOUNDARY: a rotation of a reference node is prescribed");
  if (reference.is_mean)
    fields.fail("*BOUNDARY: the node of a *DISTRIBUTING is held: support.equation holds the mean motion of a face");
  for (const AbaqusStep& step : analysis.steps)
    if (step.drops_supports && !(all(all_said.is_held) && motion.isZero(0.0)))
      fields.fail("*BOUNDARY: a reference node before OP = NEW");
  if (all(all_said.is_held)) {
    const bool is_moved = !motion.isZero(0.0);
    if (is_moved && reference.along != std::array<bool, 3>{true, true, true})
      fields.fail("*BOUNDARY: the node of a *KINEMATIC of some directions is moved");
    FileAction action{is_moved ? FileAction::Kind::moved : FileAction::Kind::held,
                      reference.place,
                      motion,
                      reference.along,
                      all_said.motion_amplitude,
                      where(*all_said.held_at),
                      static_cast<int>(reference.feet.size())};
    (is_before ? analysis.before : analysis.steps.front().actions).push_back(action);
    for (const auto& [step, said] : reference.said)
      if (said.loaded_at)
        analysis.remarks.push_back(where(*said.loaded_at) + ": *CLOAD on a node that is held moves nothing");
    if (reference.mass != 0.0)
      analysis.remarks.push_back(file_.where(*reference.card) + ": the mass of its node is held, and moves nothing");
    return true;
  }
  if (!motion.isZero(0.0))
    fields.fail("*BOUNDARY: a reference node is moved: read where all six of its directions are given");
  for (size_t d = 0; d < 6; ++d) {
    if (!all_said.is_held[d]) continue;
    const Vec3 axis = Vec3::Unit(static_cast<long>(d) % 3), none = Vec3::Zero();
    const std::vector<Vec3> weights = shared(reference, d < 3 ? axis : none, d < 3 ? none : axis);
    AbaqusEquation equation;
    equation.where = where(*all_said.held_at);
    for (size_t i = 0; i < weights.size(); ++i)
      if (!weights[i].isZero(0.0)) equation.terms.push_back({foot(reference, i), 1.0, weights[i]});
    analysis.equations.push_back(std::move(equation));
  }
  return false;
}

// The set of a foot of the three.
std::string AbaqusReferences::foot(Reference& reference, size_t i) {
  if (reference.three.empty())
    for (size_t k = 0; k < 3; ++k)
      reference.three.push_back(place_of(model_.model(), fmt::format("foot {} of", k + 1),
                                         {"", reference.card->file, reference.card->line}, {reference.three_nodes[k]}));
  return reference.three[i];
}

void AbaqusReferences::say_loads(Reference& reference, AbaqusAnalysis& analysis) {
  const Said* before = nullptr;
  for (const auto& [step, said] : reference.said) {
    if (!said.loaded_at) continue;
    const LineFields fields(file_, *said.loaded_at);
    if (before && before->is_loaded != said.is_loaded)
      fields.fail("*CLOAD: other directions of a reference node than in a step before");
    before = &said;
    const Vec3 force(said.force[0], said.force[1], said.force[2]);
    const Vec3 moment = model_.unit() * Vec3(said.force[3], said.force[4], said.force[5]);
    if (force.isZero(0.0) && moment.isZero(0.0)) continue;
    FileAction action{FileAction::Kind::force, "", force, {}, said.force_amplitude, where(*said.loaded_at), 1};
    action.owner = reference.node;
    std::vector<FileAction>& actions = step < 0 ? analysis.before : analysis.steps[static_cast<size_t>(step)].actions;
    const auto add = [&](const std::string& place, const Vec3& value) {
      action.place = place;
      action.value = value;
      for (int d = 0; d < 3; ++d) action.along[static_cast<size_t>(d)] = value[d] != 0.0;
      actions.push_back(action);
    };
    if (reference.is_mean) {
      if (!moment.isZero(0.0) || (place(reference.node) - reference.middle).norm() > at_one_place * size_of(reference))
        fields.fail(
            "*CLOAD: a moment on the node of a *DISTRIBUTING, or a force off the middle of its surface: load.force and "
            "load.torque on the face say them");
      action.kind = FileAction::Kind::resultant;
      add(reference.place, force);
      continue;
    }
    const std::vector<Vec3> forces = shared(reference, force, moment);
    for (size_t i = 0; i < forces.size(); ++i)
      if (!forces[i].isZero(0.0)) add(foot(reference, i), forces[i]);
  }
}

void AbaqusReferences::say_body(const Reference& reference, AbaqusAnalysis& analysis) {
  constexpr double point = 1e-3;  // of the feet's size: a millionth of their inertia with the same mass
  const double size = size_of(reference) / model_.unit(), radius = reference.mass != 0.0 ? point * size : size;
  FileBody body{reference.place,
                reference.mass,
                radius * radius * Mat3::Identity(),
                place(reference.node) / model_.unit(),
                reference.is_mean,
                file_.where(*reference.card)};
  if (reference.mass != 0.0) {
    body.inertia *= reference.mass;
    analysis.remarks.push_back(
        fmt::format("{}: its mass has no moments of inertia: those of a ball of a thousandth of the size of its nodes "
                    "take their place",
                    body.where));
  } else {
    analysis.remarks.push_back(body.where + ": no mass: a microgram takes its place");
  }
  body.weights = "area";
  analysis.bodies.push_back(std::move(body));
}

}  // namespace dygita
