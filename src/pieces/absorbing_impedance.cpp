#include "pieces/absorbing_impedance.hpp"

#include "fem/cell_tensor.hpp"
#include "mesh/face_nodes.hpp"

namespace dygita {

namespace {

// The material in the cell behind each facet of a face.
std::vector<ElasticTensor> tensors_behind(const Substructure& body, const std::vector<Facet>& facets) {
  std::vector<ElasticTensor> behind(facets.size(), body.material.tensor());
  if (body.material.is_isotropic()) return behind;
  std::unordered_map<FacetKey, size_t, FacetKeyHash> number;
  for (size_t i = 0; i < facets.size(); ++i) number[facet_key(facets[i])] = i;
  for (const CellBlock& block : body.mesh->blocks)
    for (int cell = 0; cell < block.n_cells(); ++cell)
      for (int k = 0; k < facets_per_cell(block.type); ++k)
        if (const auto found = number.find(facet_key(facet_of_cell(block, cell, k))); found != number.end())
          behind[found->second] = tensor_in(body.material, block, cell);
  return behind;
}

// At the nodes of linear facets. Where the material is the same in all directions, by the mean normal at a node; where
// it is not each facet has its own.
void add_linear(const Substructure& body, const std::vector<Facet>& facets, AbsorbingImpedance& impedance) {
  const auto add = [&](const std::vector<Facet>& some, const ElasticTensor& tensor) {
    const FaceNodes nodes = face_nodes(*body.mesh, some);
    for (size_t i = 0; i < nodes.nodes.size(); ++i)
      impedance.add(nodes.nodes[i], nodes.areas[static_cast<Eigen::Index>(i)] *
                                        tensor.impedance(nodes.normals.col(i), body.material.density));
  };
  if (body.material.is_isotropic()) return add(facets, body.material.tensor());
  const std::vector<ElasticTensor> behind = tensors_behind(body, facets);
  for (size_t i = 0; i < facets.size(); ++i) add({facets[i]}, behind[i]);
}

// A lumped impedance would scatter waves at the scale of the nodes, where the mass behind it is consistent; and so
// would a consistent one where that is lumped.
void add_facet(const Substructure& body, const Facet& facet, const ElasticTensor& tensor, bool is_lumped,
               AbsorbingImpedance& impedance) {
  const std::span<const int> nodes = facet.nodes();
  const std::vector<FacetSample> samples = facet_samples(body.mesh->nodes, facet);
  double area = 0.0, squares = 0.0;  // the diagonal is scaled as that of the mass is
  for (const FacetSample& sample : samples) {
    area += sample.area.norm();
    squares += sample.area.norm() * sample.values.squaredNorm();
  }
  for (const FacetSample& sample : samples) {
    const Mat3 z = sample.area.norm() * tensor.impedance(sample.area.normalized(), body.material.density);
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
      std::vector<Facet> linear, curved;
      for (const Facet& facet : face.facets()) (is_linear(facet) ? linear : curved).push_back(facet);
      const std::vector<ElasticTensor> behind = tensors_behind(body, curved);
      for (size_t i = 0; i < curved.size(); ++i) add_facet(body, curved[i], behind[i], is_explicit, impedance);
      add_linear(body, linear, impedance);
    }
  }
  return impedance;
}

}  // namespace dygita
