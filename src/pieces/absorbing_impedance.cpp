#include "pieces/absorbing_impedance.hpp"

#include "mesh/face_nodes.hpp"

namespace dygita {

namespace {

// N s/m of an area (m^2) with a normal.
Mat3 impedance_of(const Elastic& material, double area, const Vec3& normal) {
  const Mat3 along = normal * normal.transpose();
  const double z_n = material.density * material.p_wave_speed(), z_t = material.density * material.s_wave_speed();
  return area * (z_n * along + z_t * (Mat3::Identity() - along));
}

// A lumped impedance would scatter waves at the scale of the nodes, where the mass behind it is consistent; and so
// would a consistent one where that is lumped.
void add_facet(const Substructure& body, const Facet& facet, bool is_lumped, AbsorbingImpedance& impedance) {
  const std::span<const int> nodes = facet.nodes();
  const std::vector<FacetSample> samples = facet_samples(body.mesh->nodes, facet);
  double area = 0.0, squares = 0.0;  // the diagonal is scaled as that of the mass is
  for (const FacetSample& sample : samples) {
    area += sample.area.norm();
    squares += sample.area.norm() * sample.values.squaredNorm();
  }
  for (const FacetSample& sample : samples) {
    const Mat3 z = impedance_of(body.material, sample.area.norm(), sample.area.normalized());
    for (size_t a = 0; a < nodes.size(); ++a) {
      const double own = sample.values[static_cast<Eigen::Index>(a)];
      if (is_lumped) {
        impedance.add(nodes[a], own * own * area / squares * z);
        continue;
      }
      for (size_t b = 0; b < nodes.size(); ++b)
        impedance.of_pairs.push_back({nodes[a], nodes[b], own * sample.values[static_cast<Eigen::Index>(b)] * z});
    }
  }
}

bool is_linear(const Facet& facet) { return facet.nodes().size() == facet.corners().size(); }

}  // namespace

AbsorbingImpedance absorbing_impedance(const Problem& problem, const Step& step, const Substructure& body,
                                       bool is_explicit) {
  AbsorbingImpedance impedance;
  if (step.is_static) return impedance;
  for (const SupportPtr& support : supports_of(problem, step)) {
    if (!support->kind->absorbs()) continue;
    for (const FaceOrRegion& on : support->on) {
      const Face& face = std::get<Face>(on);
      if (face.part.get() != &body) continue;
      std::vector<Facet> linear;
      for (const Facet& facet : face.facets())
        if (is_linear(facet))
          linear.push_back(facet);
        else
          add_facet(body, facet, is_explicit, impedance);
      const FaceNodes nodes = face_nodes(*body.mesh, linear);
      for (size_t i = 0; i < nodes.nodes.size(); ++i)
        impedance.add(nodes.nodes[i], impedance_of(body.material, nodes.areas[i], nodes.normals.col(i)));
    }
  }
  return impedance;
}

}  // namespace dygita
