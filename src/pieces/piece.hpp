// A piece of the assembly in one step, as the solvers, the results and the next step see it: an operator that never
// changes, a state that is a plain struct, and a way to advance it. What it is made of (cells, matrices from a file)
// and how it is integrated is its own business: implicit_piece.hpp has the way there is.
#pragma once

#include <span>
#include <vector>

#include "numerics/types.hpp"

namespace dygita {

class ExplicitNodes;
class ExplicitPiece;

// What a node of a piece adds to a velocity at a row: along . V.
struct NodeAlong {
  int node;
  Vec3 along;
};

// One unknown q of the exchange on a piece: a velocity at its interface, that of a node in a direction (a unit vector)
// or a sum over the nodes of a face that meets another mesh.
struct InterfaceRow {
  std::vector<NodeAlong> nodes;
  double reference_stiffness;  // added before factorising an unconstrained piece, taken off its Schur complement (N/m)
  double static_stiffness;     // of the substructure behind the node, E A / L or G A / L (N/m)
  double n_sharing;            // laws with a q each at these nodes and directions (manual, eq. K8)
  int side = -1;               // one number for all rows of one side of an interface between two meshes; -1: a node's

  bool is_of_one_node() const { return nodes.size() == 1; }
};

// Energies of one increment (J): works of the increment, and what is stored at its end. Friction and plastic: of
// points, which are booked with a piece.
struct IncrementEnergy {
  double loads = 0.0, friction = 0.0, plastic = 0.0, damping = 0.0, scheme = 0.0;
  double kinetic = 0.0, strain = 0.0;
  double stored = 0.0;  // in interfaces, more than before
};

// A branch of the material's damping: its elongation on free unknowns and along held directions (m), and K times it on
// the free unknowns (N).
struct BranchState {
  Vec e;
  std::vector<double> held;
  Vec force;
};

// What a piece carries from one increment to the next; vectors over its free unknowns, in its own order. A copy is all
// that it takes to go back (windows of several time steps).
struct PieceState {
  Vec u, v;                            // m, m/s
  Vec p, w;                            // N, elastic forces: K (U + ...) that the next increment starts from, c1 K V
  Vec z;                               // N, dt K G V, where there are unknowns without mass
  Vec momentum;                        // M v, kg m/s
  Vec force, imbalance;                // N, external; what the start has too much, until the first increment books it
  Vec q;                               // of the last increment: forces are counted from it
  Vec held_pull;                       // N, of A, what the motions' velocities bring to the free unknowns
  std::vector<double> held_u, held_v;  // of held directions, m, m/s
  std::vector<double> held_reaction;   // N, of whatever holds them
  std::vector<BranchState> branches;   // in a dynamic step, of all that the material has
  int n_since_product = 0;             // increments since P and W were computed from K itself
};

// What a piece costs and how it is solved, for figures.
struct PieceFigures {
  double bytes = 0.0;                // held by factor, interface operators and vectors
  long n_solved = 0, n_spared = 0;   // substitutions (forward and backward are one each) done, and spared where nothing
                                     // had changed
  bool is_mostly_interface = false;  // full solves at each iteration cost less than products with H would
  bool is_in_single_precision = false;
};

class Piece {
 public:
  virtual ~Piece() = default;

  // The operator.
  virtual const std::vector<InterfaceRow>& rows() const = 0;
  int n_rows() const { return static_cast<int>(rows().size()); }
  virtual const Vec& node_masses() const = 0;                  // kg
  virtual double mass() const { return node_masses().sum(); }  // kg
  virtual const Vec& unknown_masses() const = 0;               // kg, of the entries of the state's velocity
  virtual Points unknown_directions() const = 0;               // 3 x n, unit, of the same entries
  // Has the node given its mass away in this step (manual, eq. S7)?
  virtual bool is_massless(int node) const = 0;
  // Is it solved by this process, or by another rank?
  virtual bool is_here() const { return true; }
  // Does a node answer to a force on it at once, and to no other (explicit_piece.hpp)? The piece as one of these, and
  // those of its nodes that laws see; null: it is none, or on another rank.
  virtual bool is_explicit() const { return false; }
  virtual ExplicitPiece* as_explicit() { return nullptr; }
  virtual ExplicitNodes* explicit_nodes() { return nullptr; }
  virtual bool has_motions() const = 0;                                // of supports and prescribed ones
  virtual Points elastic_force(const Points& displacement) const = 0;  // K u, 3 x n_nodes, N
  // The same to some 1e-7 of the largest difference between neighbours, from what increments have at hand.
  virtual Points quick_elastic_force(const Points& displacement) const { return elastic_force(displacement); }
  // Diagonal of the interface's own Schur complement in the rows' directions, shared between their laws (N s/m; static
  // N/m). Empty where it is not formed: search directions then follow from rows and masses.
  virtual const Vec& schur_diagonal() const = 0;
  // Fixes the search directions k (one per row) and with them what answers to interface data. Pieces that share
  // another's operator come after it. Throws NumericalError.
  virtual void set_search_directions(const Vec& k) = 0;
  virtual const Vec& k() const = 0;
  // Velocities at all rows for a unit q at each of some of them: those columns of T (A + T^T k T)^-1 T^T.
  virtual Mat row_compliance(const std::vector<int>& columns) const = 0;
  // Is its operator that of an equal piece, built before?
  virtual bool shares_operator() const { return false; }
  // Pieces with the same key are solved together; null: this one by itself.
  virtual const void* shared_key() const { return nullptr; }

  // The state: from nodal fields (3 x n_nodes), displacement, velocity, and the external and interface forces in
  // balance with them; or as it was at another time.
  virtual void set_state(const Points& displacement, const Points& velocity, const Points& force,
                         const Points& interface_force) = 0;
  // Elongations of the branches of the material's damping in a dynamic step (m, 3 x n_nodes each), which set_state has
  // relaxed; there may be more than the material has. Those now: none in a static step.
  virtual void set_elongations(const std::vector<Points>& /*elongation*/) {}
  virtual std::vector<Points> elongations() const { return {}; }
  // Velocities after a jump: `held` has those of held directions after it, `before` all as they were. What holds them
  // gives an impulse, which others feel through a mass matrix.
  virtual Points after_jump(const Points& /*before*/, const Points& held) const { return held; }
  // Velocities (m/s) that impulses on the nodes (3 x n_nodes, N s) bring; held directions stay.
  virtual Points velocity_of_impulse(const Points& impulse) const = 0;
  virtual const PieceState& state() const = 0;
  virtual void restore(const PieceState& state) = 0;
  virtual IncrementEnergy stored_energy() const = 0;  // kinetic and strain now

  // A time step of the deck begins, made of one increment or of several: accelerations, reactions and forces of
  // supports are means from here on.
  virtual void begin_interval() {}
  // An increment. Right-hand side: external force (3 x n_nodes), velocities of the motions at its end. Where the forces
  // changed by less than `quiet` (sum of f^2 dt/m, W) nothing need be solved until the interfaces ask for it.
  virtual void begin(const Points& force, const std::vector<double>& motion_velocity, double quiet) = 0;
  // Forward and backward solves of pieces with one key, this the first of them.
  virtual void forward(std::span<Piece* const> /*equal*/) {}
  virtual void backward(std::span<Piece* const> /*equal*/) {}
  // Has the increment at hand been solved for, or does the piece rest, since nothing has changed by more than `quiet`?
  // Wakes it, as interface data that ask for more than that would.
  virtual bool is_moved() const { return true; }
  virtual void wake() {}
  // Velocities at the rows for interface data q.
  virtual void interface_velocity(Eigen::Ref<const Vec> q, Eigen::Ref<Vec> velocity) = 0;
  // The same, what has changed since interface_velocity was last called in half precision, where the piece has its
  // operator so (manual, eq. A6). An increment ends with a call of interface_velocity.
  virtual bool has_operator_in_half() const { return false; }
  virtual void interface_velocity_in_half(Eigen::Ref<const Vec> q, Eigen::Ref<Vec> velocity) {
    interface_velocity(q, velocity);
  }
  // Roughly how they change with interface data that change by q: as much as a stiffness k at each row would have it,
  // or better (manual, eq. A5).
  virtual bool has_rough_operator() const { return false; }
  virtual void rough_change(Eigen::Ref<const Vec> q, Eigen::Ref<Vec> velocity) const {
    velocity = 0.5 * q.cwiseQuotient(k());
  }
  // After the backward solve, for the q last given: advances the state. interface_force: on held directions of moving
  // nodes (3 x n_nodes), or null.
  virtual IncrementEnergy finish(Eigen::Ref<const Vec> q, const Points* interface_force) = 0;

  // Fields, 3 x n_nodes: m, m/s, m/s^2 (mean over the last increment).
  virtual Points displacement() const = 0;
  virtual Points velocity() const = 0;
  virtual Points acceleration() const = 0;
  // The same at some nodes alone, in their order.
  virtual Points displacement(const std::vector<int>& nodes) const { return displacement()(Eigen::all, nodes); }
  virtual Points velocity(const std::vector<int>& nodes) const { return velocity()(Eigen::all, nodes); }
  virtual Points acceleration(const std::vector<int>& nodes) const { return acceleration()(Eigen::all, nodes); }
  virtual Vec row_displacements() const = 0;
  // Force (N) of supports and prescribed motions on the piece in the last increment, and of non-reflecting supports.
  virtual Points reactions(const Points& interface_force) const = 0;
  virtual Points absorbing_force() const = 0;

  virtual PieceFigures figures() const = 0;
};

}  // namespace dygita
