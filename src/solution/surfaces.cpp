#include "solution/surfaces.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <deque>
#include <map>

#include "base/parallel.hpp"
#include "law/law.hpp"
#include "mesh/mortar.hpp"
#include "solution/preload.hpp"

namespace dygita {

bool takes_part(const Problem& problem, const Step& step, const Surface& surface) {
  if (surface.wall && index_of(supports_of(problem, step), surface.wall) < 0) return false;
  return surface.declared_law().takes_part(step.is_static);
}

namespace {

constexpr int any_part = -2;

// What some load acts on is a law of its own, never part of a group nor one with its neighbours.
bool has_load(const Problem& problem, const Interface* interface) {
  for (const StepPtr& step : problem.steps)
    for (const LoadPtr& load : step->loads)
      for (const Target& target : load->on)
        if (const auto* on = std::get_if<InterfacePtr>(&target); on && on->get() == interface) return true;
  return false;
}

bool is_alike(const Law& a, const Law& b) {
  const std::vector<LawParameter> of_a = a.parameters(), of_b = b.parameters();
  return a.word() == b.word() &&
         std::equal(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(),
                    [](const LawParameter& p, const LawParameter& q) { return p.value == q.value; });
}

// Laws that join their like share one object: where such faces meet at a node they act as one (exchange.cpp).
class SharedLaws {
 public:
  const LawPtr& of(const LawPtr& law) {
    if (!law->joins_its_like()) return law;
    const auto same =
        std::find_if(known_.begin(), known_.end(), [&](const LawPtr& known) { return is_alike(*known, *law); });
    return same != known_.end() ? *same : known_.emplace_back(law);
  }

 private:
  std::deque<LawPtr> known_;
};

// A law acts point by point with the force on the area of a node. On facets of order two without a middle node forces
// at corners are zero or pull under uniform pressure, and would open it there: such faces have the points of
// sub-facets.
Facing facing_of_wall(const Face& face) {
  const std::vector<Facet>& facets = face.facets();
  const bool has_shared = std::any_of(facets.begin(), facets.end(), [](const Facet& facet) {
    return facet_shape(facet.type()).is_shared_by_sub_facets;
  });
  return has_shared ? facing_on_rigid(placed(face)) : facing_of(placed(face));
}

// Facets named by two interfaces would carry their forces twice. Where meshes do not match, a facet may lie under
// several bodies, but under each only once.
void check_overlaps(const Problem& problem, const std::vector<Surface>& surfaces) {
  std::map<std::tuple<int, FacetKey, int>, const Surface*> owner;
  const auto claim = [&](const Surface& surface, int part, const std::vector<Facet>& facets, int other) {
    for (const Facet& facet : facets) {
      const auto [it, is_new] =
          owner.emplace(std::tuple{part, facet_key(facet), surface.facing.matches() ? any_part : other}, &surface);
      if (is_new || it->second == &surface) continue;
      const Origin& origin = surface.interface ? surface.interface->origin : surface.wall->origin;
      throw InputError(origin, "'" + surface.name() + "' and '" + it->second->name() +
                                   "' share facets of substructure '" + problem.substructures[part]->name +
                                   "': a facet can be in one interface or wall only");
    }
  };
  for (const Surface& surface : surfaces) {
    claim(surface, surface.part_1, surface.facing.facets_1, surface.part_2);
    if (surface.part_2 >= 0) claim(surface, surface.part_2, surface.facing.facets_2, surface.part_1);
  }
}

// Points of the other interfaces' facets that a body has.
class FacetsOfOthers {
 public:
  FacetsOfOthers(const Problem& problem, const std::vector<std::optional<Meeting>>& meetings) {
    for (size_t i = 0; i < meetings.size(); ++i) {
      const Interface& interface = *problem.interfaces[i];
      add(problem, static_cast<int>(i), interface.side_1, meetings[i]->facets_1());
      add(problem, static_cast<int>(i), interface.side_2, meetings[i]->facets_2());
    }
  }

  // Does x lie on a facet of a body that this interface has too, where a contact is, or a bond declared before?
  bool take(const Problem& problem, int i, const Vec3& x) const {
    for (const Entry& entry : entries_) {
      if (entry.interface == i) continue;
      const Interface &own = *problem.interfaces[i], &other = *problem.interfaces[entry.interface];
      if (other.law->is_tie() && entry.interface > i) continue;
      if (entry.body != own.side_1.part.get() && entry.body != own.side_2.part.get()) continue;
      if ((x - entry.low).minCoeff() < -entry.tolerance || (entry.high - x).minCoeff() < -entry.tolerance) continue;
      for (const Polygon& polygon : entry.polygons)
        if (lies_on(x, polygon, entry.tolerance)) return true;
    }
    return false;
  }

 private:
  struct Entry {
    int interface;
    const Substructure* body;
    std::vector<Polygon> polygons;
    double tolerance;  // m
    Vec3 low, high;
  };

  void add(const Problem&, int i, const Face& face, const std::vector<Facet>& facets) {
    PlacedFace own = placed(face);
    own.facets = facets;
    const FaceInSpace in_space(own);
    Entry entry{i,
                face.part.get(),
                {},
                1e-6 * in_space.smallest_edge(),
                in_space.x.rowwise().minCoeff(),
                in_space.x.rowwise().maxCoeff()};
    for (const FaceInSpace::Part& part : in_space.parts) entry.polygons.push_back(part.x);
    entries_.push_back(std::move(entry));
  }

  static bool lies_on(const Vec3& x, const Polygon& polygon, double tolerance) {
    const Vec3 normal = area_vector(polygon).normalized();
    if (std::abs(normal.dot(x - polygon.rowwise().mean())) > tolerance) return false;
    for (int a = 0; a < polygon.cols(); ++a) {
      const Vec3 edge = polygon.col((a + 1) % polygon.cols()) - polygon.col(a);
      if (edge.cross(x - polygon.col(a)).dot(normal) < -tolerance * edge.norm()) return false;
    }
    return true;
  }

  std::vector<Entry> entries_;
};

// Gaps of the places mean nothing where facets of round faces are as far off.
void check_gap_of_geometry(const Interface& interface, const Facing& facing) {
  const double largest = facing.gaps.size() > 0 ? facing.gaps.cwiseAbs().maxCoeff() : 0.0;
  if (facing.sagitta <= 0.1 * largest || facing.sagitta < 1e-12) return;
  throw InputError(
      interface.origin,
      fmt::format(
          "interface '{}': 'gap' = \"geometry\": the facets of '{}' and '{}' are up to {:.3g} mm off the round "
          "face that they stand for, the largest gap between them is {:.3g} mm\n    declare the gap as a length, "
          "or mesh finer",
          interface.name, interface.side_1.label(), interface.side_2.label(), 1e3 * facing.sagitta, 1e3 * largest));
}

// The points of an interface. Where three bodies are tied along a line, one of the ties leaves it to the others: tied
// once too often, it would not converge well (manual, eq. J5).
Facing facing_of(const Problem& problem, int i, const std::vector<std::optional<Meeting>>& meetings,
                 const FacetsOfOthers& others) {
  const Interface& interface = *problem.interfaces[i];
  const auto is_taken = [&](const Vec3& x) { return others.take(problem, i, x); };
  Facing facing = meetings[i]->facing(interface.law->is_tie() ? is_taken : std::function<bool(const Vec3&)>());
  if (interface.has_gap_of_geometry) check_gap_of_geometry(interface, facing);
  return facing;
}

}  // namespace

std::vector<Surface> make_surfaces(const Problem& problem) {
  std::vector<Surface> surfaces;
  SharedLaws laws;
  const int n = static_cast<int>(problem.interfaces.size());
  std::vector<std::optional<Meeting>> meetings(static_cast<size_t>(n));
  const double within = n > 0 ? default_within(problem) : 0.0;
  parallel_for(n, [&](int i) { meetings[i].emplace(meeting_of(*problem.interfaces[i], within)); });
  const FacetsOfOthers others(problem, meetings);
  std::vector<Facing> facings(static_cast<size_t>(n));
  parallel_for(n, [&](int i) { facings[i] = facing_of(problem, i, meetings, others); });
  for (size_t i = 0; i < problem.interfaces.size(); ++i) {
    const InterfacePtr& interface = problem.interfaces[i];
    Surface surface;
    surface.interface = interface.get();
    surface.part_1 = index_of(problem.substructures, interface->side_1.part.get());
    surface.part_2 = index_of(problem.substructures, interface->side_2.part.get());
    surface.facing = std::move(facings[i]);
    // A tie between meshes that do not match is a law of its own.
    if (has_load(problem, interface.get()) || (interface->law->is_tie() && !surface.facing.matches()))
      surface.law = interface->law;
    else if (!interface->law->is_tie())
      surface.law = laws.of(interface->law);
    surfaces.push_back(std::move(surface));
  }
  std::vector<const Support*> walls;
  for (const StepPtr& step : problem.steps)
    for (const SupportPtr& support : supports_of(problem, *step))
      if (support->kind->law() && std::find(walls.begin(), walls.end(), support.get()) == walls.end())
        walls.push_back(support.get());
  for (const Support* wall : walls)
    for (const FaceOrRegion& on : wall->on) {
      const Face& face = std::get<Face>(on);
      Surface surface;
      surface.wall = wall;
      surface.part_1 = index_of(problem.substructures, face.part.get());
      surface.facing = facing_of_wall(face);
      surface.law = laws.of(wall->kind->law());
      surfaces.push_back(std::move(surface));
    }
  check_overlaps(problem, surfaces);
  check_preloads(problem, surfaces);
  return surfaces;
}

}  // namespace dygita
