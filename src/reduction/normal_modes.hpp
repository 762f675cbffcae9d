// Normal modes of a linear assembly: of the tightened structure, about the end of a step (manual, eq. D13-D16).
#pragma once

#include <memory>

#include "reduction/linear_assembly.hpp"

namespace dygita {

struct ModesRequest {
  std::string name;           // of the output
  Origin origin;              // of the output
  int n = 0;                  // how many; 0: all up to
  double up_to = 0.0;         // Hz
  bool ties_sliding = false;  // contact points at the limit of friction are tied along their tangents too
};

// Rows of what has three directions twice: along x, y, z, and about the axes through the centre of mass.
struct NormalModes {
  int n_free = 0;               // motions that nothing resists, all there are: the first modes, at 0 Hz
  Vec frequencies;              // Hz, increasing
  Vec damping_ratios;           // of critical damping; nan of a motion at 0 Hz that is damped
  Vec generalised_masses;       // kg, of the shape whose largest displacement is one
  Mat participation;            // n x 6; about the axes in m
  Mat effective_masses;         // n x 6, kg; kg m^2
  Mat shapes;                   // 3 x (all nodes) rows, the largest displacement of each one
  std::vector<int> first_node;  // of each substructure in them
  double mass = 0.0;            // kg
  Vec3 centre = Vec3::Zero(), moments = Vec3::Zero();  // m, of mass; kg m^2, about the axes through it
  int n_tied = 0, n_normal = 0, n_open = 0;            // contact points: tied, tied along their normal, open
  std::string about;                                   // the step; empty: the unloaded assembly
  int missed = 0;                                      // increments up to there, of all steps, that have not converged

  int n() const { return static_cast<int>(frequencies.size()); }
  // Of the sum of effective masses, the share of the whole.
  double share(int direction) const {
    return effective_masses.col(direction).sum() / (direction < 3 ? mass : moments[direction - 3]);
  }
};
using NormalModesPtr = std::shared_ptr<const NormalModes>;

// Throws InputError where more modes are asked for than there are unknowns, NumericalError.
NormalModes normal_modes(const LinearAssembly& assembly, const Problem& problem, const ModesRequest& request);

}  // namespace dygita
