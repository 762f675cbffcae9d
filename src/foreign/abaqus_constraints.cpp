#include "foreign/abaqus_constraints.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/names.hpp"
#include "numerics/frame_along.hpp"

namespace dygita {

std::string place_of(ForeignModel& model, const std::string& prefix, const DataLine& line, std::vector<int> nodes) {
  const std::string file = line.file == 0 ? "" : fmt::format("{}.", line.file);
  std::string name = fmt::format("{} {}{}", prefix, file, line.line);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  model.node_sets.push_back({name, std::move(nodes)});
  return name;
}

AbaqusConstraints::AbaqusConstraints(AbaqusModel& model) : model_(model), file_(model.file()) { find_loose_ends(); }

void AbaqusConstraints::read(const PlacedCard& placed, const std::map<int, Mat3>& turned) {
  turned_ = turned;
  if (placed.card->keyword == "EQUATION") return read_equations(placed);
  if (placed.card->keyword == "MPC") return read_constraints(placed);
  read_spring(placed);
}

void AbaqusConstraints::finish(std::vector<FileSpring>& springs, std::vector<std::string>& untranslated) {
  for (const Spring& spring : springs_) {
    try {
      add_spring(spring, springs);
    } catch (const InputError& error) {
      untranslated.emplace_back(error.what());
    }
  }
}

// Numbers that go on over as many lines as they need: how many terms, and of each a node, a direction and a factor.
void AbaqusConstraints::read_equations(const PlacedCard& placed) {
  const FileCard& card = *placed.card;
  const DataLine* first = nullptr;
  size_t n_fields = 0;
  Given given;
  Terms last;
  for (const DataLine& line : card.data) {
    LineFields fields(file_, line);
    if (n_fields == 0) {
      const long n = fields.whole("how many terms");
      if (n < 2) fields.fail("*EQUATION: it has two terms or more");
      first = &line;
      n_fields = 3 * static_cast<size_t>(n);
      continue;
    }
    for (std::string_view field; given.size() < n_fields && fields.next(field);) given.emplace_back(&line, field);
    if (given.size() < n_fields) continue;
    add_equation(placed, *first, given, last);
    given.clear();
    n_fields = 0;
  }
  if (n_fields > 0) file_.fail(*first, "*EQUATION: its terms end too early");
}

void AbaqusConstraints::add_equation(const PlacedCard& placed, const DataLine& first, const Given& given, Terms& last) {
  std::map<int, Vec3> of_nodes;
  std::set<std::pair<int, long>> seen;
  std::set<long> axes;
  constexpr double rounding = 1e-12;
  for (size_t i = 0; i < given.size(); i += 3) {
    const LineFields fields(file_, *given[i].first);
    const long d = fields.whole_of(given[i + 1].second, "a direction");
    if (d < 1 || d > 3) fields.fail(fmt::format("*EQUATION: direction {}: displacements are 1 to 3", d));
    const std::vector<int> nodes = model_.nodes_of(*placed.scope, fields, given[i].second);
    if (nodes.size() != 1) fields.fail("*EQUATION: each term is of one node");
    if (!seen.emplace(nodes[0], d).second) fields.fail("*EQUATION: a node twice along one axis");
    const auto own = turned_.find(nodes[0]);
    const Vec3 axis = own == turned_.end() ? Vec3(Vec3::Unit(d - 1)) : Vec3(own->second.col(d - 1));
    for (long k = 0; k < 3; ++k)
      if (std::abs(axis[k]) > rounding) axes.insert(k);
    of_nodes.try_emplace(nodes[0], Vec3::Zero()).first->second +=
        fields.real_of(given[i + 2].second, "a factor") * axis;
  }
  if (axes.size() > 1) return add_along_axes(first, of_nodes);
  Terms terms;
  terms.axis = static_cast<int>(*axes.begin());
  const auto axis = static_cast<size_t>(terms.axis);
  for (const auto& [node, factors] : of_nodes) terms.nodes[factors[terms.axis]].push_back(node);
  if (note_end(terms)) return;
  if (terms == last && !equations.back().along[axis]) {
    equations.back().along[axis] = true;
    return;
  }
  last = terms;
  AbaqusEquation equation;
  equation.where = file_.where(first.file, first.line);
  equation.along[axis] = true;
  for (const auto& [factor, nodes] : terms.nodes) {
    const std::string which = fmt::format("equation {}", equation.terms.size() + 1);
    if (factor != 0.0)
      equation.terms.push_back(
          {place_of(model_.model(), which, first, nodes), factor * static_cast<double>(nodes.size())});
  }
  equations.push_back(std::move(equation));
}

// Terms along several axes: a place for the nodes of each factor.
void AbaqusConstraints::add_along_axes(const DataLine& first, const std::map<int, Vec3>& of_nodes) {
  std::map<std::array<double, 3>, std::vector<int>> alike;
  for (const auto& [node, factors] : of_nodes)
    if (!factors.isZero(0.0)) alike[{factors[0], factors[1], factors[2]}].push_back(node);
  AbaqusEquation equation;
  equation.where = file_.where(first.file, first.line);
  for (const auto& [factors, nodes] : alike)
    equation.terms.push_back(
        {place_of(model_.model(), fmt::format("equation {}", equation.terms.size() + 1), first, nodes),
         static_cast<double>(nodes.size()), Vec3(factors[0], factors[1], factors[2])});
  equations.push_back(std::move(equation));
}

// Nodes of springs and dashpots that no cell has.
void AbaqusConstraints::find_loose_ends() {
  const std::set<int> of_cells(model_.model().connectivity.begin(), model_.model().connectivity.end());
  for (const PlacedCard& placed : model_.cards()) {
    const std::string type = in_capitals(placed.card->option("TYPE"));
    if (placed.card->keyword != "ELEMENT" || !(type.starts_with("SPRING") || type.starts_with("DASHPOT"))) continue;
    for (const DataLine& line : placed.card->data) {
      LineFields fields(file_, line);
      std::string_view field;
      fields.next(field);
      while (fields.next(field))
        if (const auto node = placed.scope->nodes.find(fields.whole_of(field, "the number of a node"));
            node != placed.scope->nodes.end() && !of_cells.contains(node->second))
          loose_ends_.insert(node->second);
    }
  }
}

// An equation that tells how one loose end moves: as the mean of nodes.
bool AbaqusConstraints::note_end(const Terms& terms) {
  std::vector<std::pair<double, int>> ends;
  for (const auto& [factor, nodes] : terms.nodes)
    for (const int node : nodes)
      if (loose_ends_.contains(node)) ends.emplace_back(factor, node);
  if (ends.size() != 1 || terms.nodes.size() != 2 || terms.nodes.at(ends[0].first).size() != 1) return false;
  for (const auto& [factor, nodes] : terms.nodes) {
    if (factor == ends[0].first) continue;
    constexpr double rounding = 1e-6;
    if (std::abs(factor * static_cast<double>(nodes.size()) + ends[0].first) > rounding * std::abs(ends[0].first))
      return false;
    if (!ends_as_means_.emplace(std::pair(ends[0].second, terms.axis), nodes).second) return false;
  }
  return true;
}

// *SPRING of a set of SPRINGA, *DASHPOT of DASHPOTA: an empty line, and a stiffness or a damping.
void AbaqusConstraints::read_spring(const PlacedCard& placed) {
  const FileCard& card = *placed.card;
  const std::string set = in_capitals(card.option("ELSET"));
  const bool is_damper = card.keyword == "DASHPOT";
  if (card.data.empty()) file_.fail(card, is_damper ? "it has no damping" : "it has no stiffness");
  LineFields fields_of(file_, card.data.back());
  const double value = fields_of.real(is_damper ? "a damping" : "a stiffness");
  bool has_any = false;
  for (const PlacedCard& other : model_.cards()) {
    if (other.card->keyword != "ELEMENT" || in_capitals(other.card->option("ELSET")) != set) continue;
    if (in_capitals(other.card->option("TYPE")) != (is_damper ? "DASHPOTA" : "SPRINGA") || card.data.size() > 2)
      file_.fail(card, is_damper ? "dashpots between two nodes (DASHPOTA) of one damping are read"
                                 : "springs between two nodes (SPRINGA) of one stiffness are read");
    for (const DataLine& line : other.card->data) {
      LineFields fields(file_, line);
      fields.whole("the number of an element");
      const int one = end_of(other, fields), to = end_of(other, fields);
      springs_.push_back(
          {file_.where(line.file, line.line), &line, one, to, is_damper ? 0.0 : value, is_damper ? value : 0.0});
      has_any = true;
    }
  }
  if (!has_any) file_.fail(card, "its set has no element of its own");
}

int AbaqusConstraints::end_of(const PlacedCard& placed, LineFields& fields) const {
  const auto node = placed.scope->nodes.find(fields.whole("the number of a node"));
  if (node == placed.scope->nodes.end()) fields.fail("*ELEMENT: a node that the file does not give");
  return node->second;
}

void AbaqusConstraints::add_spring(const Spring& spring, std::vector<FileSpring>& springs) {
  const LineFields fields(file_, *spring.line);
  const auto& x = model_.model().nodes;
  const Vec3 along = x[static_cast<size_t>(spring.other)] - x[static_cast<size_t>(spring.one)];
  if (along.isZero(0.0)) fields.fail("*SPRING or *DASHPOT: its ends are at one place, and it has no direction");
  std::vector<int> axes;
  for (int d = 0; d < 3; ++d)
    if (std::abs(along[d]) > 1e-9 * along.norm()) axes.push_back(d);
  FileSpring found{"", "", {spring.stiffness}, {spring.damping}, frame_along(along.normalized()), spring.where};
  for (const int node : {spring.one, spring.other}) {
    std::vector<int> nodes{node};
    if (loose_ends_.contains(node)) {
      const auto held = held_ends_.find(node);
      if (held != held_ends_.end() &&
          std::all_of(axes.begin(), axes.end(), [&](int d) { return held->second[static_cast<size_t>(d)]; }))
        continue;
      for (const int d : axes) {
        const auto mean = ends_as_means_.find({node, d});
        if (mean == ends_as_means_.end() || (d != axes[0] && mean->second != nodes))
          fields.fail("*SPRING or *DASHPOT: an end of it is of no cell, is not held along it, and follows no mean");
        nodes = mean->second;
      }
    }
    (found.one.empty() ? found.one : found.other) =
        place_of(model_.model(), found.one.empty() ? "spring from" : "spring to", *spring.line, nodes);
  }
  if (!found.one.empty()) springs.push_back(std::move(found));
}

// PLANE and STRAIGHT, of small displacements: nodes that stay on a plane, or on a line.
void AbaqusConstraints::read_constraints(const PlacedCard& placed) {
  const FileCard& card = *placed.card;
  std::string kind;
  std::vector<int> nodes;
  const auto finish = [&] {
    if (kind == "PLANE") keep_plane(card, nodes);
    if (kind == "STRAIGHT") keep_straight(card, nodes);
    nodes.clear();
  };
  for (const DataLine& line : card.data) {
    LineFields fields(file_, line);
    std::string_view field;
    for (bool is_first = true; fields.next(field); is_first = false) {
      if (is_first && !is_whole(field)) {
        finish();
        kind = in_capitals(field);
        if (kind != "PLANE" && kind != "STRAIGHT") file_.fail(card, printable(kind) + ": a deck has no word for it");
        continue;
      }
      if (field.empty() || field == "0") continue;
      for (const int node : model_.nodes_of(*placed.scope, fields, field)) {
        if (turned_.contains(node)) fields.fail("in axes of *TRANSFORM");
        if (std::find(nodes.begin(), nodes.end(), node) == nodes.end()) nodes.push_back(node);
      }
    }
  }
  finish();
}

// One node of a constraint as a sum of others, whose shares make 1, along some axes.
void AbaqusConstraints::follow(const FileCard& card, int node, const std::vector<std::pair<int, double>>& others,
                               const std::vector<Vec3>& along) {
  constexpr double nothing = 1e-9;
  const DataLine line{"", card.file, card.line};
  const std::string number = std::to_string(equations.size() + 1);
  AbaqusEquation equation{
      {{place_of(model_.model(), "mpc " + number + " of", line, {node}), 1.0}}, {}, file_.where(card)};
  for (size_t i = 0; i < others.size(); ++i)
    if (std::abs(others[i].second) > nothing)
      equation.terms.push_back(
          {place_of(model_.model(), fmt::format("mpc {} by {}", number, i + 1), line, {others[i].first}),
           -others[i].second});
  if (std::all_of(along.begin(), along.end(), [](const Vec3& e) { return e.cwiseAbs().maxCoeff() > 1 - nothing; })) {
    for (const Vec3& e : along)
      for (size_t d = 0; d < 3; ++d) equation.along[d] = equation.along[d] || std::abs(e[static_cast<int>(d)]) > 0.5;
    equations.push_back(equation);
    return;
  }
  for (const Vec3& e : along) {
    for (AbaqusEquation::Term& term : equation.terms) term.along = e;
    equations.push_back(equation);
  }
}

void AbaqusConstraints::keep_straight(const FileCard& card, const std::vector<int>& nodes) {
  if (nodes.size() < 3) return;
  const auto x = [&](int i) { return model_.model().nodes[static_cast<size_t>(nodes[static_cast<size_t>(i)])]; };
  size_t last = 1;
  for (size_t i = 2; i < nodes.size(); ++i)
    if ((x(static_cast<int>(i)) - x(0)).norm() > (x(static_cast<int>(last)) - x(0)).norm()) last = i;
  const Vec3 along = x(static_cast<int>(last)) - x(0);
  const Mat3 frame = frame_along(along.normalized());
  const std::vector<Vec3> across = {frame.col(1), frame.col(2)};
  for (size_t i = 1; i < nodes.size(); ++i) {
    if (i == last) continue;
    const Vec3 own = x(static_cast<int>(i)) - x(0);
    const double s = own.dot(along) / along.squaredNorm();
    if ((own - s * along).norm() > 1e-6 * along.norm()) file_.fail(card, "STRAIGHT: its nodes are on no line");
    follow(card, nodes[i], {{nodes[0], 1 - s}, {nodes[last], s}}, across);
  }
}

// Three nodes that are far apart carry the plane: the others have the share of each in it.
void AbaqusConstraints::keep_plane(const FileCard& card, const std::vector<int>& nodes) {
  if (nodes.size() < 4) return;
  const auto x = [&](size_t i) { return model_.model().nodes[static_cast<size_t>(nodes[i])]; };
  size_t b = 1, c = 1;
  for (size_t i = 2; i < nodes.size(); ++i)
    if ((x(i) - x(0)).norm() > (x(b) - x(0)).norm()) b = i;
  const Vec3 along = x(b) - x(0);
  for (size_t i = 1; i < nodes.size(); ++i)
    if (along.cross(x(i) - x(0)).norm() > along.cross(x(c) - x(0)).norm()) c = i;
  const Vec3 normal = along.cross(x(c) - x(0));
  if (!(normal.norm() > 1e-6 * along.squaredNorm())) file_.fail(card, "PLANE: its nodes are on a line");
  const std::vector<Vec3> across = {normal.normalized()};
  for (size_t i = 1; i < nodes.size(); ++i) {
    if (i == b || i == c) continue;
    const Vec3 own = x(i) - x(0);
    if (std::abs(own.dot(normal)) > 1e-6 * normal.norm() * along.norm())
      file_.fail(card, "PLANE: its nodes are on no plane");
    const double of_b = own.cross(x(c) - x(0)).dot(normal) / normal.squaredNorm(),
                 of_c = along.cross(own).dot(normal) / normal.squaredNorm();
    follow(card, nodes[i], {{nodes[0], 1 - of_b - of_c}, {nodes[b], of_b}, {nodes[c], of_c}}, across);
  }
}

// Ends of springs that are of no cell are no nodes here: what is held of them is the ground. Are these all such?
bool AbaqusConstraints::hold_ends(const std::array<double, 6>& says, const std::vector<int>& nodes) {
  if (nodes.empty() || !std::all_of(nodes.begin(), nodes.end(), [&](int node) { return loose_ends_.contains(node); }))
    return false;
  if (says[3] != 0.0 || says[4] != 0.0 || says[5] != 0.0) return false;
  for (const int node : nodes)
    for (size_t d = 0; d < 3; ++d) held_ends_[node][d] = held_ends_[node][d] || says[d] != 0.0;
  return true;
}

}  // namespace dygita
