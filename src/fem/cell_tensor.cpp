#include "fem/cell_tensor.hpp"

namespace dygita {

ElasticTensor mean_tensor(const Elastic& material, const Mesh& mesh) {
  if (material.is_isotropic()) return material.tensor();
  Mat6 sum = Mat6::Zero();
  for (const CellBlock& block : mesh.blocks)
    for (int i = 0; i < block.n_cells(); ++i) sum += tensor_in(material, block, i).stiffness();
  return ElasticTensor(Mat6(sum / mesh.n_cells()));
}

}  // namespace dygita
