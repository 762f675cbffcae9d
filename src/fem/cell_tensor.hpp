// A body's material as it lies in its cells.
#pragma once

#include "base/error.hpp"
#include "material/elastic.hpp"
#include "mesh/mesh.hpp"

namespace dygita {

// In the axes of the body. A material with directions in a block without axes is a broken contract.
inline ElasticTensor tensor_in(const Elastic& material, const CellBlock& block, int cell) {
  if (material.is_isotropic()) return material.tensor();
  CHECK(static_cast<int>(block.axes.size()) == block.n_cells(), "a material with directions has axes in each cell");
  return material.tensor().turned(block.axes[static_cast<size_t>(cell)]);
}

// The mean of its stiffness over the cells, for what may differ by a little: search directions.
ElasticTensor mean_tensor(const Elastic& material, const Mesh& mesh);

}  // namespace dygita
