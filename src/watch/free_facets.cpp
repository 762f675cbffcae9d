#include "watch/free_facets.hpp"

#include <algorithm>

#include "base/overloaded.hpp"
#include "model/load.hpp"

namespace dygita {

namespace {

// What acts on a part: facets one by one, and nodes that make up facets.
struct Acted {
  const Substructure* part;
  FacetKeys facets;
  std::unordered_set<int> nodes;

  void add(const std::vector<Facet>& more) {
    for (const Facet& facet : more) facets.insert(facet_key(facet));
  }
  void add(const FaceOrRegion& place) {
    if (const auto* face = std::get_if<Face>(&place); face && face->part.get() == part) add(face->facets());
    if (const auto* region = std::get_if<Region>(&place); region && region->part.get() == part)
      nodes.insert(region->nodes.begin(), region->nodes.end());
  }
  void add(const Effect& effect) {
    std::visit(overloaded{[&](const NodalForces& forces) { add(forces.on); },
                          [&](const PrescribedMotion& motion) { add(motion.on); },
                          // At supports and interfaces, or on all masses.
                          [](const BodyForce&) {}, [](const BaseMotion&) {}, [](const Shortening&) {},
                          [](const PreloadForce&) {}, [](const Release&) {}},
               effect);
  }
  bool has(const Facet& facet) const {
    return facets.contains(facet_key(facet)) ||
           std::all_of(facet.corners().begin(), facet.corners().end(), [&](int node) { return nodes.contains(node); });
  }
};

}  // namespace

FacetKeys free_facets(const StepModel& model, int part, const std::vector<Facet>& boundary) {
  const Problem& problem = *model.problem;
  Acted acted{problem.substructures[static_cast<size_t>(part)].get(), {}, {}};
  for (const Surface& surface : *model.surfaces) {
    if (surface.part_1 == part) acted.add(surface.facing.facets_1);
    if (surface.part_2 == part) acted.add(surface.facing.facets_2);
  }
  for (const SupportPtr& support : supports_of(problem, *model.step))
    for (const FaceOrRegion& place : support->on) acted.add(place);
  for (const LoadPtr& load : model.step->loads)
    for (const Effect& effect : load->effects()) acted.add(effect);
  FacetKeys free;
  for (const Facet& facet : boundary)
    if (!acted.has(facet)) free.insert(facet_key(facet));
  return free;
}

}  // namespace dygita
