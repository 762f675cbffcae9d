#include "foreign/nastran_places.hpp"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "base/error.hpp"

namespace dygita {

namespace {

constexpr int deepest_system = 1000;  // of systems in systems
constexpr double degree = std::numbers::pi / 180;

Vec3 coordinates_at(const BulkFields& fields, int i) {
  return {fields.real_or(i, 0.0, "a coordinate"), fields.real_or(i + 1, 0.0, "a coordinate"),
          fields.real_or(i + 2, 0.0, "a coordinate")};
}

bool is_coordinate_system(std::string_view name) {
  return name.size() == 6 && name.starts_with("CORD") && (name[4] == '1' || name[4] == '2') &&
         (name[5] == 'R' || name[5] == 'C' || name[5] == 'S');
}

}  // namespace

Vec3 NastranSystem::place(const Vec3& c) const {
  if (kind == 'R') return origin + axes * c;
  const double one = c[1] * degree, two = c[2] * degree;
  if (kind == 'C') return origin + axes * Vec3(c[0] * std::cos(one), c[0] * std::sin(one), c[2]);
  return origin + axes * (c[0] * Vec3(std::sin(one) * std::cos(two), std::sin(one) * std::sin(two), std::cos(one)));
}

Mat3 NastranSystem::axes_at(const Vec3& x) const {
  if (kind == 'R') return axes;
  const Vec3 local = axes.transpose() * (x - origin);
  const double radius = std::hypot(local[0], local[1]);
  const Vec3 out = radius > 0 ? Vec3(local[0] / radius, local[1] / radius, 0.0) : Vec3(Vec3::UnitX());
  const Vec3 around = Vec3::UnitZ().cross(out);
  Mat3 at;
  if (kind == 'C') {
    at << out, around, Vec3::UnitZ();
    return axes * at;
  }
  const Vec3 away = local.norm() > 0 ? Vec3(local.normalized()) : Vec3(Vec3::UnitZ());
  at << away, around.cross(away), around;
  return axes * at;
}

NastranPlaces::NastranPlaces(const BulkFile& file) : file_(file) {
  note_systems();
  note_grids();
  for (auto& [number, given] : systems_)
    if (!given.is_made) make(number, given);
  for (size_t i = 0; i < grids_.size(); ++i) place(i, *grids_[i].card);
  for (const NastranGrid& grid : grids_) system(grid.motion_system, *grid.card);
}

void NastranPlaces::note_systems() {
  constexpr int second = 5;  // CORD1 gives two systems a card
  for (const BulkCard& card : file_.cards()) {
    if (!is_coordinate_system(card.name)) continue;
    const BulkFields fields(file_, card);
    for (int first = 1; first <= (card.name[4] == '1' ? second : 1); first += second - 1) {
      if (first > 1 && !fields.has(first)) continue;
      const long number = fields.whole(first, "the number of a coordinate system");
      if (number <= 0) fields.fail(fmt::format("a coordinate system has a number above 0, not {}", number));
      if (!systems_.try_emplace(number, Given{&card, first}).second)
        fields.fail(fmt::format("coordinate system {} is given twice", number));
    }
  }
}

void NastranPlaces::note_grids() {
  long place_system = 0, motion_system = 0;
  std::string held;
  for (const BulkCard& card : file_.cards()) {
    if (card.name != "GRDSET") continue;
    const BulkFields fields(file_, card);
    place_system = fields.whole_or(2, 0, "a coordinate system");
    motion_system = fields.whole_or(6, 0, "a coordinate system");
    held = fields.word(7);
  }
  for (const BulkCard& card : file_.cards()) {
    if (card.name != "GRID") continue;
    const BulkFields fields(file_, card);
    NastranGrid grid{&card, fields.whole(1, "the number of a node"),
                     fields.whole_or(2, place_system, "a coordinate system"),
                     fields.whole_or(6, motion_system, "a coordinate system"), fields.has(7) ? fields.word(7) : held};
    grid.x = coordinates_at(fields, 3);
    if (grid.number <= 0) fields.fail(fmt::format("a node has a number above 0, not {}", grid.number));
    const auto [known, is_new] = index_.emplace(grid.number, static_cast<int>(grids_.size()));
    if (is_new)
      grids_.push_back(std::move(grid));
    else if (const NastranGrid& other = grids_[static_cast<size_t>(known->second)];
             other.x != grid.x || other.place_system != grid.place_system || other.motion_system != grid.motion_system)
      fields.fail(fmt::format("node {} is given twice, at two places", grid.number));
  }
}

int NastranPlaces::index_of(long number) const {
  const auto found = index_.find(number);
  return found == index_.end() ? -1 : found->second;
}

const NastranSystem& NastranPlaces::system(long number, const BulkCard& asked) {
  if (number == 0) return own_;
  const auto found = systems_.find(number);
  if (found == systems_.end()) file_.fail(asked, fmt::format("there is no coordinate system {}", number));
  if (!found->second.is_made) make(number, found->second);
  return found->second.system;
}

const Vec3& NastranPlaces::place(size_t index, const BulkCard& asked) {
  NastranGrid& grid = grids_[index];
  if (grid.state == NastranGrid::State::placed) return grid.x;
  if (grid.state == NastranGrid::State::busy)
    file_.fail(asked, fmt::format("node {} is given in a system that is defined by itself", grid.number));
  grid.state = NastranGrid::State::busy;
  grid.x = system(grid.place_system, *grid.card).place(grid.x);
  grid.state = NastranGrid::State::placed;
  return grid.x;
}

Vec3 NastranPlaces::point_of_node(long number, const BulkCard& asked) {
  const int index = index_of(number);
  if (index < 0) file_.fail(asked, fmt::format("there is no node {}", number));
  return place(static_cast<size_t>(index), asked);
}

// A: the origin; B: a point of axis 3; C: a point of the half plane of axes 3 and 1.
void NastranPlaces::make(long number, Given& given) {
  const BulkFields fields(file_, *given.card);
  if (given.is_busy) fields.fail(fmt::format("coordinate system {} is defined by itself", number));
  if (++depth_ > deepest_system) fields.fail("coordinate systems are defined by each other, too deep");
  given.is_busy = true;
  std::array<Vec3, 3> points;
  if (given.card->name[4] == '1') {
    for (int i = 0; i < 3; ++i)
      points[static_cast<size_t>(i)] =
          point_of_node(fields.whole(given.first + 1 + i, "the number of a node"), *given.card);
  } else {
    const NastranSystem of = system(fields.whole_or(2, 0, "a coordinate system"), *given.card);
    for (int i = 0; i < 3; ++i) points[static_cast<size_t>(i)] = of.place(coordinates_at(fields, 3 + 3 * i));
  }
  const Vec3 up = points[1] - points[0], across = up.cross(points[2] - points[0]);
  constexpr double flat = 1e-10;
  if (!(up.norm() > 0) || !(across.norm() > flat * up.norm() * (points[2] - points[0]).norm()))
    fields.fail(fmt::format("the three points of coordinate system {} lie on one line", number));
  given.system.kind = given.card->name[5];
  given.system.origin = points[0];
  given.system.axes.col(2) = up.normalized();
  given.system.axes.col(1) = across.normalized();
  given.system.axes.col(0) = given.system.axes.col(1).cross(given.system.axes.col(2));
  given.is_made = true;
  given.is_busy = false;
  --depth_;
}

}  // namespace dygita
