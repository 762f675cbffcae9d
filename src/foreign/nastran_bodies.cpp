#include "foreign/nastran_bodies.hpp"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Dense>
#include <algorithm>

#include "base/error.hpp"
#include "foreign/nastran_supports.hpp"

namespace dygita {

namespace {

constexpr double at_one_place = 1e-6;  // of the size of what is around

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
  const auto at = [&](int i) { return fields.real_or(moments + i, 0.0, "a moment of inertia"); };
  Mat3 inertia;
  inertia << at(0), -at(1), -at(3), -at(1), at(2), -at(4), -at(3), -at(4), at(5);
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
  if (of_cells_.contains(node)) return {add_place(model_.model(), card, {node}), x};
  std::vector<NastranSpider*> around;
  for (NastranSpider& spider : spiders_)
    if (spider.centre == node) around.push_back(&spider);
  const long number = model_.places().grids()[static_cast<size_t>(node)].number;
  if (around.size() != 1 || !around[0]->is_mean || !around[0]->doubt.empty())
    fields.fail(fmt::format("node {} is of no cell, and not the centre of one RBE3 of even weights", number));
  if ((middle_of(around[0]->feet) - x).norm() > at_one_place * size_of(around[0]->feet))
    fields.fail(fmt::format("node {} is not in the middle of its RBE3", number));
  around[0]->is_said = true;
  return {add_place(model_.model(), *around[0]->card, around[0]->feet), x};
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
  constexpr int orientation = 5, system = 8, row = 8, rotations = 3;
  const BulkCard& of =
      property("PBUSH", fields.whole_or(2, fields.whole(1, "a number"), "the number of a property"), fields);
  const BulkFields values(model_.file(), of);
  std::array<double, 6> stiffness{}, damping{};
  for (int i = 2; i <= values.size(); i += row) {
    const std::string word = values.word(i);
    if (word == "RCV" || word.empty()) continue;
    for (int d = 0; d < 6; ++d) {
      const double value = values.real_or(i + 1 + d, 0.0, "a number");
      if (word == "K") stiffness[static_cast<size_t>(d)] = value;
      if (word == "B") damping[static_cast<size_t>(d)] = value;
      if (word != "K" && word != "B" && value != 0.0) values.fail(fmt::format("{} of a bushing", word));
    }
  }
  for (size_t d = rotations; d < 6; ++d)
    if (stiffness[d] != 0.0 || damping[d] != 0.0) values.fail("K4 to K6, B4 to B6: stiffness against rotation");
  Vec3 k(stiffness[0], stiffness[1], stiffness[2]), b(damping[0], damping[1], damping[2]);
  const int node = model_.node(fields.whole(3, "a node"), fields);
  if (fields.has(system)) {
    const Mat3 axes = model_.places().system(fields.whole(system, "a coordinate system"), card).axes_at(place_of(node));
    const Mat3 turned = axes.cwiseAbs();
    if (((turned * turned.transpose()) - Mat3::Identity()).norm() > 1e-9)
      fields.fail("axes that are none of the file's");
    k = turned * k;
    b = turned * b;
  } else if (k != Vec3::Constant(k[0]) || b != Vec3::Constant(b[0])) {
    fields.fail(fields.has(orientation) ? "axes by a node or a vector"
                                        : "no axes (CID), and unlike stiffness along them");
  }
  const End one = end_at(node, card, fields);
  FileSpring spring{one.place, "", k, b, model_.file().where(card)};
  if (fields.has(4)) {
    const End other = end_at(model_.node(fields.whole(4, "a node"), fields), card, fields);
    if ((one.x - other.x).norm() > at_one_place * (1.0 + one.x.norm()))
      fields.fail("its nodes are not at one place, and its force has an arm");
    spring.other = other.place;
  }
  springs.push_back(std::move(spring));
}

// CELAS1: number, property, node, component, node, component. CELAS2: the stiffness in place of the property.
void NastranBodies::add_scalar(const BulkCard& card, const BulkFields& fields) {
  double stiffness = 0.0;
  if (card.name == "CELAS2")
    stiffness = fields.real(2, "a stiffness");
  else
    stiffness = BulkFields(model_.file(),
                           property("PELAS", fields.whole_or(2, fields.whole(1, "a number"), "a property"), fields))
                    .real(2, "a stiffness");
  if (fields.has(7) && card.name == "CELAS2" && fields.real(7, "a damping") != 0.0) fields.fail("structural damping");
  Vec3 along = Vec3::Zero();
  std::vector<End> ends;
  for (const int i : {3, 5}) {
    if (!fields.has(i) || fields.whole(i, "a node") == 0) continue;
    const long component = fields.whole(i + 1, "a component");
    if (component < 1 || component > 3) fields.fail(fmt::format("component {}: displacements are 1 to 3", component));
    const int node = model_.node(fields.whole(i, "a node"), fields);
    const NastranGrid& grid = model_.places().grids()[static_cast<size_t>(node)];
    const Vec3 axis = model_.places().system(grid.motion_system, card).axes_at(grid.x).col(component - 1);
    if (!ends.empty() && (axis - along).norm() > 1e-9) fields.fail("its two components have unlike directions");
    along = axis;
    ends.push_back(end_at(node, card, fields));
  }
  int d = 0;
  if (ends.empty() || 1.0 - along.cwiseAbs().maxCoeff(&d) > 1e-9) fields.fail("axes that are none of the file's");
  if (ends.size() == 2) {
    Vec3 apart = ends[0].x - ends[1].x;
    apart[d] = 0.0;
    if (apart.norm() > at_one_place * (1.0 + ends[0].x.norm()))
      fields.fail("its nodes are not on a line along its direction");
  }
  springs.push_back({ends[0].place, ends.size() == 2 ? ends[1].place : "", stiffness * Vec3::Unit(d), Vec3::Zero(),
                     model_.file().where(card)});
}

}  // namespace dygita
