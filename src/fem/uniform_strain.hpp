// Cells of uniform strain, as explicit codes integrate them: one stress per cell, from the mean gradient, with the
// stiffness hourglass control of a hexahedron and a bulk viscosity (manual, eq. X4-X7).
#pragma once

#include <vector>

#include "fem/lanes.hpp"
#include "material/elastic.hpp"
#include "mesh/mesh.hpp"

namespace dygita {

// Viscous pressure against volumetric strain rates: linear part (both signs) and quadratic part (compression).
struct BulkViscosity {
  double linear = 0.0, quadratic = 0.0;
};

// Energies of a call, J: elastic without the hourglass stiffness, of that stiffness, and what viscosity dissipated.
struct CellEnergy {
  double strain = 0.0, hourglass = 0.0, dissipated = 0.0;
  CellEnergy& operator+=(const CellEnergy& other) {
    strain += other.strain;
    hourglass += other.hourglass;
    dissipated += other.dissipated;
    return *this;
  }
};

struct UniformStrainSettings {
  bool has_stress = true;  // false: the bulk viscosity alone, beside a stiffness that somebody else multiplies
  double hourglass = 0.1;  // kappa of eq. X6, types under hourglass control
  BulkViscosity viscosity;
};

// All cells of one block of a mesh, of an isotropic material where they have stress. The mean gradient (Flanagan and
// Belytschko, Int. J. Numer. Methods Eng. 17, 1981) passes the patch test on distorted cells; linear tetrahedra have no
// other. Forces are what the cells resist with: M a = external - force. Vectors are by node, 3 n_nodes long, dof = 3
// node + axis.
class UniformStrainCells {
 public:
  UniformStrainCells(const Mesh& mesh, const CellBlock& block, const Elastic& material,
                     const UniformStrainSettings& settings);

  // Adds the elastic force (N) of displacements (m); returns their energies.
  CellEnergy add_elastic_force(const double* displacement, double* force) const;
  // The same with the bulk viscosity of the volumetric strain since the last call, dt (s) ago. has_energy: false leaves
  // the elastic energies out.
  CellEnergy add_force(const double* displacement, double dt, bool has_energy, double* force);
  // Forgets the strain of the last call: the next sees no rate up to these displacements.
  void start_from(const double* displacement);

  double bytes() const;

 private:
  struct Loop;
  template <class Action>
  CellEnergy dispatch(Action&& action) const;

  CellType type_;
  int n_batches_ = 0;
  UniformStrainSettings settings_;
  double lambda_ = 0.0, mu_ = 0.0;
  std::vector<int> dofs_;          // (batch, node of the cell, lane): first dof
  std::vector<int> geometry_of_;   // of each batch: equal cells share one
  std::vector<Lanes> geometries_;  // one after the other, laid out as Loop says
  std::vector<Lanes> strain_;      // volumetric, of the last call, one a batch
};

}  // namespace dygita
