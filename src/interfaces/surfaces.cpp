#include "interfaces/surfaces.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <deque>
#include <map>
#include <string>

#include "base/parallel.hpp"
#include "base/task.hpp"
#include "interfaces/check_preloads.hpp"
#include "interfaces/gaps_of_places.hpp"
#include "interfaces/rings.hpp"
#include "interfaces/sum_surfaces.hpp"
#include "interfaces/whole_parts.hpp"
#include "law/law.hpp"
#include "meeting/mortar.hpp"
#include "meeting/segments.hpp"
#include "meeting/sum_facing.hpp"
#include "mesh/facet_keys.hpp"

namespace dygita {

bool takes_part(const Problem& problem, const Step& step, const Surface& surface) {
  if (surface.wall && index_of(supports_of(problem, step), surface.wall) < 0) return false;
  return surface.declared_law().takes_part(step.is_static);
}

namespace {

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
  std::vector<Facing> parts;
  for (const PlacedFace& part : smooth_parts(placed(face)))
    parts.push_back(has_shared ? facing_on_rigid(part) : facing_of(part));
  return joined(parts);
}

// Of the usual facet of a face, the share that another face covers of all of it.
double covered(const PlacedFace& own, const PlacedFace& other) {
  const FaceInSpace in_space(own), there(other);
  double all = 0.0, covered = 0.0;
  for (const FaceInSpace::Part& part : in_space.parts) all += part.area;
  const double usual = all / static_cast<double>(own.facets.size());
  const SegmentFinder finder(in_space, there, std::sqrt(usual));
  for (size_t p = 0; p < in_space.parts.size(); ++p)
    for (const Segment& segment : finder.segments(static_cast<int>(p))) covered += segment.area;
  return covered / usual;
}

constexpr double next_to_nothing = 0.01;  // of a facet: what a face reaches over an edge by rounding

// Of a facet on one side of an interface between meshes that do not match, the share that the other side covers.
double covered_share(const Surface& surface, int part, const Facet& facet) {
  const bool is_first = surface.part_1 == part;
  auto [own, other] = placed_sides(*surface.interface);
  if (!is_first) std::swap(own, other);
  own.facets = {facet};
  other.facets = is_first ? surface.facing.facets_2 : surface.facing.facets_1;
  return covered(own, other);
}

// Do two interfaces between the same parts, where meshes do not match, have an area in common?
bool have_common_area(const Surface& a, const Surface& b) {
  const auto shared = [](const std::vector<Facet>& of_a, const std::vector<Facet>& of_b) {
    FacetKeys keys;
    for (const Facet& facet : of_b) keys.insert(facet_key(facet));
    std::vector<Facet> both;
    for (const Facet& facet : of_a)
      if (keys.contains(facet_key(facet))) both.push_back(facet);
    return both;
  };
  const bool is_swapped = a.part_1 != b.part_1;
  auto [own, other] = placed_sides(*a.interface);
  own.facets = shared(a.facing.facets_1, is_swapped ? b.facing.facets_2 : b.facing.facets_1);
  other.facets = shared(a.facing.facets_2, is_swapped ? b.facing.facets_1 : b.facing.facets_2);
  return !own.facets.empty() && !other.facets.empty() && covered(own, other) > next_to_nothing;
}

// Facets named by two interfaces would carry their forces twice. Where meshes do not match, a facet may lie under
// several bodies, or several faces of one, and under none where a wall or a mesh that matches has all of it.
void check_overlaps(const Problem& problem, const std::vector<Surface>& surfaces) {
  struct Claim {
    const Surface* surface;
    int other;
  };
  std::map<std::pair<int, FacetKey>, std::vector<Claim>> claims;
  const auto has_all = [](const Surface& surface) { return surface.facing.matches() || surface.wall; };
  const auto covers = [&](const Surface& surface, int part, const Facet& facet) {
    return has_all(surface) || covered_share(surface, part, facet) > next_to_nothing;
  };
  std::map<std::pair<const Surface*, const Surface*>, bool> known;
  const auto meet = [&](const Surface& a, const Surface& b) {
    const auto [at, is_new] = known.try_emplace({&a, &b}, false);
    if (is_new) at->second = have_common_area(a, b);
    return at->second;
  };
  const auto claim = [&](const Surface& surface, int part, const std::vector<Facet>& facets, int other) {
    for (const Facet& facet : facets) {
      std::vector<Claim>& of_facet = claims[{part, facet_key(facet)}];
      for (const Claim& before : of_facet) {
        if (before.surface == &surface) continue;
        const bool is_alike = !has_all(surface) && !has_all(*before.surface);
        if (is_alike ? before.other != other || !meet(surface, *before.surface)
                     : !(covers(surface, part, facet) && covers(*before.surface, part, facet)))
          continue;
        const Origin& origin = surface.interface ? surface.interface->origin : surface.wall->origin;
        throw InputError(origin, "'" + surface.name() + "' and '" + before.surface->name() +
                                     "' share facets of substructure '" + problem.substructures[part]->name +
                                     "': a facet can be in one interface or wall only");
      }
      of_facet.push_back({&surface, other});
    }
  };
  for (const Surface& surface : surfaces) {
    claim(surface, surface.part_1, surface.facing.facets_1, surface.part_2);
    if (surface.part_2 >= 0) claim(surface, surface.part_2, surface.facing.facets_2, surface.part_1);
  }
}

// The same points of nodes whose motions are turned: arms, which the turned mesh has given, in the nodes' own axes.
SideTrace turned(const SideTrace& met, const Mat3& turn) {
  SideTrace trace;
  for (int i = 0; i < met.n_points(); ++i) {
    std::vector<SideTrace::Share> shares;
    for (int k = 0; k < met.n_shares(i); ++k) {
      const SideTrace::Share& own = met.share(i, k);
      shares.push_back({own.node, own.weight, turn.transpose() * own.arm});
    }
    trace.add(shares, turn.transpose() * met.turn(i) * turn);
  }
  trace.turn_by(turn);
  return trace;
}

// The second side moves as the first one, turned (manual, eq. J9). A node on the axis is on both sides, and moves along
// the axis as it likes. Where faces match, points that `is_taken_away` says of are left to the other ties there.
Facing turned(const CyclicSymmetry& cyclic, const Facing& met, const std::function<bool(const Vec3&)>& is_taken_away) {
  Facing facing = met;
  if (met.matches()) facing = without(met, is_taken_away);
  if (met.matches()) facing.carrier = 1;
  facing.tangent = cyclic.along;
  facing.side_2 = turned(facing.side_2, cyclic.turn);
  for (int i = 0; i < facing.n_points(); ++i) {
    const bool is_on_axis = facing.side_1.is_of_one_node(i) && facing.side_2.is_of_one_node(i) &&
                            cyclic.distance(facing.places.col(i)) < 1e-6 * std::sqrt(facing.areas[i]);
    facing.directions.push_back({true, !is_on_axis, true});
  }
  return facing;
}

// The points of an interface. Where bodies are tied in a ring around a line, one of the ties leaves it to the others,
// and contact to ties: tied once too often, it would not converge well, and the split of its force would be one of many
// (manual, eq. J5).
Facing facing_of(const Problem& problem, int i, const std::vector<std::optional<Meeting>>& meetings,
                 const Rings& rings) {
  const Interface& interface = *problem.interfaces[i];
  if (interface.means) {
    try {
      return facing_of_means(placed(interface.side_1), placed(interface.side_2), *interface.means);
    } catch (const InputError& error) {
      throw InputError(interface.origin, "interface '" + interface.name + "': " + error.what());
    }
  }
  const auto is_taken_away = rings.closed_by(i);
  Facing facing = meetings[i]->facing(is_taken_away);
  if (interface.cyclic) return turned(*interface.cyclic, facing, is_taken_away);
  // Where nodes meet, a tie's conditions are those of the others; contact would act within one node.
  if (is_taken_away && facing.matches() && !interface.law->is_tie() && !interface.law->can_be_tightened())
    if (Facing rest = without(facing, is_taken_away); rest.n_points() > 0) facing = std::move(rest);
  if (interface.has_gap_of_geometry) take_gaps_of_places(problem, interface, facing);
  return facing;
}

void follow(const Substructure& part_1, const Substructure* part_2, const Origin& origin, const std::string& who,
            Facing& facing) {
  try {
    follow_rigid_faces(part_1.mesh.get(), part_1.place, part_2 ? part_2->mesh.get() : nullptr,
                       part_2 ? part_2->place : Vec3(Vec3::Zero()), facing);
  } catch (const InputError& error) {
    throw InputError(origin, who + error.what());
  }
}

}  // namespace

std::vector<Surface> make_surfaces(const Problem& problem, bool has_checked_parts) {
  std::vector<Surface> surfaces;
  SharedLaws laws;
  const int n = static_cast<int>(problem.interfaces.size());
  std::vector<std::optional<Meeting>> meetings(static_cast<size_t>(n));
  const double within = n > 0 ? default_within(problem) : 0.0;
  {
    Task task("points of interfaces", n);
    parallel_for(n, [&](int i) {
      task.tell("'" + problem.interfaces[i]->name + "'");
      if (!problem.interfaces[i]->means) meetings[i].emplace(meeting_of(*problem.interfaces[i], within));
      task.done("'" + problem.interfaces[i]->name + "'");
    });
  }
  const Rings rings(problem, meetings);
  std::vector<Facing> facings(static_cast<size_t>(n));
  parallel_for(n, [&](int i) { facings[i] = facing_of(problem, i, meetings, rings); });
  for (size_t i = 0; i < problem.interfaces.size(); ++i) {
    const InterfacePtr& interface = problem.interfaces[i];
    Surface surface;
    surface.interface = interface.get();
    surface.part_1 = index_of(problem.substructures, interface->side_1.part.get());
    surface.part_2 = index_of(problem.substructures, interface->side_2.part.get());
    surface.facing = std::move(facings[i]);
    follow(*interface->side_1.part, interface->side_2.part.get(), interface->origin,
           "interface '" + interface->name + "': ", surface.facing);
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
  for (const Support* wall : walls) {
    if (!wall->factors.empty()) {
      add_sums(problem, *wall, surfaces);
      continue;
    }
    for (const FaceOrRegion& on : wall->on) {
      const Face& face = std::get<Face>(on);
      Surface surface;
      surface.wall = wall;
      surface.is_on_ground = true;
      surface.part_1 = index_of(problem.substructures, face.part.get());
      surface.facing = facing_of_wall(face);
      follow(*face.part, nullptr, wall->origin, "support.wall '" + wall->name + "': ", surface.facing);
      surface.law = laws.of(wall->kind->law());
      surfaces.push_back(std::move(surface));
    }
  }
  check_overlaps(problem, surfaces);
  if (!has_checked_parts) refuse_seams(problem, surfaces);
  check_preloads(problem, surfaces);
  return surfaces;
}

}  // namespace dygita
