#include "interfaces/rings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "law/law.hpp"
#include "meeting/sagitta.hpp"
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

// Interfaces that a load lets go in a step.
std::set<InterfacePtr> released_in(const Problem& problem) {
  std::set<InterfacePtr> released;
  for (const StepPtr& step : problem.steps)
    for (const LoadPtr& load : step->loads)
      for (const Effect& effect : load->effects())
        if (const auto* release = std::get_if<Release>(&effect)) released.insert(release->on);
  return released;
}

// Is there such a way with one of `one_of` in it?
template <class Place>
bool reaches_with(const Place& one, const Place& other, const std::vector<std::pair<Place, Place>>& joined,
                  const std::vector<std::pair<Place, Place>>& one_of) {
  return std::any_of(one_of.begin(), one_of.end(), [&](const auto& link) {
    const auto& [a, b] = link;
    return (reaches(one, a, joined) && reaches(b, other, joined)) ||
           (reaches(one, b, joined) && reaches(a, other, joined));
  });
}

// What the other face covers of the parts of a face.
std::vector<Polygon> covered(const FaceInSpace& face, const PlacedFace& covering, double reach) {
  const FaceInSpace other(covering);
  const SegmentFinder finder(face, other, reach);
  constexpr double nothing = 1e-9;
  std::vector<Polygon> polygons;
  for (size_t p = 0; p < face.parts.size(); ++p) {
    const auto axes = SegmentFinder::axes(face.parts[p]);
    for (const Segment& segment : finder.segments(static_cast<int>(p)))
      for (size_t a = 1; a + 1 < segment.region.size(); ++a) {
        Polygon triangle(3, 3);
        triangle << axes * segment.region[0], axes * segment.region[a], axes * segment.region[a + 1];
        if (area_vector(triangle).norm() > nothing * face.parts[p].area)
          polygons.emplace_back(triangle.colwise() + face.parts[p].centre);
      }
  }
  return polygons;
}

bool are_alike(const std::string& word_a, const std::vector<LawParameter>& a, const std::string& word_b,
               const std::vector<LawParameter>& b) {
  return word_a == word_b &&
         std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const LawParameter& p, const LawParameter& q) { return p.value == q.value; });
}

}  // namespace

bool is_alike(const Law& a, const Law& b) { return are_alike(a.word(), a.parameters(), b.word(), b.parameters()); }

bool press_alike(const Law& a, const Law& b) {
  const auto of_pressure = [](const Law& law) {
    std::vector<LawParameter> parameters = law.parameters();
    std::erase_if(parameters, [](const LawParameter& p) { return p.name == "friction"; });
    return parameters;
  };
  return a.acts_on(1, false) == b.acts_on(1, false) && are_alike(a.word(), of_pressure(a), b.word(), of_pressure(b));
}

bool has_load(const Problem& problem, const Interface* interface) {
  for (const StepPtr& step : problem.steps)
    for (const LoadPtr& load : step->loads)
      for (const Target& target : load->on)
        if (const auto* on = std::get_if<InterfacePtr>(&target); on && on->get() == interface) return true;
  return false;
}

Rings::Rings(const Problem& problem, const std::vector<std::optional<Meeting>>& meetings)
    : problem_(problem),
      areas_(problem.interfaces.size()),
      moduli_(problem.interfaces.size()),
      near_(problem.interfaces.size(), std::numeric_limits<double>::infinity()) {
  const std::set<InterfacePtr> released = released_in(problem);
  for (size_t i = 0; i < meetings.size(); ++i) {
    if (!meetings[i]) continue;  // mean motions are joined
    const Interface& interface = *problem.interfaces[i];
    moduli_[i] =
        std::min(interface.side_1.part->material.shear_modulus(), interface.side_2.part->material.shear_modulus());
    if (meetings[i]->matches()) matching_.insert(static_cast<int>(i));
    // A tie in all steps: contact may open.
    if (interface.law->is_tie() && !released.contains(problem.interfaces[i])) holding_.insert(static_cast<int>(i));
    PlacedFace one = placed(interface.side_1), other = placed(interface.side_2);
    one.facets = meetings[i]->facets_1();
    other.facets = meetings[i]->facets_2();
    const bool is_whole = meetings[i]->matches() || interface.cyclic;
    const double reach = meetings[i]->reach();
    add(static_cast<int>(i), one, is_whole ? nullptr : &other, reach);
    if (!interface.cyclic) add(static_cast<int>(i), other, is_whole ? nullptr : &one, reach);
  }
}

std::function<bool(const Vec3&)> Rings::closed_by(int i) const {
  if (const auto& cyclic = problem_.interfaces[static_cast<size_t>(i)]->cyclic)
    return [this, i, &cyclic = *cyclic](const Vec3& x) { return are_joined_around(i, cyclic, x); };
  const Entry& own = *std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.interface == i; });
  std::vector<const Entry*> near;
  for (const Entry& entry : entries_) {
    const double apart = std::max((entry.low - own.high).maxCoeff(), (own.low - entry.high).maxCoeff());
    if (apart <= tolerance(entry, i) && is_asked(entry.interface, i)) near.push_back(&entry);
  }
  if (near.empty()) return {};
  return [this, i, near = std::move(near)](const Vec3& x) { return are_joined(i, near, x); };
}

// Three faces that meet in a circle have each their own polygon of it: chords of an eighth part of it are a tenth of
// their length off, and facets of round faces their sagitta.
void Rings::add(int i, const PlacedFace& own, const PlacedFace* covering, double reach) {
  constexpr double near = 0.1, nearest = 0.5;  // of the shortest edge
  const FaceInSpace face(own);
  const double edge = face.smallest_edge();
  const double tolerance = std::min(std::max(near * edge, sagitta_margin * face.sagitta()), nearest * edge);
  near_[static_cast<size_t>(i)] = std::min(near_[static_cast<size_t>(i)], tolerance);
  std::vector<Polygon> whole;
  double area = 0.0;
  for (const FaceInSpace::Part& part : face.parts) {
    whole.push_back(part.x);
    area += part.area;
  }
  std::vector<Polygon> polygons = covering ? covered(face, *covering, reach) : whole;
  // Slivers of what is covered are far smaller than the facets.
  PolygonGrid grid(polygons, mean_diameter(whole), tolerance);
  Entry entry{i,         std::move(polygons),         std::move(grid),
              tolerance, face.x.rowwise().minCoeff(), face.x.rowwise().maxCoeff()};
  entries_.push_back(std::move(entry));
  areas_[static_cast<size_t>(i)] = std::max(areas_[static_cast<size_t>(i)], area);
}

bool Rings::are_joined(int i, const std::vector<const Entry*>& by, const Vec3& x) const {
  const Interface& own = *problem_.interfaces[static_cast<size_t>(i)];
  std::vector<std::pair<const Substructure*, const Substructure*>> joined, contacts;
  for (const Entry* entry : by) {
    if (!has(*entry, x, tolerance(*entry, i))) continue;
    const Interface& other = *problem_.interfaces[static_cast<size_t>(entry->interface)];
    (holding_.contains(entry->interface) ? joined : contacts)
        .emplace_back(other.side_1.part.get(), other.side_2.part.get());
  }
  const Substructure *one = own.side_1.part.get(), *other = own.side_2.part.get();
  return reaches(one, other, joined) || reaches_with(one, other, joined, contacts);
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
      if (!has(entry, cut == 1 ? x : opposite, tolerance(entry, i))) continue;
      if (!other.cyclic)
        joined.push_back({{a, cut}, {b, cut}});
      else if (other.cyclic->turn.isApprox(cut == 1 ? cyclic.turn : Mat3(cyclic.turn.transpose())))
        joined.push_back({{a, cut}, {b, 3 - cut}});
    }
  }
  const Interface& own = *problem_.interfaces[static_cast<size_t>(i)];
  return reaches<Place>({own.side_1.part.get(), 1}, {own.side_2.part.get(), 2}, joined);
}

// Soft bodies do not make those that are in contact move as one.
bool Rings::is_asked(int i, int j) const {
  if (i == j) return false;
  if (!holding_.contains(j) && holding_.contains(i) && decade(i) < decade(j)) return false;
  return comes_before(i, j) || (are_contacts_of_one_kind(i, j) && is_stronger(i, j));
}

double Rings::decade(int i) const { return std::floor(std::log10(moduli_[static_cast<size_t>(i)])); }

double Rings::tolerance(const Entry& entry, int i) const {
  return std::min(entry.tolerance, near_[static_cast<size_t>(i)]);
}

bool Rings::comes_before(int i, int j) const {
  if (!holding_.contains(i) || !holding_.contains(j)) return holding_.contains(i);
  const auto is_cyclic = [&](int k) { return problem_.interfaces[static_cast<size_t>(k)]->cyclic.has_value(); };
  if (is_cyclic(i) != is_cyclic(j)) return is_cyclic(j);
  if (matching_.contains(i) != matching_.contains(j)) return matching_.contains(i);
  return is_stronger(i, j);
}

// Between stiff bodies first: of contacts they carry the more; tied to each other through a node of a soft body, they
// would feel each other over many iterations only, which tells for decades.
bool Rings::is_stronger(int i, int j) const {
  constexpr double alike = 1e-6;
  const auto stiffness = [&](int k) {
    const double modulus = moduli_[static_cast<size_t>(k)];
    return holding_.contains(k) ? std::pow(10.0, decade(k)) : modulus;
  };
  const auto area = [&](int k) { return areas_[static_cast<size_t>(k)]; };
  const auto differ = [](double a, double b) { return std::abs(a - b) > alike * std::max(a, b); };
  if (differ(stiffness(i), stiffness(j))) return stiffness(i) > stiffness(j);
  if (differ(area(i), area(j))) return area(i) > area(j);
  const auto names = [&](int k) {
    const Interface& own = *problem_.interfaces[static_cast<size_t>(k)];
    const auto sides = std::minmax({own.side_1.label(), own.side_2.label()});
    return std::tuple(sides.first, sides.second, k);
  };
  return names(i) < names(j);
}

// Where nodes meet, contacts act as one already (exchange.cpp).
bool Rings::are_contacts_of_one_kind(int i, int j) const {
  const auto can_share = [&](int k) {
    const Interface& own = *problem_.interfaces[static_cast<size_t>(k)];
    return !holding_.contains(k) && own.law->joins_its_like() && !own.has_gap_of_geometry && !own.cyclic &&
           !has_load(problem_, &own);
  };
  return !matching_.contains(j) && can_share(i) && can_share(j) &&
         press_alike(*problem_.interfaces[static_cast<size_t>(i)]->law,
                     *problem_.interfaces[static_cast<size_t>(j)]->law);
}

bool Rings::has(const Entry& entry, const Vec3& x, double tolerance) {
  if ((x - entry.low).minCoeff() < -tolerance || (entry.high - x).minCoeff() < -tolerance) return false;
  bool is_on = false;
  const Polygon at = x;
  entry.grid.for_each_near(at, [&](int i) { is_on |= lies_on(x, entry.polygons[static_cast<size_t>(i)], tolerance); });
  return is_on;
}

}  // namespace dygita
