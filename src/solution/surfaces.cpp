#include "solution/surfaces.hpp"

#include <algorithm>
#include <map>

#include "solution/preload.hpp"

namespace dygita {

PlacedFace placed(const Face& face) { return {face.part->mesh.get(), face.facets(), face.part->place, face.label()}; }

namespace {

// A bonded interface that is shortened or released in some step is a law of its own, never part of a group.
bool acts_on_interface(const Problem& problem, const Interface* interface) {
  for (const StepPtr& step : problem.steps)
    for (const LoadPtr& load : step->loads)
      for (const Target& target : load->on)
        if (const auto* on = std::get_if<InterfacePtr>(&target); on && on->get() == interface) return true;
  return false;
}

// Contacts of equal friction and gap share one law: where such faces meet at a node they act as one (exchange.cpp).
class ContactLaws {
 public:
  std::shared_ptr<const Law> of(double friction, double gap) {
    auto& law = known_[{friction, gap}];
    if (!law) law = std::make_shared<ContactLaw>(friction);
    return law;
  }

 private:
  std::map<std::pair<double, double>, std::shared_ptr<const Law>> known_;
};

std::shared_ptr<const Law> make_law(const Problem& problem, const Interface& interface, ContactLaws& contacts) {
  switch (interface.kind) {
    case InterfaceKind::contact:
      if (acts_on_interface(problem, &interface)) return std::make_shared<ContactLaw>(interface.friction);
      return contacts.of(interface.friction, interface.gap);
    case InterfaceKind::plastic:
      return std::make_shared<PlasticLaw>(interface.yield, interface.hardening, interface.compression);
    case InterfaceKind::bonded:
      break;
  }
  return acts_on_interface(problem, &interface) ? std::make_shared<BondedLaw>() : nullptr;
}

Facing wall_facing(const Face& face) {
  const FaceNodes on_face = face_nodes(*face.part->mesh, face.facets());
  return {face.facets(), on_face.nodes, {}, on_face.normals, on_face.areas};
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
  ContactLaws contacts;
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
    surface.law = make_law(problem, *interface, contacts);
    surface.initial_gap = interface->kind == InterfaceKind::contact ? interface->gap : 0.0;
    surfaces.push_back(std::move(surface));
  }
  std::vector<const Support*> walls;
  for (const StepPtr& step : problem.steps)
    for (const SupportPtr& support : supports_of(problem, *step))
      if (support->kind == SupportKind::wall && std::find(walls.begin(), walls.end(), support.get()) == walls.end())
        walls.push_back(support.get());
  for (const Support* wall : walls)
    for (const FaceOrRegion& on : wall->on) {
      const Face& face = std::get<Face>(on);
      Surface surface;
      surface.wall = wall;
      surface.part_1 = index_of(problem.substructures, face.part.get());
      surface.facing = wall_facing(face);
      surface.law = contacts.of(wall->friction, wall->gap);
      surface.initial_gap = wall->gap;
      surfaces.push_back(std::move(surface));
    }
  check_overlaps(problem, surfaces);
  check_preloads(problem, surfaces);
  return surfaces;
}

}  // namespace dygita
