#include "interfaces/rings.hpp"

#include <algorithm>
#include <tuple>

#include "law/law.hpp"
#include "meeting/segments.hpp"
#include "model/load.hpp"

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

// Is there a way from one to the other through what is joined?
template <class Place>
bool reaches(const Place& one, const Place& other, const std::vector<std::pair<Place, Place>>& joined) {
  std::vector<Place> reached{one};
  for (size_t k = 0; k < reached.size(); ++k)
    for (const auto& [a, b] : joined)
      for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)})
        if (from == reached[k] && std::find(reached.begin(), reached.end(), to) == reached.end()) reached.push_back(to);
  return std::find(reached.begin(), reached.end(), other) != reached.end();
}

// Is it a tie in all steps? Contact may open, and what a load releases lets go.
bool holds_always(const Problem& problem, const InterfacePtr& interface) {
  const auto releases = [&](const Effect& effect) {
    const auto* release = std::get_if<Release>(&effect);
    return release && release->on == interface;
  };
  for (const StepPtr& step : problem.steps)
    for (const LoadPtr& load : step->loads)
      if (const std::vector<Effect> effects = load->effects(); std::any_of(effects.begin(), effects.end(), releases))
        return false;
  return interface->law->is_tie();
}

}  // namespace

Rings::Rings(const Problem& problem, const std::vector<std::optional<Meeting>>& meetings) : problem_(problem) {
  for (size_t i = 0; i < meetings.size(); ++i) {
    if (!meetings[i]) continue;  // mean motions are joined
    const Interface& interface = *problem.interfaces[i];
    if (meetings[i]->matches()) matching_.insert(static_cast<int>(i));
    if (holds_always(problem, problem.interfaces[i])) holding_.insert(static_cast<int>(i));
    add(static_cast<int>(i), interface.side_1, meetings[i]->facets_1());
    if (!interface.cyclic) add(static_cast<int>(i), interface.side_2, meetings[i]->facets_2());
  }
}

std::function<bool(const Vec3&)> Rings::closed_by(int i) const {
  if (const auto& cyclic = problem_.interfaces[static_cast<size_t>(i)]->cyclic)
    return [this, i, &cyclic = *cyclic](const Vec3& x) { return are_joined_around(i, cyclic, x); };
  const Entry& own = *std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.interface == i; });
  std::vector<const Entry*> near;
  for (const Entry& entry : entries_) {
    const double apart = std::max((entry.low - own.high).maxCoeff(), (own.low - entry.high).maxCoeff());
    if (apart <= entry.tolerance && entry.interface != i && comes_before(entry.interface, i)) near.push_back(&entry);
  }
  if (near.empty()) return {};
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
  return reaches(own.side_1.part.get(), own.side_2.part.get(), joined);
}

// The same of the cut faces of a sector: parts at x, on the first of them, and where x came from, on the second. Where
// nodes meet, no cut of unlike meshes implies their ties: they stay, as those of the whole ring do.
bool Rings::are_joined_around(int i, const CyclicSymmetry& cyclic, const Vec3& x) const {
  using Place = std::pair<const Substructure*, int>;
  const Vec3 opposite = cyclic.through + cyclic.turn.transpose() * (x - cyclic.through);
  std::vector<std::pair<Place, Place>> joined;
  for (const Entry& entry : entries_) {
    if (entry.interface == i || !comes_before(entry.interface, i)) continue;
    const Interface& other = *problem_.interfaces[static_cast<size_t>(entry.interface)];
    if (other.cyclic && matching_.contains(i) && !matching_.contains(entry.interface)) continue;
    const Substructure *a = other.side_1.part.get(), *b = other.side_2.part.get();
    for (const int cut : {1, 2}) {
      if (!has(entry, cut == 1 ? x : opposite)) continue;
      if (!other.cyclic)
        joined.push_back({{a, cut}, {b, cut}});
      else if (other.cyclic->turn.isApprox(cut == 1 ? cyclic.turn : Mat3(cyclic.turn.transpose())))
        joined.push_back({{a, cut}, {b, 3 - cut}});
    }
  }
  const Interface& own = *problem_.interfaces[static_cast<size_t>(i)];
  return reaches<Place>({own.side_1.part.get(), 1}, {own.side_2.part.get(), 2}, joined);
}

bool Rings::comes_before(int i, int j) const {
  constexpr double alike = 1e-6;
  if (!holding_.contains(i) || !holding_.contains(j)) return holding_.contains(i);
  const auto is_cyclic = [&](int k) { return problem_.interfaces[static_cast<size_t>(k)]->cyclic.has_value(); };
  if (is_cyclic(i) != is_cyclic(j)) return is_cyclic(j);
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
