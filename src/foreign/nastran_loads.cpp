#include "foreign/nastran_loads.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "base/error.hpp"
#include "foreign/nastran_supports.hpp"

namespace dygita {

namespace {

using Kind = FileAction::Kind;

// Loads that a deck does not say; their first field is the set.
const std::set<std::string_view> other_loads = {
    "MOMENT", "MOMENT1", "MOMENT2", "FORCE2", "PLOAD", "PLOAD1", "PLOAD2", "PLOADX1", "RFORCE",  "ACCEL",
    "ACCEL1", "SPCD",    "SLOAD",   "DEFORM", "TEMP",  "TEMPD",  "TEMPP1", "RFORCE1", "BOLTFOR", "PLOADE1"};

Vec3 direction_at(const BulkFields& fields, int i) {
  return {fields.real_or(i, 0.0, "a direction"), fields.real_or(i + 1, 0.0, "a direction"),
          fields.real_or(i + 2, 0.0, "a direction")};
}

}  // namespace

NastranLoads::NastranLoads(NastranModel& model, std::vector<NastranSpider>& spiders)
    : model_(model), spiders_(spiders), of_cells_(nodes_of_cells(model.model())) {}

std::map<long, double> NastranLoads::factors_of(long set) const {
  std::map<long, double> factors;
  const BulkFile& file = model_.file();
  for (const BulkCard& card : file.cards()) {
    const BulkFields fields(file, card);
    if (card.name != "LOAD" || fields.whole(1, "the number of a set") != set) continue;
    const double whole = fields.real_or(2, 1.0, "a factor");
    for (int i = 3; i + 1 <= fields.size(); i += 2)
      if (fields.has(i)) factors[fields.whole(i + 1, "the number of a set")] += whole * fields.real(i, "a factor");
  }
  factors[set] += 1.0;
  return factors;
}

std::vector<FileAction> NastranLoads::of_set(long set, std::vector<std::string>& untranslated) {
  const std::map<long, double> factors = factors_of(set);
  const BulkFile& file = model_.file();
  std::set<long> seen;
  for (const BulkCard& card : file.cards()) {
    const bool is_said = card.name == "FORCE" || card.name == "FORCE1" || card.name == "PLOAD4" || card.name == "GRAV";
    if (!is_said && !other_loads.contains(card.name)) continue;
    try {
      const auto factor = factors.find(BulkFields(file, card).whole(1, "the number of a set"));
      if (factor == factors.end()) continue;
      seen.insert(factor->first);
      if (is_said) add_card(card, factor->second);  // other_loads are listed with the cards that no deck says
    } catch (const InputError& error) {
      untranslated.emplace_back(error.what());
    }
  }
  if (seen.empty())
    untranslated.push_back(fmt::format("{}: there is no load {} that a case asks for", file.file(), set));
  for (const auto& [number, factor] : factors)
    if (number != set && !seen.contains(number) && !seen.empty())
      untranslated.push_back(
          fmt::format("{}: LOAD {} sums load {}, which the file does not have", file.file(), set, number));
  const auto n_sums = std::count_if(file.cards().begin(), file.cards().end(), [&](const BulkCard& card) {
    return card.name == "LOAD" && BulkFields(file, card).whole(1, "the number of a set") == set;
  });
  if (n_sums > 1 || (n_sums == 1 && seen.contains(set)))
    untranslated.push_back(fmt::format("{}: LOAD {} and another load have the same number", file.file(), set));
  pass_on_to_feet(untranslated);
  return actions();
}

void NastranLoads::add_card(const BulkCard& card, double factor) {
  if (card.name == "PLOAD4") return add_pressure(card, factor);
  if (card.name == "GRAV") return add_gravity(card, factor);
  add_force(card, factor);
}

void NastranLoads::add_force(const BulkCard& card, double factor) {
  const BulkFields fields(model_.file(), card);
  const int node = model_.node(fields.whole(2, "a node"), fields);
  const auto place = [&](int of) -> const Vec3& { return model_.places().grids()[static_cast<size_t>(of)].x; };
  Vec3 force;
  if (card.name == "FORCE") {
    constexpr int first = 5;
    const NastranSystem& system = model_.places().system(fields.whole_or(3, 0, "a coordinate system"), card);
    force = fields.real(4, "a force") * (system.axes_at(place(node)) * direction_at(fields, first));
  } else {
    const Vec3 along =
        place(model_.node(fields.whole(5, "a node"), fields)) - place(model_.node(fields.whole(4, "a node"), fields));
    if (!(along.norm() > 0)) fields.fail("the two nodes of its direction are at one place");
    force = fields.real(3, "a force") * along.normalized();
  }
  Loaded& loaded = forces_[node];
  loaded.force += factor * force;
  if (!loaded.card) loaded.card = &card;
}

void NastranLoads::add_pressure(const BulkCard& card, double factor) {
  const BulkFields fields(model_.file(), card);
  constexpr int corner = 7, opposite = 8, system = 9, direction = 10, line_load = 13;
  const double by = fields.real(3, "a pressure");
  for (const int i : {4, 5, 6})
    if (fields.has(i) && fields.real(i, "a pressure") != by) fields.fail("a pressure that varies over a face");
  if (fields.has(line_load) && fields.word(line_load) != "SURF") fields.fail("a load along lines");
  if (fields.word(corner) == "THRU") fields.fail("a range of shells");
  const long number = fields.whole(2, "an element");
  const int cell = model_.cell(number, fields);
  if (cell < 0) fields.fail(fmt::format("element {} is no cell here", number));
  const ForeignFacet facet = model_.facet(cell, fields.whole(corner, "a node of the face"),
                                          fields.whole_or(opposite, 0, "a node of the face"), fields);
  std::array<double, 4> says = {0, 0, 0, factor * by};
  if (const Vec3 along = direction_at(fields, direction); along.norm() > 0) {
    const NastranSystem& axes = model_.places().system(fields.whole_or(system, 0, "a coordinate system"), card);
    if (axes.kind != 'R') fields.fail("a direction that turns over the face");
    const Vec3 traction = factor * by * (axes.axes * along.normalized());
    says = {traction[0], traction[1], traction[2], 0};
  }
  auto corners = facet.corners;
  std::sort(corners.begin(), corners.end());
  Pressed& pressed = pressures_.try_emplace({facet.cell, corners}, Pressed{facet, {}, &card}).first->second;
  for (size_t i = 0; i < says.size(); ++i) pressed.says[i] += says[i];
}

void NastranLoads::add_gravity(const BulkCard& card, double factor) {
  const BulkFields fields(model_.file(), card);
  const NastranSystem& axes = model_.places().system(fields.whole_or(2, 0, "a coordinate system"), card);
  if (axes.kind != 'R') fields.fail("a direction that turns from place to place");
  gravity_ += factor * fields.real(3, "an acceleration") * (axes.axes * direction_at(fields, 4));
  if (!of_gravity_) of_gravity_ = &card;
}

// A force at the middle of nodes that follow evenly is shared by them.
void NastranLoads::pass_on_to_feet(std::vector<std::string>& untranslated) {
  const auto& grids = model_.places().grids();
  std::map<int, Loaded> of_feet;
  for (auto centre = forces_.begin(); centre != forces_.end();) {
    if (of_cells_.contains(centre->first)) {
      ++centre;
      continue;
    }
    const auto& [node, loaded] = *centre;
    const Vec3& at = grids[static_cast<size_t>(node)].x;
    bool is_said = false;
    for (NastranSpider& spider : spiders_) {
      if (spider.centre != node || !spider.is_mean || !spider.doubt.empty() || is_said) continue;
      Vec3 middle = Vec3::Zero();
      double extent = 0.0;
      for (const int foot : spider.feet) middle += grids[static_cast<size_t>(foot)].x;
      middle /= static_cast<double>(spider.feet.size());
      for (const int foot : spider.feet)
        extent = std::max(extent, (grids[static_cast<size_t>(foot)].x - middle).norm());
      constexpr double close = 1e-6;
      if ((at - middle).norm() > close * extent) continue;
      is_said = spider.is_said = true;
      for (const int foot : spider.feet) {
        Loaded& one = of_feet[foot];
        one.force += loaded.force / static_cast<double>(spider.feet.size());
        if (!one.card) one.card = loaded.card;
      }
    }
    if (!is_said)
      untranslated.push_back(
          fmt::format("{}: {}: node {} is of no cell, nor the middle of nodes that follow evenly (RBE3)",
                      model_.file().where(*loaded.card), loaded.card->name, grids[static_cast<size_t>(node)].number));
    centre = forces_.erase(centre);
  }
  for (const auto& [foot, loaded] : of_feet) {
    Loaded& one = forces_[foot];
    one.force += loaded.force;
    if (!one.card) one.card = loaded.card;
  }
}

// Facets under one pressure, or one traction, in the order of the cards; what several cards say of a facet is summed.
std::map<NastranLoads::Says, NastranLoads::PressedAlike> NastranLoads::pressed_alike() const {
  std::vector<const Pressed*> all;
  for (const auto& [facet, pressed] : pressures_) all.push_back(&pressed);
  std::stable_sort(all.begin(), all.end(), [](const Pressed* a, const Pressed* b) {
    return std::pair(a->card->file, a->card->line) < std::pair(b->card->file, b->card->line);
  });
  std::map<Says, PressedAlike> alike;
  for (const Pressed* one : all)
    for (const Says& says : {Says{one->says[0], one->says[1], one->says[2], 0.0}, Says{0.0, 0.0, 0.0, one->says[3]}}) {
      if (says == Says{}) continue;
      PressedAlike& own = alike[says];
      own.facets.push_back(one->facet);
      if (!own.card) own.card = one->card;
    }
  return alike;
}

std::vector<FileAction> NastranLoads::actions() {
  const BulkFile& file = model_.file();
  std::vector<FileAction> actions;
  std::map<std::array<double, 3>, std::pair<const BulkCard*, std::vector<int>>> alike;
  for (const auto& [node, loaded] : forces_) {
    if (loaded.force.isZero(0.0)) continue;
    auto& [card, nodes] =
        alike.try_emplace({loaded.force[0], loaded.force[1], loaded.force[2]}, loaded.card, std::vector<int>{})
            .first->second;
    nodes.push_back(node);
    if (loaded.card->line < card->line) card = loaded.card;
  }
  const auto nonzero = [](const Vec3& value) {
    return std::array<bool, 3>{value[0] != 0, value[1] != 0, value[2] != 0};
  };
  for (const auto& [says, of] : alike) {
    const Vec3 force(says[0], says[1], says[2]);
    actions.push_back({Kind::force, add_place(model_.model(), *of.first, of.second), force, nonzero(force), "",
                       file.where(*of.first), static_cast<int>(of.second.size())});
  }
  for (auto& [says, pressed] : pressed_alike()) {
    const Vec3 traction(says[0], says[1], says[2]);
    const bool is_pressure = traction.isZero(0.0);
    std::string name = fmt::format("pload4 {}{}", pressed.card->file == 0 ? "" : fmt::format("{}.", pressed.card->file),
                                   pressed.card->line);
    for (const ForeignFace& surface : model_.model().surfaces)
      if (surface.name == name) name += " (2)";
    actions.push_back({is_pressure ? Kind::pressure : Kind::traction, name,
                       is_pressure ? Vec3(says[3], 0, 0) : traction, nonzero(traction), "", file.where(*pressed.card),
                       0});
    model_.model().surfaces.push_back({name, std::move(pressed.facets), file.where(*pressed.card)});
  }
  if (!gravity_.isZero(0.0)) actions.push_back({Kind::gravity, "", gravity_, {}, "", file.where(*of_gravity_), 0});
  return actions;
}

}  // namespace dygita
