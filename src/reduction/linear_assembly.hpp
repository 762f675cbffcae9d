// An assembly about a state of its interfaces, as one linear system: what sticks is tied, what is open is free (manual,
// eq. D1).
#pragma once

#include <array>
#include <string>

#include "step/observer.hpp"

namespace dygita {

// One linear condition on nodes: sum of coefficient . displacement = 0. At most two nodes.
struct NodeCondition {
  std::array<int, 2> node{-1, -1};  // counted through all substructures
  std::array<Vec3, 2> coefficient{Vec3::Zero(), Vec3::Zero()};
};

// A force against the relative displacement and velocity of two nodes (side 2 of a wall: none).
struct Spring {
  std::array<int, 2> node{-1, -1};
  Mat3 frame = Mat3::Identity();
  Vec3 damping = Vec3::Zero(), stiffness = Vec3::Zero();  // N s/m, N/m, along its axes
};

// Where faces do not match: a sum of coefficient . displacement over nodes of both sides, held at zero (by a spring a
// million times as stiff as the nodes), or with a spring and a damper.
struct SpreadSum {
  std::vector<std::pair<int, Vec3>> nodes;  // counted through all substructures
  bool is_held = false;
  double damping = 0.0, stiffness = 0.0;  // N s/m, N/m
};

struct LinearAssembly {
  SparseMatrix stiffness, mass;  // n x n; N/m, kg
  SparseMatrix damping;          // n x n, N s/m; empty where no material and no interface has any
  // Of materials damped over a band, each with the stiffness of its parts (n x n, N/m): their damping depends on the
  // frequency.
  std::vector<std::pair<Damping, SparseMatrix>> relaxing;
  // Where sums are held, else empty: the stiffness without the springs that hold them, and of each spring the row whose
  // square is its energy.
  SparseMatrix cells, springs;
  SparseMatrix map;                   // 3 x (all nodes) rows: displacements of the nodes from the unknowns
  SparseMatrix followers;             // the same of nodes that move with a rigid face, which the map leaves out
  std::vector<int> first_node;        // of each substructure, and the number of all nodes
  std::vector<int> place_of_unknown;  // unknowns of one place are contiguous
  std::vector<NodeCondition> conditions;
  std::vector<Spring> springs_of_laws;
  std::vector<SpreadSum> sums;
  int n_tied = 0, n_normal = 0, n_open = 0;  // contact points
  double mass_of_parts = 0.0;                // kg
  std::vector<SparseMatrix> nodal_masses;    // kg, of each substructure, 3 n_nodes x 3 n_nodes

  int n() const { return static_cast<int>(stiffness.rows()); }
  int n_damped() const;  // points of interfaces between nodes with a damper
  // x^T K x. Springs are that stiff that a motion which they do not feel must not be multiplied with them: their
  // rounding would be stiffness.
  Mat energies(const Mat& x) const;
};

// The assembly at an instant: bonded and plastic interfaces are tied, unless released; contact points that stick are
// tied, those at the limit of friction too (ties_sliding) or along their normal, as those without friction, open ones
// are free; laws with a stiffness are springs; supports of the step hold, prescribed motions do not. Lumped mass, small
// displacements: no stiffness of the prestress.
LinearAssembly linearise(const Instant& instant, bool ties_sliding);

// A rigid motion of a substructure ("rotation about z of substructure 'nut'") that neither the assembly's conditions
// nor the given nodes, thought to be held, resist; empty where there is none.
std::string free_motion(const LinearAssembly& assembly, const Problem& problem, const std::vector<int>& held_nodes);

// The step about whose end an assembly is linear: the one named, else the last static one; null: there is none.
const Step* step_about(const Problem& problem, const StepPtr& named);

}  // namespace dygita
