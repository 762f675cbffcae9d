// Parts that touch or overlap without an interface: what interfaces, springs and sums join is set aside, the rest is
// measured and told. One source, since every step passes on the same facets of a pair; hence longer than most.
#include "interfaces/unjoined.hpp"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include "base/parallel.hpp"
#include "base/task.hpp"
#include "base/warnings.hpp"
#include "interfaces/whole_parts.hpp"
#include "law/law.hpp"
#include "meeting/touching.hpp"
#include "mesh/face_nodes.hpp"
#include "model/extent.hpp"
#include "model/load.hpp"
#include "model/meeting.hpp"
#include "model/places.hpp"
#include "model/refusal.hpp"

namespace dygita {

namespace {

constexpr double reach = 0.05, longest_flight = 0.5;  // of the smaller part's size

std::string at(const Vec3& x) { return fmt::format("({:.4g}, {:.4g}, {:.4g}) mm", 1e3 * x[0], 1e3 * x[1], 1e3 * x[2]); }

double area_of(const Substructure& part, const std::vector<Facet>& facets) {
  double area = 0.0;
  for (const Facet& facet : facets) area += facet_area_vector(part.mesh->nodes, facet).norm();
  return area;
}

void join(PlacedBody& body, const std::vector<Facet>& facets) {
  for (const Facet& facet : facets) {
    body.joined.insert(facet_key(facet));
    body.joined_nodes.insert(facet.nodes().begin(), facet.nodes().end());
  }
}

// Where an interface takes all of its facets on one side, and more than what they cover on the other, the rest of those
// is free for what else lies there.
void join_both(const Substructure& part_1, PlacedBody& body_1, const Substructure& part_2, PlacedBody& body_2,
               const Facing& facing) {
  constexpr double whole = 0.98;
  join(body_1, facing.facets_1);
  join(body_2, facing.facets_2);
  const double area = facing.areas.sum();
  const bool is_whole_1 = area > whole * area_of(part_1, facing.facets_1),
             is_whole_2 = area > whole * area_of(part_2, facing.facets_2);
  if (is_whole_1 == is_whole_2) return;
  for (const Facet& facet : is_whole_1 ? facing.facets_2 : facing.facets_1)
    (is_whole_1 ? body_2 : body_1).reused.insert(facet_key(facet));
}

// Of a region those with all of their corners in it.
std::vector<Facet> facets_of(const FaceOrRegion& place) {
  if (const Face* face = std::get_if<Face>(&place)) return face->facets();
  const std::vector<int> nodes = nodes_at(place);
  std::vector<Facet> facets = boundary_facets(*part_of(place).mesh);
  std::erase_if(facets, [&](const Facet& facet) {
    return std::any_of(facet.corners().begin(), facet.corners().end(),
                       [&](int node) { return !std::binary_search(nodes.begin(), nodes.end(), node); });
  });
  return facets;
}

// Springs and sums join the places that they are on, which may well lie on each other.
void join_places(const Support& support, const Substructure& part_1, PlacedBody& body_1, const Substructure& part_2,
                 PlacedBody& body_2) {
  const auto is_on = [&](const Substructure& part) {
    return std::any_of(support.on.begin(), support.on.end(),
                       [&](const FaceOrRegion& place) { return &part_of(place) == &part; });
  };
  if (!is_on(part_1) || !is_on(part_2)) return;
  for (const FaceOrRegion& place : support.on) {
    if (&part_of(place) == &part_1) join(body_1, facets_of(place));
    if (&part_of(place) == &part_2) join(body_2, facets_of(place));
  }
}

PlacedBody body_of(const Problem& problem, int part) {
  const Substructure& body = *problem.substructures[static_cast<size_t>(part)];
  return {body.mesh.get(), body.place};
}

// m, that two parts come nearer to each other, or farther away, as they fly at first.
double flight_of(const Problem& problem, int part_1, int part_2) {
  double duration = 0.0;
  for (const StepPtr& step : problem.steps)
    if (!step->is_static) duration += step->duration;
  const auto velocity = [&](int part) { return problem.substructures[static_cast<size_t>(part)]->velocity; };
  return duration * (velocity(part_1) - velocity(part_2)).norm();
}

Box box_of(const Substructure& part, const std::vector<Facet>& facets) {
  Box box;
  for (const Facet& facet : facets)
    for (const int node : facet.nodes()) box.add(part.mesh->nodes.col(node) + part.place);
  return box;
}

// Two faces of one size, of which a part only coincides, are hardly meant to lie a cell or two apart.
void doubt_shift(const Problem& problem, const Surface& surface) {
  const Face &face_1 = surface.interface->side_1, &face_2 = surface.interface->side_2;
  const std::vector<Facet>&all_1 = face_1.facets(), &all_2 = face_2.facets(), &matched = surface.facing.facets_1;
  if (matched.size() == all_1.size() || surface.facing.facets_2.size() == all_2.size()) return;
  const double area_1 = area_of(*face_1.part, all_1), area_2 = area_of(*face_2.part, all_2);
  const Box box_1 = box_of(*face_1.part, all_1), box_2 = box_of(*face_2.part, all_2);
  const double size = box_1.size().norm(), cell = std::sqrt(area_1 / static_cast<double>(all_1.size()));
  if (std::abs(area_1 - area_2) > 1e-6 * area_1 || (box_1.size() - box_2.size()).norm() > 1e-6 * size) return;
  const Vec3 shift = box_2.low - box_1.low;
  if (shift.cwiseAbs().maxCoeff() > 2.5 * cell) return;
  check::doubt(
      problem, surface.interface->origin,
      fmt::format("{} joins two faces of one size, {} and {}, of which {:.3g} % coincide: the second is shifted "
                  "by {}",
                  describe(*surface.interface), face_1.label(), face_2.label(),
                  100.0 * surface.facing.areas.sum() / area_1, at(shift)));
}

// 'within' lets faces meet across a distance that the law then knows nothing of.
void doubt_distance(const Problem& problem, const Surface& surface) {
  const Interface& interface = *surface.interface;
  const Facing& facing = surface.facing;
  const bool knows = interface.has_gap_of_geometry || interface.law->initial().gap != 0.0;
  if (!interface.within || knows || facing.matches() || facing.n_points() == 0) return;
  const double largest = facing.gaps.cwiseAbs().maxCoeff();
  if (largest <= std::max(default_within(problem), 2.0 * facing.sagitta)) return;
  check::doubt(problem, interface.origin,
               fmt::format("{} joins faces that are up to {:.3g} mm apart as if in contact{}", describe(interface),
                           1e3 * largest,
                           interface.law->is_tie() ? "" : ": gap = \"geometry\" includes the distance in the law"),
               {"joined apart", largest, "'" + interface.name + "'"});
}

// How many facets have all their nodes among those that a support holds.
int n_held(const std::vector<Facet>& facets, const std::vector<int>& held) {
  return static_cast<int>(std::count_if(facets.begin(), facets.end(), [&](const Facet& facet) {
    return std::all_of(facet.nodes().begin(), facet.nodes().end(),
                       [&](int node) { return std::binary_search(held.begin(), held.end(), node); });
  }));
}

void doubt_held_side(const Problem& problem, const Surface& surface, const SubstructurePtr& part,
                     const std::vector<Facet>& facets) {
  for (const SupportPtr& support : all_supports(problem)) {
    if (support->kind->law()) continue;
    for (const FaceOrRegion& place : support->on) {
      if (&part_of(place) != part.get()) continue;
      const std::vector<int> held = nodes_at(place);
      const int n = n_held(facets, held);
      if (n == 0 || static_cast<int>(held.size()) == part->mesh->n_nodes()) continue;
      check::doubt(
          problem, surface.interface->origin,
          fmt::format(
              "{} of {} facets of {} are also under {} ({}): the interface cannot move what the support holds there", n,
              facets.size(), describe(*surface.interface), describe(*support), label_of(place)));
    }
  }
}

// Pressures and tractions act on free faces; gas in a joint that can open is one of them, in a bond it has no place.
void doubt_pressed_bond(const Problem& problem, const Surface& surface, const SubstructurePtr& part,
                        const std::vector<Facet>& facets, const SubstructurePtr& other) {
  FacetKeys bonded;
  for (const Facet& facet : facets) bonded.insert(facet_key(facet));
  for (const StepPtr& step : problem.steps)
    for (const LoadPtr& load : step->loads)
      for (const Target& target : load->on) {
        const Face* face = std::get_if<Face>(&target);
        if (!face || face->part != part || std::string_view(load->unit()) != "Pa") continue;
        const std::vector<Facet>& pressed = face->facets();
        const auto n = std::count_if(pressed.begin(), pressed.end(),
                                     [&](const Facet& facet) { return bonded.contains(facet_key(facet)); });
        if (n > 0)
          check::doubt(problem, load->origin,
                       fmt::format("{} acts on {}, of whose {} facets {} {} bonded to '{}' by {}: the load has no "
                                   "effect between bonded faces; was another face intended?",
                                   load->path, face->label(), pressed.size(), n, n == 1 ? "is" : "are", other->name,
                                   describe(*surface.interface)));
      }
}

// What is tied to another part is no longer a face that a third one could come through: the sectors of a ring that
// slide on those of another are not in the sectors beside these.
std::vector<PlacedBody> bodies_with_ties(const Problem& problem, const std::vector<Surface>& surfaces) {
  std::vector<PlacedBody> bodies;
  for (int i = 0; i < static_cast<int>(problem.substructures.size()); ++i) bodies.push_back(body_of(problem, i));
  for (const Surface& surface : surfaces) {
    if (surface.part_2 < 0 || (surface.law && !surface.law->is_tie())) continue;
    for (const Facet& facet : surface.facing.facets_1)
      bodies[static_cast<size_t>(surface.part_1)].joined.insert(facet_key(facet));
    for (const Facet& facet : surface.facing.facets_2)
      bodies[static_cast<size_t>(surface.part_2)].joined.insert(facet_key(facet));
  }
  return bodies;
}

// Has each of some nodes of a part one of the other's at its place?
bool have_equal_places(const Substructure& a, const Substructure& b, double within) {
  constexpr int most = 64;
  if (a.mesh->n_nodes() != b.mesh->n_nodes()) return false;
  const int step = 1 + a.mesh->n_nodes() / most;
  for (int i = 0; i < a.mesh->n_nodes(); i += step) {
    const Vec3 place = a.mesh->nodes.col(i) + a.place - b.place;
    if ((b.mesh->nodes.colwise() - place).colwise().squaredNorm().minCoeff() > within * within) return false;
  }
  return true;
}

// No face of one is inside the other then: nothing else would see them overlap.
void doubt_same_place(const Problem& problem) {
  constexpr double same = 1e-6;  // of the size
  std::vector<Box> boxes;
  for (int i = 0; i < static_cast<int>(problem.substructures.size()); ++i) boxes.push_back(body_of(problem, i).box());
  for (size_t i = 0; i < boxes.size(); ++i)
    for (size_t j = 0; j < i; ++j) {
      const double within = same * boxes[i].size().norm();
      if ((boxes[i].low - boxes[j].low).norm() > within || (boxes[i].high - boxes[j].high).norm() > within) continue;
      const Substructure &a = *problem.substructures[j], &b = *problem.substructures[i];
      if (have_equal_places(a, b, within))
        check::doubt(
            problem, b.origin,
            fmt::format("substructures '{}' and '{}' overlap: they occupy the same place, from {} to {}: check "
                        "'place', or 'n' and 'angle' of a pattern",
                        a.name, b.name, at(boxes[i].low), at(boxes[i].high)));
    }
}

// m, how far the facets of an interface are off the round surfaces between the corners, those with straight edges
// beside curved ones too.
double bend_of(const Interface& interface) {
  const auto outside = [](const Face& face) { return Outside(*face.part->mesh, face.part->place, face.facets()); };
  return find_touching(outside(interface.side_1), outside(interface.side_2), interface.within).bend;
}

}  // namespace

std::string face_with(const Substructure& part, const Facet& facet) {
  const FacetKey key = facet_key(facet);
  const std::string* best = nullptr;
  size_t fewest = 0;
  for (const auto& [name, facets] : part.mesh->faces) {
    if (best && facets.size() >= fewest) continue;
    if (std::none_of(facets.begin(), facets.end(), [&](const Facet& f) { return facet_key(f) == key; })) continue;
    best = &name;
    fewest = facets.size();
  }
  return best ? "'" + part.name + "." + *best + "'" : "'" + part.name + "'";
}

std::vector<Unjoined> find_unjoined(const Problem& problem, const std::vector<Surface>& surfaces) {
  const int n = static_cast<int>(problem.substructures.size());
  const std::vector<PlacedBody> bodies = bodies_with_ties(problem, surfaces);
  std::vector<Box> boxes;
  for (int i = 0; i < n; ++i) boxes.push_back(body_of(problem, i).box());
  std::vector<Unjoined> pairs;
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j) {
      const double size = std::min(boxes[i].size().norm(), boxes[j].size().norm());
      const double near = reach * size + std::min(flight_of(problem, i, j), longest_flight * size);
      if (boxes[i].grown(near).meets(boxes[j].grown(near))) pairs.push_back({i, j, size, near, {}});
    }
  Task task("parts near each other", static_cast<int>(pairs.size()));
  parallel_for(static_cast<int>(pairs.size()), [&](int k) {
    Unjoined& pair = pairs[static_cast<size_t>(k)];
    const int i = pair.part_1, j = pair.part_2;
    PlacedBody body_1 = bodies[static_cast<size_t>(i)], body_2 = bodies[static_cast<size_t>(j)];
    double interference = 0.0;  // m, that their interfaces know of
    for (const Surface& surface : surfaces) {
      if (std::min(surface.part_1, surface.part_2) == i && std::max(surface.part_1, surface.part_2) == j)
        pair.offset = std::max(pair.offset, 2.0 * surface.facing.sagitta);
      if (std::min(surface.part_1, surface.part_2) == i && std::max(surface.part_1, surface.part_2) == j &&
          surface.interface && surface.interface->has_gap_of_geometry && surface.n_points() > 0)
        interference = std::max(interference, -surface.facing.gaps.minCoeff());
      const Substructure &one = *problem.substructures[static_cast<size_t>(i)],
                         &other = *problem.substructures[static_cast<size_t>(j)];
      if (surface.part_1 == i && surface.part_2 == j) join_both(one, body_1, other, body_2, surface.facing);
      if (surface.part_1 == j && surface.part_2 == i) join_both(other, body_2, one, body_1, surface.facing);
    }
    for (const SupportPtr& support : all_supports(problem))
      if (!support->factors.empty())
        join_places(*support, *problem.substructures[static_cast<size_t>(i)], body_1,
                    *problem.substructures[static_cast<size_t>(j)], body_2);
    pair.neighbours = find_neighbours(body_1, body_2, pair.reach);
    if (pair.neighbours.intrusion && pair.neighbours.intrusion->depth <= 1.5 * interference)
      pair.neighbours.intrusion = {};
    task.done(fmt::format("'{}' and '{}'", problem.substructures[static_cast<size_t>(i)]->name,
                          problem.substructures[static_cast<size_t>(j)]->name));
    if (!pair.neighbours.intrusion || pair.neighbours.intrusion->depth <= pair.offset) return;
    for (const Surface& surface : surfaces)
      if (std::min(surface.part_1, surface.part_2) == i && std::max(surface.part_1, surface.part_2) == j)
        if (!surface.interface || !surface.interface->cyclic)
          pair.offset = std::max(pair.offset, bend_of(*surface.interface));
  });
  std::erase_if(pairs, [](const Unjoined& pair) {
    const Neighbours& found = pair.neighbours;
    return !found.touch && !found.intrusion && !found.are_near();
  });
  return pairs;
}

namespace {

// Parts that touch one part alike, as the bolts of a pattern do, are named together.
void doubt_touches(const Problem& problem, const std::vector<Unjoined>& unjoined) {
  std::map<std::pair<int, long>, std::vector<const Unjoined*>> alike;
  for (const Unjoined& pair : unjoined)
    if (pair.neighbours.touch && !pair.neighbours.intrusion)
      alike[{pair.part_1, std::lround(1e3 * std::log(pair.neighbours.touch->area))}].push_back(&pair);
  for (const auto& [key, pairs] : alike) {
    const auto part = [&](int i) -> const Substructure& { return *problem.substructures[static_cast<size_t>(i)]; };
    const Substructure &a = part(pairs.front()->part_1), &b = part(pairs.front()->part_2);
    const Touch& touch = *pairs.front()->neighbours.touch;
    std::string others;
    for (size_t i = 0; i < pairs.size(); ++i)
      others += (i == 0 ? "" : i + 1 == pairs.size() ? " and " : ", ") + ("'" + part(pairs[i]->part_2).name + "'");
    check::doubt(
        problem, b.origin,
        fmt::format("substructures '{}' and {} touch on {:.4g} mm^2{} without an interface, at {} ({} on {}): they "
                    "pass through each other there; add an interface.contact",
                    a.name, others, 1e6 * touch.area, pairs.size() > 1 ? " each" : "", at(touch.place),
                    face_with(a, touch.facet_1), face_with(b, touch.facet_2)),
        {"touch", touch.area, fmt::format("'{}' and {} ({:.3g} mm^2)", a.name, others, 1e6 * touch.area), true});
  }
}

void doubt_unjoined(const Problem& problem, const std::vector<Unjoined>& unjoined) {
  for (const Unjoined& pair : unjoined) {
    const Substructure &a = *problem.substructures[static_cast<size_t>(pair.part_1)],
                       &b = *problem.substructures[static_cast<size_t>(pair.part_2)];
    const std::string who = fmt::format("substructures '{}' and '{}'", a.name, b.name);
    if (const auto& intrusion = pair.neighbours.intrusion) {
      const Box& box = intrusion->extent;
      const bool is_of_facets = intrusion->depth <= pair.offset;
      check::doubt(
          problem, b.origin,
          fmt::format("{} overlap, up to {:.3g} mm deep at {}, in about {:.3g} mm^3 between {} and {}: {}", who,
                      1e3 * intrusion->depth, at(intrusion->place), 1e9 * intrusion->volume, at(box.low), at(box.high),
                      is_of_facets
                          ? "within the facet error of their round faces; reduce it by 'round' or cells of order two"
                          : "check 'place', 'origin' and 'unit'"),
          {is_of_facets ? "overlap of facets" : "overlap", intrusion->depth,
           fmt::format("'{}' and '{}' ({:.3g} mm)", a.name, b.name, 1e3 * intrusion->depth), !is_of_facets});
    }
  }
  doubt_touches(problem, unjoined);
}

double width_of_face(const Face& face, const std::vector<Facet>& facets) {
  return width_of(face.part->mesh->nodes(Eigen::all, nodes_of(facets)));
}

// What a few points carry, or points in a row, tilts as it will.
void doubt_points(const Problem& problem, const Surface& surface) {
  constexpr int few = 4;
  constexpr double narrow = 0.25;
  const Facing& facing = surface.facing;
  if (!surface.interface || facing.matches() || facing.n_points() == 0) return;
  const Face &face_1 = surface.interface->side_1, &face_2 = surface.interface->side_2;
  const double width = std::min(width_of_face(face_1, facing.facets_1), width_of_face(face_2, facing.facets_2));
  const bool is_row = facing.n_points() > 2 && width_of(facing.places) < narrow * width;
  if (facing.n_points() >= few && !is_row) return;
  const Face& carrier = facing.carrier == 1 ? face_1 : face_2;
  check::doubt(
      problem, surface.interface->origin,
      fmt::format(
          "{} has {} point{} only{}, since the facets of {} are large for its {:.4g} mm^2: refine the mesh there",
          describe(*surface.interface), facing.n_points(), facing.n_points() == 1 ? "" : "s",
          is_row ? ", collinear, so that it acts as a hinge" : "", carrier.label(), 1e6 * facing.areas.sum()),
      {"few points", (is_row ? 1.0 : 0.0) - facing.n_points(), "'" + surface.interface->name + "'", true});
}

void doubt_surfaces(const Problem& problem, const std::vector<Surface>& surfaces) {
  for (const Surface& surface : surfaces) {
    if (!surface.interface) continue;
    if (!surface.facing.is_of_sums()) {
      if (!surface.interface->cyclic) {  // of which others may take points away, and whose faces lie apart
        doubt_shift(problem, surface);
        doubt_points(problem, surface);
      }
      doubt_distance(problem, surface);
    }
    doubt_held_side(problem, surface, surface.interface->side_1.part, surface.facing.facets_1);
    doubt_held_side(problem, surface, surface.interface->side_2.part, surface.facing.facets_2);
    if (!surface.declared_law().is_tie()) continue;
    const SubstructurePtr &part_1 = surface.interface->side_1.part, &part_2 = surface.interface->side_2.part;
    doubt_pressed_bond(problem, surface, part_1, surface.facing.facets_1, part_2);
    doubt_pressed_bond(problem, surface, part_2, surface.facing.facets_2, part_1);
  }
}

}  // namespace

std::vector<Unjoined> doubt_neighbours(const Problem& problem, const std::vector<Surface>& surfaces) {
  doubt_same_place(problem);
  doubt_loose_pieces(problem, surfaces);
  doubt_surfaces(problem, surfaces);
  std::vector<Unjoined> pairs = find_unjoined(problem, surfaces);
  doubt_unjoined(problem, pairs);
  return pairs;
}

}  // namespace dygita
