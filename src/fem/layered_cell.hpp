// Cells through whose thickness the plies of a layup lie (manual, eq. Y12-Y13).
#pragma once

#include <array>

#include "fem/element.hpp"
#include "material/layup.hpp"
#include "mesh/layers.hpp"

namespace dygita {

// A hexahedron with all plies in it. Strains in the plane come from its displacements, at each point; stresses across
// it are linear through the thickness at each of its places (a, b), as no ply by itself could bear others.
class LayeredCell {
 public:
  // axes: columns, of the layup, whose third is along one of the cell's directions.
  LayeredCell(CellType type, const CellNodes& x, const Mat3& axes, const Layup& layup);

  CellMatrix stiffness() const;  // N/m, exactly symmetric, dof = 3 node + axis

  // The motion of the nodes (m), for stresses.
  void move(const CellNodes& displacement);
  // Pa, in the axes of the layup, at the places of the nodes in the plane: at -1 below to 1 above in a ply.
  Tensors stress(int ply, double at) const;

  // Where it is through the thickness: -1 below to 1 above.
  double level(int node) const;

 private:
  static constexpr int n_levels = 3;  // below, in the middle, above: what strains are known at through the thickness
  // At a place in the plane.
  struct Column {
    std::array<Mat, n_levels> strains;  // of each dof, in the axes of the layup
    std::array<double, n_levels> volumes;
    Mat6 soft = Mat6::Zero();  // of the stresses across: constant, linear
    Mat across;                // the strains across that they work on, of each dof
  };
  Column column(double a, double b, int points_per_ply) const;
  Mat stiffness_of(const Column& column, int points_per_ply) const;
  Vec3 place(double a, double b, double t) const;
  // Strains of each dof, modes last, in the axes of the layup; volume: of the reference cell's unit.
  Mat strain(const Vec3& xi, double& volume) const;
  int n_dofs() const { return 3 * static_cast<int>(x_.cols()) + n_modes_; }
  int points_per_ply() const { return n_modes_ > 0 ? 2 : 3; }
  Mat whole_stiffness() const;

  CellType type_;
  CellNodes x_;  // in the axes of the layup
  Mat3 axes_;
  const Layup& layup_;
  int n_modes_ = 0;
  Through through_;
  Mat3 centre_;  // Jacobian at the middle
  // At the four places of recovery: strains at each level, and stresses across (Pa), constant and linear.
  std::array<std::array<Vec6, n_levels>, 4> strains_;
  std::array<std::array<double, n_levels>, 4> volumes_;
  std::array<Vec6, 4> amplitudes_;
};

}  // namespace dygita
