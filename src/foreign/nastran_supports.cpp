#include "foreign/nastran_supports.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/names.hpp"

namespace dygita {

std::set<int> nodes_of_cells(const ForeignModel& model) {
  return {model.connectivity.begin(), model.connectivity.end()};
}

std::string add_place(ForeignModel& model, const BulkCard& card, std::vector<int> nodes) {
  std::string name(card.name);
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const std::string base = fmt::format("{} {}{}", name, card.file == 0 ? "" : fmt::format("{}.", card.file), card.line);
  const auto is_taken = [&](const std::string& one) {
    return std::any_of(model.node_sets.begin(), model.node_sets.end(),
                       [&](const ForeignSet& set) { return set.name == one && set.nodes != nodes; });
  };
  name = base;
  for (int n = 2; is_taken(name); ++n) name = fmt::format("{} ({})", base, n);
  const bool is_there = std::any_of(model.node_sets.begin(), model.node_sets.end(),
                                    [&](const ForeignSet& set) { return set.name == name; });
  if (!is_there) model.node_sets.push_back({name, std::move(nodes)});
  return name;
}

NastranSupports::NastranSupports(NastranModel& model, std::vector<NastranSpider>& spiders)
    : model_(model), spiders_(spiders), of_cells_(nodes_of_cells(model.model())) {}

void NastranSupports::hold(int node, const std::string& components, double by, const BulkCard& card,
                           const BulkFields& fields) {
  Held& held = held_[node];
  if (!held.card) held.card = &card;
  for (const char c : components) {
    if (c < '0' || c > '6')
      fields.fail(fmt::format("components 1 ... 6 are expected, not '{}'", printable(components)));
    if (c == '0') continue;
    const auto d = static_cast<size_t>(c - '1');
    if (d >= 3 && by != 0.0) fields.fail(fmt::format("a rotation of {:g} is enforced, which no deck says", by));
    const double before = d < 3 ? held.by[static_cast<long>(d)] : 0.0;
    if (held.along[d] && before != by)
      fields.fail(
          fmt::format("node {} is moved by {:g} along {} here, and by {:g} by {} of line {}: which of them holds?",
                      model_.places().grids()[static_cast<size_t>(node)].number, by, c, before, held.cards[d]->name,
                      held.cards[d]->line));
    held.along[d] = true;
    held.cards[d] = &card;
    if (d < 3) held.by[static_cast<long>(d)] = by;
  }
}

void NastranSupports::add_permanent() {
  const auto& grids = model_.places().grids();
  for (size_t i = 0; i < grids.size(); ++i)
    if (!grids[i].held.empty())
      hold(static_cast<int>(i), grids[i].held, 0.0, *grids[i].card, BulkFields(model_.file(), *grids[i].card));
}

void NastranSupports::add_card(const BulkCard& card) {
  const BulkFields fields(model_.file(), card);
  if (card.name == "SPC1") {
    for (const int node : model_.nodes(fields.ranges_from(3, "a node"), fields))
      hold(node, fields.word(2), 0.0, card, fields);
    return;
  }
  constexpr int second = 5;
  for (const int i : {2, second})
    if (fields.has(i))
      hold(model_.node(fields.whole(i, "a node"), fields), fields.word(i + 1),
           fields.real_or(i + 2, 0.0, "a displacement"), card, fields);
}

std::vector<FileAction> NastranSupports::of_set(long set, std::vector<std::string>& untranslated) {
  std::set<long> sets = {set};
  const BulkFile& file = model_.file();
  for (const BulkCard& card : file.cards())
    if (const BulkFields fields(file, card); card.name == "SPCADD" && fields.whole(1, "the number of a set") == set)
      for (const auto& range : fields.ranges_from(2, "the number of a set")) sets.insert(range[0]);
  bool has_any = set == 0;
  for (const BulkCard& card : file.cards()) {
    if (card.name != "SPC" && card.name != "SPC1") continue;
    if (!sets.contains(BulkFields(file, card).whole(1, "the number of a set"))) continue;
    has_any = true;
    try {
      add_card(card);
    } catch (const InputError& error) {
      untranslated.emplace_back(error.what());
    }
  }
  if (!has_any) untranslated.push_back(fmt::format("{}: there is no SPC {} that a case asks for", file.file(), set));
  pass_on_to_feet(untranslated);
  std::map<std::array<double, 6>, std::pair<FileAction, std::vector<int>>> alike;
  std::map<const BulkCard*, const BulkCard*> card_of;
  std::map<std::array<double, 6>, const BulkCard*> first;
  for (const auto& [node, held] : held_) {
    if (!held.along[0] && !held.along[1] && !held.along[2]) continue;  // rotations, which cells do not have
    try {
      const FileAction action = action_of(node, held);
      const std::array<double, 6> key = {static_cast<double>(action.along[0]),
                                         static_cast<double>(action.along[1]),
                                         static_cast<double>(action.along[2]),
                                         action.value[0],
                                         action.value[1],
                                         action.value[2]};
      alike.try_emplace(key, action, std::vector<int>{}).first->second.second.push_back(node);
      const BulkCard*& card = first[key];
      if (!card || held.card->line < card->line) card = held.card;
    } catch (const InputError& error) {
      untranslated.emplace_back(error.what());
    }
  }
  std::vector<FileAction> actions;
  for (auto& [key, one] : alike) {
    one.first.where = file.where(*first[key]);
    one.first.n_nodes = static_cast<int>(one.second.size());
    one.first.place = add_place(model_.model(), *first[key], one.second);
    actions.push_back(one.first);
  }
  return actions;
}

// A centre that is held in all its directions holds the nodes around it in theirs.
void NastranSupports::pass_on_to_feet(std::vector<std::string>& untranslated) {
  std::map<int, Held> of_feet;
  for (auto centre = held_.begin(); centre != held_.end();) {
    if (of_cells_.contains(centre->first)) {
      ++centre;
      continue;
    }
    const auto& [node, held] = *centre;
    const bool is_whole = std::all_of(held.along.begin(), held.along.end(), [](bool is) { return is; });
    bool is_said = false;
    for (NastranSpider& spider : spiders_) {
      if (spider.centre != node || spider.is_mean || !is_whole || !held.by.isZero(0.0)) continue;
      is_said = spider.is_said = true;
      for (const int foot : spider.feet) {
        Held& one = of_feet[foot];
        one.card = held.card;
        for (const char c : spider.components)
          if (c >= '1' && c <= '6') one.along[static_cast<size_t>(c - '1')] = true;
      }
    }
    if (!is_said)
      untranslated.push_back(fmt::format("{}: {}: node {} is of no cell", model_.file().where(*held.card),
                                         held.card->name, model_.places().grids()[static_cast<size_t>(node)].number));
    centre = held_.erase(centre);
  }
  for (const auto& [foot, held] : of_feet) {
    Held& one = held_[foot];
    if (!one.card) one.card = held.card;
    for (size_t d = 0; d < held.along.size(); ++d) {
      if (d < 3 && held.along[d] && one.by[static_cast<long>(d)] != 0.0)
        untranslated.push_back(fmt::format("{}: {}: node {} is moved, and held by a centre around which it stands",
                                           model_.file().where(*one.cards[d]), one.cards[d]->name,
                                           model_.places().grids()[static_cast<size_t>(foot)].number));
      one.along[d] = one.along[d] || held.along[d];
    }
  }
}

FileAction NastranSupports::action_of(int node, const Held& held) {
  const NastranGrid& grid = model_.places().grids()[static_cast<size_t>(node)];
  FileAction action{FileAction::Kind::held, "", Vec3::Zero(), {}, "", "", 0};
  const std::array<bool, 3> all = {true, true, true}, along = {held.along[0], held.along[1], held.along[2]};
  const Mat3 axes = model_.places().system(grid.motion_system, *grid.card).axes_at(grid.x);
  if (along == all) {
    action.along = all;
    action.value = axes * held.by;
  } else {
    constexpr double close = 1e-9;
    for (int d = 0; d < 3; ++d) {
      if (!along[static_cast<size_t>(d)]) continue;
      int axis = 0;
      if (1.0 - axes.col(d).cwiseAbs().maxCoeff(&axis) > close)
        throw InputError(fmt::format("{}: {}: node {} is held in system {}, whose axes are none of the file's",
                                     model_.file().where(*held.card), held.card->name, grid.number,
                                     grid.motion_system));
      action.along[static_cast<size_t>(axis)] = true;
      action.value[axis] = axes(axis, d) > 0 ? held.by[d] : -held.by[d];
    }
  }
  if (!action.value.isZero(0.0)) action.kind = FileAction::Kind::moved;
  return action;
}

}  // namespace dygita
