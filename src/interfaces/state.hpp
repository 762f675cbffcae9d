// What one step leaves to the next: displacements, velocities and the memory of the interfaces.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "law/point.hpp"
#include "numerics/types.hpp"

namespace dygita {

// Cumulated since the beginning, J (manual, energy balance).
struct Energies {
  double kinetic = 0.0, strain = 0.0, stored = 0.0;                                // now; stored: in interfaces
  double loads = 0.0, friction = 0.0, plastic = 0.0, damping = 0.0, scheme = 0.0;  // so far
  double start = 0.0;  // kinetic + strain before anything was done: initial velocities

  double held() const { return kinetic + strain + stored; }
  double balance() const { return start + loads - friction - plastic - damping - scheme - kinetic - strain - stored; }
};

// Fields of a surface's points now; vectors in global axes, forces on side 1.
struct SurfaceState {
  std::vector<LawState> points;
  std::vector<double>
      residual;             // N, of each point: what is left between the force of the substructure and that of the law
  std::vector<Work> works;  // J, of each point: what its law has dissipated so far, and stores

  Work work() const;  // J, of all points
};

inline Work SurfaceState::work() const {
  Work sum;
  for (const Work& work : works) sum.add(work);
  return sum;
}

struct State {
  double time = 0.0;                 // s, dynamic time elapsed
  std::vector<Points> displacement;  // one 3 x n_nodes a piece, m, at all copies; of a piece elsewhere: 3 x 0
  std::vector<Points> velocity;      // m/s
  std::vector<Points> force;         // N, external forces of the last increment, on the copies that own a node
  // m, of the branches of material damping (as many as the material has that has most), and in each as displacement;
  // zero where the step was static.
  std::vector<std::vector<Points>> elongation;
  std::vector<std::map<int, Vec3>>
      anchor;  // N, static reactions that absorbing supports keep: of each substructure, by node
  std::vector<SurfaceState> surfaces;
  std::vector<double> shortening;             // m, of each surface, as its last step left it
  std::vector<char> released;                 // surfaces that have let go for good
  std::map<std::string, double> reached;      // value of each load at the end of the last step, by kind and target
  std::map<const void*, Vec3> base_velocity;  // m/s, of supports that were accelerated
  Energies energies;
  bool has_moved = false;  // initial velocities have been applied

  // Of nodes, all of them.
  std::vector<std::vector<Points>*> fields() {
    std::vector<std::vector<Points>*> all{&displacement, &velocity, &force};
    for (std::vector<Points>& branch : elongation) all.push_back(&branch);
    return all;
  }
};

}  // namespace dygita
