#include "foreign/nastran_bodies.hpp"

#include <spdlog/fmt/fmt.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>

#include "base/error.hpp"
#include "foreign/nastran_supports.hpp"
#include "numerics/frame_along.hpp"

namespace dygita {

namespace {

constexpr double coincident = 1e-6;  // of the size of what is around

}  // namespace

NastranBodies::NastranBodies(NastranModel& model, std::vector<NastranSpider>& spiders, std::set<const BulkCard*>& said)
    : model_(model), spiders_(spiders), said_(said), of_cells_(nodes_of_cells(model.model())) {}

Vec3 NastranBodies::middle_of(const std::vector<int>& nodes) const {
  Vec3 sum = Vec3::Zero();
  for (const int node : nodes) sum += place_of(node);
  return sum / static_cast<double>(nodes.size());
}

double NastranBodies::size_of(const std::vector<int>& nodes) const {
  const Vec3 middle = middle_of(nodes);
  double largest = 0.0;
  for (const int node : nodes) largest = std::max(largest, (place_of(node) - middle).norm());
  return largest;
}

// Moments I(1,1), I(2,2), I(3,3) and products, which the matrix has with a minus.
Mat3 NastranBodies::inertia_of(const BulkFields& fields) const {
  constexpr int moments = 9;
  std::array<double, 6> at{};
  for (int i = 0; i < 6; ++i) at[static_cast<size_t>(i)] = fields.real_or(moments + i, 0.0, "a moment of inertia");
  Mat3 inertia;
  inertia << at[0], -at[1], -at[3], -at[1], at[2], -at[4], -at[3], -at[4], at[5];
  return inertia;
}

void NastranBodies::add_body(NastranSpider& spider) {
  const BulkFile& file = model_.file();
  const NastranGrid& grid = model_.places().grids()[static_cast<size_t>(spider.centre)];
  std::vector<const BulkCard*> masses;
  for (const BulkCard& card : file.cards())
    if (card.name == "CONM2" && BulkFields(file, card).whole(2, "a node") == grid.number) masses.push_back(&card);
  const auto n_spiders = std::count_if(spiders_.begin(), spiders_.end(),
                                       [&](const NastranSpider& one) { return one.centre == spider.centre; });
  if (masses.size() != 1 || n_spiders != 1 || of_cells_.contains(spider.centre)) return;
  const BulkFields fields(file, *masses[0]), of_spider(file, *spider.card);
  const std::string held = spider.is_mean ? of_spider.word(4) : spider.components;
  if (!spider.doubt.empty()) of_spider.fail(spider.doubt);
  if (held.find("123") == std::string::npos || (spider.is_mean && held != "123456"))
    of_spider.fail("a mass on a centre that follows in some directions alone");
  constexpr int offset = 5;
  const long system = fields.whole_or(3, 0, "a coordinate system");
  const Mat3 axes = system < 0 ? Mat3(Mat3::Identity()) : model_.places().system(system, *masses[0]).axes_at(grid.x);
  Vec3 given;
  for (int d = 0; d < 3; ++d) given[d] = fields.real_or(offset + d, 0.0, "a length");
  const double mass = model_.mass_factor() * fields.real(4, "a mass");
  Mat3 inertia = model_.mass_factor() * (axes * inertia_of(fields) * axes.transpose());
  if (inertia.isZero(0.0)) {
    constexpr double point = 1e-3;  // of the nodes' radius: a millionth of their inertia with the same mass
    const double radius = point * size_of(spider.feet);
    if (!(radius > 0.0)) fields.fail("a mass without moments of inertia behind one node");
    inertia = mass * radius * radius * Mat3::Identity();
    remarks.push_back(
        fmt::format("{}: CONM2 has no moments of inertia: those of a ball of a thousandth of the size of its "
                    "nodes take their place",
                    file.where(*masses[0])));
  }
  bodies.push_back({add_place(model_.model(), *spider.card, spider.feet), mass, inertia,
                    system < 0 ? given : Vec3(grid.x + axes * given), spider.is_mean, file.where(*masses[0])});
  spider.is_said = true;
  said_.insert(masses[0]);
}

// A node of cells, or nodes of which another one is the mean.
NastranBodies::End NastranBodies::end_at(int node, const BulkCard& card, const BulkFields& fields) {
  const Vec3 x = place_of(node);
  if (of_cells_.contains(node)) return {add_place(model_.model(), card, {node}), x, false};
  std::vector<NastranSpider*> around;
  for (NastranSpider& spider : spiders_)
    if (spider.centre == node) around.push_back(&spider);
  const long number = model_.places().grids()[static_cast<size_t>(node)].number;
  if (around.size() != 1 || !around[0]->is_mean || !around[0]->doubt.empty())
    fields.fail(fmt::format("node {} is of no cell, and not the centre of one RBE3 of even weights", number));
  if ((middle_of(around[0]->feet) - x).norm() > coincident * size_of(around[0]->feet))
    fields.fail(fmt::format("node {} is not in the middle of its RBE3", number));
  around[0]->is_said = true;
  return {add_place(model_.model(), *around[0]->card, around[0]->feet), x, true};
}

const BulkCard& NastranBodies::property(const char* name, long number, const BulkFields& fields) const {
  for (const BulkCard& card : model_.file().cards())
    if (card.name == name && BulkFields(model_.file(), card).whole(1, "the number of a property") == number)
      return card;
  fields.fail(fmt::format("there is no {} {}", name, number));
}

void NastranBodies::add_spring(const BulkCard& card) {
  const BulkFields fields(model_.file(), card);
  if (card.name == "CBUSH")
    add_bushing(card, fields);
  else
    add_scalar(card, fields);
  said_.insert(&card);
}

void NastranBodies::add_bushing(const BulkCard& card, const BulkFields& fields) {
  constexpr int row = 8;
  const BulkCard& of =
      property("PBUSH", fields.whole_or(2, fields.whole(1, "a number"), "the number of a property"), fields);
  const BulkFields values(model_.file(), of);
  FileSpring spring{"", "", {}, {}, Mat3::Identity(), model_.file().where(card)};
  for (int i = 2; i <= values.size(); i += row) {
    const std::string word = values.word(i);
    if (word == "RCV" || word.empty()) continue;
    for (int d = 0; d < 6; ++d) {
      const double value = values.real_or(i + 1 + d, 0.0, "a number");
      if (word == "K") spring.stiffness[static_cast<size_t>(d)] = value;
      if (word == "B") spring.damping[static_cast<size_t>(d)] = value;
      if (word != "K" && word != "B" && value != 0.0) values.fail(fmt::format("{} of a bushing", word));
    }
  }
  const End one = end_at(model_.node(fields.whole(3, "a node"), fields), card, fields);
  bool turns = one.turns;
  spring.one = one.place;
  if (fields.has(4)) {
    const End other = end_at(model_.node(fields.whole(4, "a node"), fields), card, fields);
    if ((one.x - other.x).norm() > coincident * (1.0 + one.x.norm()))
      fields.fail("its nodes are not at one place, and its force has an arm");
    spring.other = other.place;
    turns = turns && other.turns;
  }
  for (size_t d = 3; d < 6; ++d)
    if (!turns && (spring.stiffness[d] != 0.0 || spring.damping[d] != 0.0))
      values.fail("K4 to K6, B4 to B6: a node of a solid does not turn; give the spring the centre of an RBE3");
  spring.axes = axes_of_bushing(card, fields, spring);
  springs.push_back(std::move(spring));
}

// By a coordinate system; without one any will do where stiffness and damping are the same along all.
Mat3 NastranBodies::axes_of_bushing(const BulkCard& card, const BulkFields& fields, const FileSpring& spring) const {
  constexpr int orientation = 5, system = 8;
  if (fields.has(system))
    return model_.places()
        .system(fields.whole(system, "a coordinate system"), card)
        .axes_at(place_of(model_.node(fields.whole(3, "a node"), fields)));
  for (const auto& values : {spring.stiffness, spring.damping})
    for (const size_t first : {0, 3})
      if (values[first] != values[first + 1] || values[first] != values[first + 2])
        fields.fail(fields.has(orientation) ? "axes by a node or a vector"
                                            : "no axes (CID), and unlike stiffness along them");
  return Mat3::Identity();
}

// CELAS1: number, property, node, component, node, component. CELAS2: the stiffness in place of the property.
void NastranBodies::add_scalar(const BulkCard& card, const BulkFields& fields) {
  const bool is_in_card = card.name == "CELAS2";
  const BulkFields values(
      model_.file(),
      is_in_card ? card : property("PELAS", fields.whole_or(2, fields.whole(1, "a number"), "a property"), fields));
  const double stiffness = values.real(2, "a stiffness");
  if (values.real_or(is_in_card ? 7 : 3, 0.0, "a damping") != 0.0) values.fail("structural damping GE of a spring");
  Vec3 along = Vec3::Zero();
  bool is_rotation = false;
  std::vector<End> ends;
  for (const int i : {3, 5}) {
    if (!fields.has(i) || fields.whole(i, "a node") == 0) continue;
    const long component = fields.whole(i + 1, "a component");
    if (component < 1 || component > 6) fields.fail(fmt::format("component {}: they are 1 to 6", component));
    if (!ends.empty() && is_rotation != (component > 3)) fields.fail("a displacement and a rotation");
    is_rotation = component > 3;
    const int node = model_.node(fields.whole(i, "a node"), fields);
    const NastranGrid& grid = model_.places().grids()[static_cast<size_t>(node)];
    const Vec3 axis = model_.places().system(grid.motion_system, card).axes_at(grid.x).col((component - 1) % 3);
    if (!ends.empty() && (axis - along).norm() > 1e-9) fields.fail("its two components have unlike directions");
    along = axis;
    ends.push_back(end_at(node, card, fields));
  }
  if (ends.empty()) fields.fail("it has no node");
  for (const End& end : ends)
    if (is_rotation && !end.turns) fields.fail("a node of a solid does not turn; give it the centre of an RBE3");
  if (ends.size() == 2) {
    const Vec3 apart = ends[0].x - ends[1].x;
    if (!is_rotation && (apart - apart.dot(along) * along).norm() > coincident * (1.0 + ends[0].x.norm()))
      fields.fail("its nodes are not on a line along its direction");
  }
  FileSpring spring{
      ends[0].place, ends.size() == 2 ? ends[1].place : "", {}, {}, frame_along(along), model_.file().where(card)};
  spring.stiffness[is_rotation ? 3 : 0] = stiffness;
  springs.push_back(std::move(spring));
}

}  // namespace dygita
