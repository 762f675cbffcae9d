#include "mesher/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "mesher/gmsh_session.hpp"
#include "numerics/types.hpp"

namespace dygita {

namespace {

constexpr double within = 1e-6;  // relative, of the solid's extent

struct Measure {
  double size = 0.0;  // volume or area
  Vec3 centre = Vec3::Zero();
};

Measure measure(int dimension, int tag) {
  Measure m;
  gmsh::model::occ::getMass(dimension, tag, m.size);
  gmsh::model::occ::getCenterOfMass(dimension, tag, m.centre[0], m.centre[1], m.centre[2]);
  return m;
}

std::vector<Measure> measures(const std::vector<int>& surfaces) {
  std::vector<Measure> all;
  for (const int surface : surfaces) all.push_back(measure(2, surface));
  return all;
}

bool is_flat(int surface) {
  std::string type;
  gmsh::model::getType(2, surface, type);
  return type == "Plane";
}

// Of a flat face, out of or into the solid.
Vec3 normal_of(int surface) {
  std::vector<double> low, high, normal;
  gmsh::model::getParametrizationBounds(2, surface, low, high);
  gmsh::model::getNormal(surface, {0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])}, normal);
  return Eigen::Map<const Vec3>(normal.data()).normalized();
}

bool is_like(const Measure& a, const Measure& b, double length, double size) {
  return std::abs(a.size - b.size) <= within * size && (a.centre - b.centre).norm() <= within * length;
}

// The surfaces of the new solid in the order of the old one's; empty where one has no counterpart.
std::vector<int> in_old_order(const std::vector<Measure>& old, const std::vector<int>& made, double length) {
  if (old.size() != made.size()) return {};
  const std::vector<Measure> now = measures(made);
  std::vector<int> ordered;
  for (const Measure& one : old) {
    const auto same = std::find_if(now.begin(), now.end(),
                                   [&](const Measure& other) { return is_like(one, other, length, one.size); });
    if (same == now.end()) return {};
    ordered.push_back(made[static_cast<size_t>(same - now.begin())]);
  }
  return ordered;
}

void remove_solid(int solid, const std::vector<int>& surfaces, int but) {
  gmsh::model::occ::remove({{3, solid}});
  for (const int surface : surfaces)
    if (surface != but) gmsh::model::occ::remove({{2, surface}}, true);
}

// The solid made of `base` moved by `way`, with its measures; taken back unless it is the old one.
std::optional<SweptSolid> sweep(int solid, const std::vector<int>& surfaces, int base, const Vec3& way, int layers) {
  const double length = std::cbrt(measure(3, solid).size);
  const std::vector<Measure> old = measures(surfaces);
  GmshEntities made, boundary;
  gmsh::model::occ::extrude({{2, base}}, way[0], way[1], way[2], made, {layers}, {}, true);
  gmsh::model::occ::synchronize();
  SweptSolid swept{made.at(1).second, {}};
  gmsh::model::getBoundary({{3, swept.tag}}, boundary, false, false);
  for (const auto& entity : boundary) swept.surfaces.push_back(entity.second);
  const std::vector<int> all = swept.surfaces;
  const Measure before = measure(3, solid);
  swept.surfaces = in_old_order(old, all, length);
  const bool is_same = is_like(before, measure(3, swept.tag), length, before.size) && !swept.surfaces.empty();
  if (is_same)
    remove_solid(solid, surfaces, base);
  else
    remove_solid(swept.tag, all, base);
  gmsh::model::occ::synchronize();
  return is_same ? std::optional(swept) : std::nullopt;
}

}  // namespace

std::optional<SweptSolid> sweep_solid(int solid, const std::vector<int>& surfaces, double size) {
  const Measure whole = measure(3, solid);
  const std::vector<Measure> areas = measures(surfaces);
  std::vector<size_t> order(surfaces.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return areas[a].size > areas[b].size; });
  for (const size_t i : order) {
    if (!is_flat(surfaces[i])) continue;
    // Moved along its normal, the face is a prism whose centre lies half way.
    const Vec3 way = 2.0 * (whole.centre - areas[i].centre), normal = normal_of(surfaces[i]);
    const double height = way.norm();
    if (std::abs(areas[i].size * height - whole.size) > within * whole.size) continue;
    if (way.cross(normal).norm() > within * height) continue;
    const int layers = std::max(1, static_cast<int>(std::lround(height / size)));
    if (auto swept = sweep(solid, surfaces, surfaces[i], way, layers)) {
      gmsh::model::mesh::setRecombine(2, surfaces[i]);
      return swept;
    }
  }
  return std::nullopt;
}

void leave_others_unswept(const std::vector<int>& solids) {
  std::set<std::pair<int, int>> swept;
  for (const int solid : solids) {
    const std::pair<int, int> whole{3, solid};
    swept.insert(whole);
    for (int dimension = 2; dimension > 0; --dimension) {
      GmshEntities of, boundary;
      for (const auto& entity : swept)
        if (entity.first == dimension + 1) of.push_back(entity);
      gmsh::model::getBoundary(of, boundary, false, false);
      swept.insert(boundary.begin(), boundary.end());
    }
  }
  GmshEntities all, others;
  gmsh::model::getEntities(all);
  for (const auto& entity : all)
    if (entity.first > 0 && !swept.contains(entity)) others.push_back(entity);
  if (!others.empty()) gmsh::model::mesh::removeConstraints(others);  // of none it means all
}

}  // namespace dygita
