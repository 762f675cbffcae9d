#include "fem/element.hpp"

#include "fem/cells.hpp"

namespace dygita {

CellMatrix element_stiffness(CellType type, const CellNodes& x, const Elastic& material) {
  return with_cell(type, [&](auto cell) -> CellMatrix { return cell.stiffness(x, material.tensor()); });
}

Eigen::VectorXd element_mass(CellType type, const CellNodes& x, double density) {
  return with_cell(type, [&](auto cell) -> Eigen::VectorXd { return density * node_volumes<decltype(cell)>(x); });
}

Tensors element_stress(CellType type, const CellNodes& x, const Elastic& material, const CellNodes& displacement) {
  return with_cell(type, [&](auto cell) -> Tensors { return cell.stress(x, material.tensor(), displacement); });
}

}  // namespace dygita
