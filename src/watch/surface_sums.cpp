#include "watch/surface_sums.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <set>

#include "meeting/facing.hpp"

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

// The reaction of a node as forces along the directions in which it is held, of which some are the support's.
void add_reaction(Resultant& r, Vec3& tangential, const Held& held, const Support& support, const Vec3& reaction,
                  const Vec3& normal) {
  const Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> given = held.given.leftCols(held.n);
  const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> forces =
      (given.transpose() * given).ldlt().solve(given.transpose() * reaction);
  const bool holds_normals = support.kind->claims() == Directions::normal;
  Vec3 sum = Vec3::Zero();
  for (int j = 0; j < held.n; ++j) {
    if (held.support[j] != &support) continue;
    // Each plane has a normal of its own where several meet.
    if (holds_normals) add(r, tangential, forces[j] * given.col(j), given.col(j));
    sum += forces[j] * given.col(j);
  }
  if (!holds_normals) add(r, tangential, sum, normal);
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
    for (int& node : nodes)  // a rigid face is held at its point
      if (const Interior::Follower* own = body->mesh->inside->follower(node)) node = own->point;
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
        add_reaction(r, tangential, *held, support, force.col(nodes[i]), normals.col(i));
    }
  }
}

}  // namespace

Resultant resultant(const Instant& instant, const Problem& problem, const std::vector<Target>& targets) {
  Resultant r;
  Vec3 tangential = Vec3::Zero();
  for (const int s : surfaces_of(instant, targets)) {
    const Surface& surface = (*instant.model.surfaces)[s];
    if (surface.is_of_rotation) continue;
    const bool is_spring =
        surface.wall && surface.wall->kind->spring(0);  // along several axes, of which none is normal
    for (int i = 0; i < surface.n_points(); ++i)
      add(r, tangential, instant.surface(s).points[i].force,
          is_spring ? Vec3(Vec3::Zero()) : Vec3(surface.facing.normals.col(i)));
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
