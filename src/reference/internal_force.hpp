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
  // (m/s), and by its branches: force = K (displacement + beta velocity + sum of strength e) + viscosity. Without
  // has_energy the elastic energies are left out.
  CellEnergy damped(const Vec& displacement, const Vec& velocity, double dt, bool has_energy, Vec& force);
  // The next viscosity sees no rate up to these displacements.
  void start_from(const Vec& displacement);

  // The branches of all parts (m, e in the order of the dofs): as they are given, a piece's fields one after the other
  // in each; over a substep (s) of constant velocities; of a part; their energy, J, by products.
  void set_elongation(int part, int branch, const Points& e);
  void advance_branches(const Vec& velocity, double dt);
  std::vector<Points> elongations(int part) const;
  double energy_in_branches();
  bool has_branches() const { return !elongation_.empty(); }
  double largest_of_sudden_motion() const;

  bool has_damping_of_strain() const { return has_damping_of_strain_; }
  bool has_viscosity() const { return has_viscosity_; }
  double largest_stiffness_damping() const;  // s
  double bytes() const;

 private:
  struct Part {
    std::vector<UniformStrainCells> cells;       // with their viscosity where there is no stiffness damping
    std::vector<UniformStrainCells> viscous;     // the viscosity alone
    std::unique_ptr<SymmetricBlocks> stiffness;  // of what the cells do not resist with; may be null
    Damping damping;
  };
  CellEnergy elastic_of(const Part& part, const double* displacement, double* force);
  CellEnergy multiply(const Part& part, const double* displacement, double* force, bool has_energy);

  std::vector<Part> parts_;
  std::vector<int> first_;
  bool has_damping_of_strain_ = false, has_viscosity_ = false;
  std::vector<Vec> elongation_;  // of as many branches as the part has that has most
  Vec damped_, product_;
};

}  // namespace dygita
