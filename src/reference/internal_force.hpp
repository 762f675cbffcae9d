// What the substructures resist with, cell by cell or by their stiffness: the force of an explicit step (manual, eq.
// X4-X7). All vectors hold every substructure's nodes one after the other: dof = first(part) + 3 node + axis.
#pragma once

#include "fem/symmetric_blocks.hpp"
#include "fem/uniform_strain.hpp"
#include "pieces/body.hpp"

namespace dygita {

class InternalForce {
 public:
  InternalForce(const std::vector<Body>& bodies, const ExplicitSettings& settings);

  int first(int part) const { return first_[part]; }
  int n_dofs() const { return first_.back(); }
  int n_parts() const { return static_cast<int>(parts_.size()); }

  // Force (N) of displacements (m), without any damping: force = K displacement.
  CellEnergy elastic(const Vec& displacement, Vec& force);
  // The same with bulk viscosity over the dt (s) since the last call and lagged stiffness damping by the velocity
  // (m/s): force = K (displacement + beta velocity) + viscosity. Without has_energy the elastic energies are left out.
  CellEnergy damped(const Vec& displacement, const Vec& velocity, double dt, bool has_energy, Vec& force);
  // The next viscosity sees no rate up to these displacements.
  void start_from(const Vec& displacement);

  bool has_stiffness_damping() const { return has_stiffness_damping_; }
  bool has_viscosity() const { return has_viscosity_; }
  double largest_stiffness_damping() const;  // s
  double bytes() const;

 private:
  struct Part {
    std::vector<UniformStrainCells> cells;       // with their viscosity where there is no stiffness damping
    std::vector<UniformStrainCells> viscous;     // the viscosity alone
    std::unique_ptr<SymmetricBlocks> stiffness;  // of what the cells do not resist with; may be null
    double beta = 0.0;                           // s
  };
  CellEnergy multiply(const Part& part, const double* displacement, double* force, bool has_energy);

  std::vector<Part> parts_;
  std::vector<int> first_;
  bool has_stiffness_damping_ = false, has_viscosity_ = false;
  Vec damped_, product_;
};

}  // namespace dygita
