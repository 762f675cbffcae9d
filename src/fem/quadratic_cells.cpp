// The kernels of the cells of order two.
#include "fem/cells.hpp"

namespace dygita {

template struct ShapedCell<CellType::tet10>;
template struct Cell<CellType::tet10>;
template Eigen::Matrix<double, Cell<CellType::tet10>::n, 1> shape_integrals<Cell<CellType::tet10>>(
    const Nodes<Cell<CellType::tet10>::n>&);
template Eigen::Matrix<double, Cell<CellType::tet10>::n, 1> node_volumes<Cell<CellType::tet10>>(
    const Nodes<Cell<CellType::tet10>::n>&);
template MassMatrix<Cell<CellType::tet10>::n> consistent_mass<Cell<CellType::tet10>>(
    const Nodes<Cell<CellType::tet10>::n>&, double);
template struct ShapedCell<CellType::hex20>;
template struct Cell<CellType::hex20>;
template Eigen::Matrix<double, Cell<CellType::hex20>::n, 1> shape_integrals<Cell<CellType::hex20>>(
    const Nodes<Cell<CellType::hex20>::n>&);
template Eigen::Matrix<double, Cell<CellType::hex20>::n, 1> node_volumes<Cell<CellType::hex20>>(
    const Nodes<Cell<CellType::hex20>::n>&);
template MassMatrix<Cell<CellType::hex20>::n> consistent_mass<Cell<CellType::hex20>>(
    const Nodes<Cell<CellType::hex20>::n>&, double);
template struct ShapedCell<CellType::hex27>;
template struct Cell<CellType::hex27>;
template Eigen::Matrix<double, Cell<CellType::hex27>::n, 1> shape_integrals<Cell<CellType::hex27>>(
    const Nodes<Cell<CellType::hex27>::n>&);
template Eigen::Matrix<double, Cell<CellType::hex27>::n, 1> node_volumes<Cell<CellType::hex27>>(
    const Nodes<Cell<CellType::hex27>::n>&);
template MassMatrix<Cell<CellType::hex27>::n> consistent_mass<Cell<CellType::hex27>>(
    const Nodes<Cell<CellType::hex27>::n>&, double);
template struct ShapedCell<CellType::prism15>;
template struct Cell<CellType::prism15>;
template Eigen::Matrix<double, Cell<CellType::prism15>::n, 1> shape_integrals<Cell<CellType::prism15>>(
    const Nodes<Cell<CellType::prism15>::n>&);
template Eigen::Matrix<double, Cell<CellType::prism15>::n, 1> node_volumes<Cell<CellType::prism15>>(
    const Nodes<Cell<CellType::prism15>::n>&);
template MassMatrix<Cell<CellType::prism15>::n> consistent_mass<Cell<CellType::prism15>>(
    const Nodes<Cell<CellType::prism15>::n>&, double);
template struct ShapedCell<CellType::prism18>;
template struct Cell<CellType::prism18>;
template Eigen::Matrix<double, Cell<CellType::prism18>::n, 1> shape_integrals<Cell<CellType::prism18>>(
    const Nodes<Cell<CellType::prism18>::n>&);
template Eigen::Matrix<double, Cell<CellType::prism18>::n, 1> node_volumes<Cell<CellType::prism18>>(
    const Nodes<Cell<CellType::prism18>::n>&);
template MassMatrix<Cell<CellType::prism18>::n> consistent_mass<Cell<CellType::prism18>>(
    const Nodes<Cell<CellType::prism18>::n>&, double);

}  // namespace dygita
