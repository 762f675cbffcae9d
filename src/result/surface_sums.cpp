#include "result/surface_sums.hpp"

#include <algorithm>
#include <set>

#include "mesh/facing.hpp"

namespace dygita {

std::vector<int> surfaces_of(const Instant& instant, const std::vector<Target>& targets) {
  std::vector<int> found;
  const std::vector<Surface>& surfaces = *instant.model.surfaces;
  for (const Target& target : targets)
    for (size_t s = 0; s < surfaces.size(); ++s) {
      const auto* interface = std::get_if<InterfacePtr>(&target);
      const auto* support = std::get_if<SupportPtr>(&target);
      if ((interface && surfaces[s].interface == interface->get()) || (support && surfaces[s].wall == support->get()))
        found.push_back(static_cast<int>(s));
    }
  return found;
}

namespace {

void add(Resultant& r, Vec3& tangential, const Vec3& force, const Vec3& normal) {
  r.force += force;
  r.normal += force.dot(normal);
  tangential += force - force.dot(normal) * normal;
}

// Directions that a support holds at a node, of those that are held.
Vec3 part_of_reaction(const Held& held, const Support* support, const Vec3& reaction) {
  Vec3 force = Vec3::Zero();
  for (int j = 0; j < held.n; ++j)
    if (held.support[j] == support) force += held.directions.col(j).dot(reaction) * held.directions.col(j);
  return force;
}

void add_support(Resultant& r, Vec3& tangential, const Instant& instant, const Problem& problem,
                 const Support& support) {
  std::set<std::pair<int, int>> counted;  // nodes that faces of the support share
  for (const FaceOrRegion& on : support.on) {
    const SubstructurePtr& body = std::visit([](const auto& o) -> const SubstructurePtr& { return o.part; }, on);
    const int part = index_of(problem.substructures, body.get());
    std::vector<int> nodes;
    Points normals;
    if (const auto* face = std::get_if<Face>(&on)) {
      const FaceNodes f = face_nodes(*body->mesh, face->facets());
      nodes = f.nodes;
      normals = f.normals;
    } else {
      nodes = std::get<Region>(on).nodes;
      normals = Points::Zero(3, nodes.size());
    }
    const bool is_absorbing = support.kind->absorbs() && !instant.is_static();
    Points force = is_absorbing ? instant.absorbing_force(part) : instant.reactions(part);
    if (is_absorbing)
      for (const auto& [node, held] : instant.state.anchor[part]) force.col(node) += held;
    for (size_t i = 0; i < nodes.size(); ++i) {
      if (!counted.emplace(part, nodes[i]).second) continue;
      const Held* held = instant.model.conditions.at(part, nodes[i]);
      if (is_absorbing)
        add(r, tangential, force.col(nodes[i]), normals.col(i));
      else if (held)
        add(r, tangential, part_of_reaction(*held, &support, force.col(nodes[i])), normals.col(i));
    }
  }
}

}  // namespace

Resultant resultant(const Instant& instant, const Problem& problem, const std::vector<Target>& targets) {
  Resultant r;
  Vec3 tangential = Vec3::Zero();
  for (const int s : surfaces_of(instant, targets)) {
    const Surface& surface = (*instant.model.surfaces)[s];
    for (int i = 0; i < surface.n_points(); ++i)
      add(r, tangential, instant.surface(s).points[i].force, surface.facing.normals.col(i));
  }
  for (const Target& target : targets)
    if (const auto* support = std::get_if<SupportPtr>(&target); support && !(*support)->kind->law())
      add_support(r, tangential, instant, problem, **support);
  r.shear = tangential.norm();
  return r;
}

double mean_pressure(const Instant& instant, const std::vector<Target>& targets) {
  double normal = 0.0, area = 0.0;
  for (const int s : surfaces_of(instant, targets)) {
    const Surface& surface = (*instant.model.surfaces)[s];
    for (int i = 0; i < surface.n_points(); ++i) {
      normal += instant.surface(s).points[i].force.dot(surface.facing.normals.col(i));
      area += surface.facing.areas[i];
    }
  }
  return area > 0.0 ? -normal / area : 0.0;
}

}  // namespace dygita
