#include "watch/weighted_nodes.hpp"

#include "fem/assembly.hpp"
#include "meeting/facing.hpp"

namespace dygita {

WeightedNodes weighted_nodes(const Problem& problem, const FaceOrRegion& place) {
  WeightedNodes on;
  if (const auto* face = std::get_if<Face>(&place)) {
    on.part = index_of(problem.substructures, face->part.get());
    const FaceNodes nodes = face_nodes(*face->part->mesh, face->facets());
    on.nodes = nodes.nodes;
    on.weights.assign(nodes.weights.data(), nodes.weights.data() + nodes.weights.size());
  } else {
    const Region& region = std::get<Region>(place);
    on.part = index_of(problem.substructures, region.part.get());
    on.nodes = region.nodes;
    const Mesh& mesh = *region.part->mesh;
    const Vec volumes = mesh.has_cells() ? nodal_volumes(mesh) : Vec(Vec::Ones(mesh.n_nodes()));
    for (const int node : region.nodes) on.weights.push_back(volumes[node]);
  }
  return on;
}

Vec3 mean_over(const WeightedNodes& on, const Points& field) {
  Vec3 sum = Vec3::Zero();
  double total = 0.0;
  for (size_t i = 0; i < on.nodes.size(); ++i) {
    sum += on.weights[i] * field.col(static_cast<Eigen::Index>(i));
    total += on.weights[i];
  }
  return sum / total;
}

}  // namespace dygita
