#include "solution/surfaces.hpp"

#include <algorithm>
#include <deque>
#include <map>

#include "law/law.hpp"
#include "solution/preload.hpp"

namespace dygita {

PlacedFace placed(const Face& face) { return {face.part->mesh.get(), face.facets(), face.part->place, face.label()}; }

bool takes_part(const Problem& problem, const Step& step, const Surface& surface) {
  if (surface.wall && index_of(supports_of(problem, step), surface.wall) < 0) return false;
  return surface.declared_law().takes_part(step.is_static);
}

namespace {

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

Facing wall_facing(const Face& face) {
  const FaceNodes on_face = face_nodes(*face.part->mesh, face.facets());
  return {face.facets(), on_face.nodes, {}, on_face.normals, on_face.areas};
}

// A law acts point by point with the force on the area of a node: forces that are zero or pull at the corners of a
// facet under uniform pressure would open it there.
void check_facets(const Surface& surface) {
  if (!surface.law) return;
  for (const Facet& facet : surface.facing.facets)
    if (facet_shape(facet.type()).is_shared_by_sub_facets) {
      const Origin& origin = surface.interface ? surface.interface->origin : surface.wall->origin;
      throw InputError(origin, "'" + surface.name() + "' is on facets of " + std::to_string(facet.nodes().size()) +
                                   " nodes, which only interface.bonded without loads can join yet\n    mesh both "
                                   "parts with order = 1, or with cell = \"hex27\" where they are hexahedra");
    }
}

// Facets named by two interfaces would carry their forces twice.
void check_overlaps(const Problem& problem, const std::vector<Surface>& surfaces) {
  std::map<std::pair<int, FacetKey>, const Surface*> owner;
  const auto claim = [&](const Surface& surface, int part, const Facet& facet) {
    const auto [it, is_new] = owner.emplace(std::pair{part, facet_key(facet)}, &surface);
    if (is_new || it->second == &surface) return;
    const Origin& origin = surface.interface ? surface.interface->origin : surface.wall->origin;
    throw InputError(origin, "'" + surface.name() + "' and '" + it->second->name() +
                                 "' share facets of substructure '" + problem.substructures[part]->name +
                                 "': a facet can be in one interface or wall only");
  };
  for (const Surface& surface : surfaces) {
    std::map<int, int> partner;
    for (int i = 0; i < surface.n_points(); ++i)
      if (surface.part_2 >= 0) partner[surface.facing.nodes_1[i]] = surface.facing.nodes_2[i];
    for (const Facet& facet : surface.facing.facets) {
      claim(surface, surface.part_1, facet);
      if (surface.part_2 < 0) continue;
      Facet other = facet;
      for (int& node : other.nodes()) node = partner.at(node);
      claim(surface, surface.part_2, other);
    }
  }
}

}  // namespace

std::vector<Surface> make_surfaces(const Problem& problem) {
  std::vector<Surface> surfaces;
  SharedLaws laws;
  for (const InterfacePtr& interface : problem.interfaces) {
    Surface surface;
    surface.interface = interface.get();
    surface.part_1 = index_of(problem.substructures, interface->side_1.part.get());
    surface.part_2 = index_of(problem.substructures, interface->side_2.part.get());
    try {
      surface.facing = match_faces(placed(interface->side_1), placed(interface->side_2));
    } catch (const InputError& error) {
      throw InputError(interface->origin, "interface '" + interface->name + "': " + error.what());
    }
    if (has_load(problem, interface.get()))
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
      surface.facing = wall_facing(face);
      surface.law = laws.of(wall->kind->law());
      surfaces.push_back(std::move(surface));
    }
  for (const Surface& surface : surfaces) check_facets(surface);
  check_overlaps(problem, surfaces);
  check_preloads(problem, surfaces);
  return surfaces;
}

}  // namespace dygita
