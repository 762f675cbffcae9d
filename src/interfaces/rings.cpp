#include "interfaces/rings.hpp"

#include <algorithm>
#include <tuple>

#include "law/law.hpp"
#include "meeting/segments.hpp"

namespace dygita {

namespace {

bool lies_on(const Vec3& x, const Polygon& polygon, double tolerance) {
  const Vec3 normal = area_vector(polygon).normalized();
  if (std::abs(normal.dot(x - polygon.rowwise().mean())) > tolerance) return false;
  for (int a = 0; a < polygon.cols(); ++a) {
    const Vec3 edge = polygon.col((a + 1) % polygon.cols()) - polygon.col(a);
    if (edge.cross(x - polygon.col(a)).dot(normal) < -tolerance * edge.norm()) return false;
  }
  return true;
}

}  // namespace

Rings::Rings(const Problem& problem, const std::vector<std::optional<Meeting>>& meetings) : problem_(problem) {
  for (size_t i = 0; i < meetings.size(); ++i) {
    if (!meetings[i]) continue;  // mean motions are joined
    const Interface& interface = *problem.interfaces[i];
    add(static_cast<int>(i), interface.side_1, meetings[i]->facets_1());
    add(static_cast<int>(i), interface.side_2, meetings[i]->facets_2());
  }
}

std::function<bool(const Vec3&)> Rings::closed_by(int i) const {
  const Entry& own = *std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.interface == i; });
  std::vector<const Entry*> near;
  for (const Entry& entry : entries_) {
    const double apart = std::max((entry.low - own.high).maxCoeff(), (own.low - entry.high).maxCoeff());
    if (apart <= entry.tolerance && entry.interface != i && comes_before(entry.interface, i)) near.push_back(&entry);
  }
  return [this, i, near = std::move(near)](const Vec3& x) { return are_joined(i, near, x); };
}

void Rings::add(int i, const Face& face, const std::vector<Facet>& facets) {
  PlacedFace own = placed(face);
  own.facets = facets;
  const FaceInSpace in_space(own);
  Entry entry{i, {}, 1e-6 * in_space.smallest_edge(), in_space.x.rowwise().minCoeff(), in_space.x.rowwise().maxCoeff()};
  double area = 0.0;
  for (const FaceInSpace::Part& part : in_space.parts) {
    entry.polygons.push_back(part.x);
    area += part.area;
  }
  entries_.push_back(std::move(entry));
  areas_.resize(problem_.interfaces.size());
  areas_[static_cast<size_t>(i)] = std::max(areas_[static_cast<size_t>(i)], area);
}

bool Rings::are_joined(int i, const std::vector<const Entry*>& by, const Vec3& x) const {
  const Interface& own = *problem_.interfaces[static_cast<size_t>(i)];
  std::vector<std::pair<const Substructure*, const Substructure*>> joined;
  for (const Entry* entry : by) {
    if (!has(*entry, x)) continue;
    const Interface& other = *problem_.interfaces[static_cast<size_t>(entry->interface)];
    joined.emplace_back(other.side_1.part.get(), other.side_2.part.get());
  }
  std::vector<const Substructure*> reached{own.side_1.part.get()};
  for (size_t k = 0; k < reached.size(); ++k)
    for (const auto& [a, b] : joined)
      for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)})
        if (from == reached[k] && std::find(reached.begin(), reached.end(), to) == reached.end()) reached.push_back(to);
  return std::find(reached.begin(), reached.end(), own.side_2.part.get()) != reached.end();
}

bool Rings::comes_before(int i, int j) const {
  constexpr double alike = 1e-6;
  const auto is_tie = [&](int k) { return problem_.interfaces[static_cast<size_t>(k)]->law->is_tie(); };
  if (is_tie(i) != is_tie(j)) return is_tie(j);
  const double a = areas_[static_cast<size_t>(i)], b = areas_[static_cast<size_t>(j)];
  if (std::abs(a - b) > alike * std::max(a, b)) return a > b;
  const auto names = [&](int k) {
    const Interface& own = *problem_.interfaces[static_cast<size_t>(k)];
    const auto sides = std::minmax({own.side_1.label(), own.side_2.label()});
    return std::tuple(sides.first, sides.second, k);
  };
  return names(i) < names(j);
}

bool Rings::has(const Entry& entry, const Vec3& x) {
  if ((x - entry.low).minCoeff() < -entry.tolerance || (entry.high - x).minCoeff() < -entry.tolerance) return false;
  return std::any_of(entry.polygons.begin(), entry.polygons.end(),
                     [&](const Polygon& polygon) { return lies_on(x, polygon, entry.tolerance); });
}

}  // namespace dygita
