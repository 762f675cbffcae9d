#include "foreign/abaqus_pretensions.hpp"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace dygita {

AbaqusPretensions::AbaqusPretensions(AbaqusModel& model) : model_(model), file_(model.file()) {
  for (const PlacedCard& placed : model.cards()) {
    if (placed.card->keyword != "PRE-TENSIONSECTION") continue;
    try {
      add(placed);
    } catch (const InputError& error) {
      untranslated_.emplace_back(error.what());
    }
  }
}

void AbaqusPretensions::add(const PlacedCard& placed) {
  const FileCard& card = *placed.card;
  if (card.has("ELEMENT")) file_.fail(card, "of a beam");
  const std::string given = card.option("NODE");
  const std::vector<int> nodes =
      model_.nodes_of(*placed.scope, LineFields(file_, {given, card.file, card.line}), given);
  if (nodes.size() != 1) file_.fail(card, "NODE = one node is expected");
  const auto& surfaces = model_.model().surfaces;
  const auto surface = std::find_if(surfaces.begin(), surfaces.end(), [&](const ForeignFace& one) {
    return in_capitals(one.name) == in_capitals(card.option("SURFACE"));
  });
  if (surface == surfaces.end()) file_.fail(card, fmt::format("there is no surface '{}'", card.option("SURFACE")));
  if (card.data.empty()) file_.fail(card, "it has no line with a normal");
  LineFields fields(file_, card.data[0]);
  Vec3 normal;
  for (double& x : normal) x = fields.real("a component of the normal");
  if (!of_node_.emplace(nodes[0], Section{surface->name, sign_of(card, *surface, normal.normalized())}).second)
    file_.fail(card, "its node has another section");
}

// A force pulls where the normal points out of the cells that the surface names. The interface of a deck acts along the
// normal of the facets.
double AbaqusPretensions::sign_of(const FileCard& card, const ForeignFace& surface, const Vec3& normal) const {
  const ForeignModel& model = model_.model();
  constexpr double along = 0.999;
  double sign = 0.0;
  for (const ForeignFacet& facet : surface.facets) {
    const auto x = [&](int i) { return model.nodes[static_cast<size_t>(facet.corners[static_cast<size_t>(i)])]; };
    const ForeignCell& cell = model.cells[static_cast<size_t>(facet.cell)];
    Vec3 middle = Vec3::Zero();
    const int n = cell_shape(cell.type).n_corners;
    for (int a = 0; a < n; ++a) middle += model.nodes[static_cast<size_t>(model.nodes_of(cell)[a])] / n;
    Vec3 outward = (x(1) - x(0)).cross(x(2) - x(0)).normalized();
    if (outward.dot(x(0) - middle) < 0) outward = -outward;
    const double own = outward.dot(normal);
    if (std::abs(own) < along || own * sign < 0) file_.fail(card, "its surface is not plane and across its normal");
    sign = own > 0 ? 1.0 : -1.0;
  }
  return sign;
}

bool AbaqusPretensions::read(const PlacedCard& placed, const DataLine& line, const std::vector<int>& nodes,
                             std::pair<long, long> directions, double by, std::optional<FileAction>& action) const {
  const LineFields fields(file_, line);
  const FileCard& card = *placed.card;
  const auto n = std::count_if(nodes.begin(), nodes.end(), [&](int node) { return of_node_.contains(node); });
  if (n == 0) return false;
  if (nodes.size() > 1) fields.fail(fmt::format("{}: several nodes, one of a *PRE-TENSION SECTION", card.written));
  const Section& section = of_node_.at(nodes[0]);
  const bool is_force = card.keyword == "CLOAD";
  if (directions.second > 1 && by != 0.0)
    fields.fail(fmt::format("{}: the node of a *PRE-TENSION SECTION has direction 1", card.written));
  if (directions.first > 1 || (is_force && by == 0.0)) return true;
  if (is_force && by * section.sign < 0.0)
    fields.fail("*CLOAD: it pushes the section apart, which load.preload does not");
  action = FileAction{is_force ? FileAction::Kind::preload : FileAction::Kind::shortening,
                      section.surface,
                      {by * section.sign, 0, 0},
                      {},
                      card.option("AMPLITUDE"),
                      file_.where(line.file, line.line),
                      0};
  action->stays = card.has("FIXED");
  return true;
}

void AbaqusPretensions::finish(std::vector<std::string>& surfaces, std::vector<std::string>& untranslated) {
  for (const auto& [node, section] : of_node_)
    if (std::find(surfaces.begin(), surfaces.end(), section.surface) == surfaces.end())
      surfaces.push_back(section.surface);
  untranslated.insert(untranslated.end(), untranslated_.begin(), untranslated_.end());
}

}  // namespace dygita
