// One substructure in one step: the linear part that gives factor, forward, backward, interface operator and mass.
#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include "fem/assembly.hpp"
#include "numerics/factor.hpp"
#include "solution/exchange.hpp"

namespace dygita {

// The mass of a substructure in dynamic steps.
struct Mass {
  Vec lumped;                     // kg, of each node
  SparseMatrix matrix;            // n_nodes x n_nodes, kg, row sums as above; empty: lumped
  std::vector<char> is_massless;  // nodes whose mass has been moved inside (manual, eq. S7); empty: none
};

// A substructure's matrices; shared by equal substructures and by all steps.
struct Body {
  const Substructure* part = nullptr;
  std::shared_ptr<const BodyMatrices> matrices;
  std::shared_ptr<const Mass> mass;
};

// Coefficients of the time scheme; a static step has dt = 1, g = 0 and no mass (manual, eq. S1-S5).
struct Scheme {
  bool is_static = true;
  double dt = 1.0, g = 0.0;

  double c0(const Damping& d) const { return g * (1 - g) * dt + g * beta(d); }              // of K V0
  double c1(const Damping& d) const { return (1 - g) * (1 - g) * dt + (1 - g) * beta(d); }  // of K V1
  double alpha(const Damping& d) const { return is_static ? 0.0 : d.mass; }
  double beta(const Damping& d) const { return is_static ? 0.0 : d.stiffness; }
  double inverse_dt() const { return is_static ? 0.0 : 1.0 / dt; }  // of M (V1 - V0)
};

// Energies of one increment (J): works of the increment, and what is stored at its end.
struct IncrementEnergy {
  double loads = 0.0, damping = 0.0, scheme = 0.0;
  double kinetic = 0.0, strain = 0.0;
};

class Piece {
 public:
  // One unknown q of the exchange on this substructure: the velocity of a node in a direction.
  struct Row {
    int node;
    Vec3 direction;
    double reference_stiffness;  // added before factorising a floating substructure, taken off its Schur complement
    double static_stiffness;     // of the substructure behind the node, E A / L or G A / L (N/m)
    double n_sharing;            // laws with a q each at this node and direction: sum over its rows of (d . d')^2
  };
  struct Setup {
    const Body* body;
    Scheme scheme;
    const std::unordered_map<int, Held>* held;
    const std::unordered_map<int, Mat3>* absorbing;  // impedance of nodes (N s/m), dynamic steps
    std::vector<Row> rows;
    int n_motions = 0;
    std::string what;           // "substructure 'rod' in step 'shock'", for messages
    bool is_assembled = false;  // the system is solved elsewhere, with other substructures' in it: no factor of its own
    Precision precision = Precision::double_precision;  // of what is stored of the factor and of H
    double storage_error = 0x1p-26;                     // in single precision, of entries of the factor; H: a sixteenth
    const class Piece* twin =
        nullptr;                 // an equal piece, built before: its factor and interface operator serve this one too
    bool is_prediction = false;  // lays the factor out and goes no further: only predicted_bytes() then has a meaning
  };
  // Assembles and factorises. Throws NumericalError.
  explicit Piece(Setup setup);
  // Would a piece with this set-up have the same matrix, rows and order of unknowns?
  bool equals(const Setup& other) const;

  int n_rows() const { return static_cast<int>(setup_.rows.size()); }
  int n_free() const { return static_cast<int>(mass_.size()); }
  const Setup& setup() const { return setup_; }
  const Factor* factor() const { return factor_.get(); }
  const std::vector<std::pair<int, Mat3>>& absorbing() const { return absorbing_; }  // node, impedance (N s/m), by node
  bool has_motions() const { return has_motions_; }
  // Is almost all of it interface, so that full solves at each iteration cost less than products with H? (A washer, a
  // thin plate.) It has then no Schur complement, and the plain form whatever set_search_directions is told.
  bool is_mostly_interface() const { return is_mostly_interface_; }
  // Does it use the factor of an equal piece?
  bool shares_factor() const { return setup_.twin && factor_; }

  // Diagonal of the interface's own Schur complement in the rows' directions, shared between their laws (N s/m; static
  // N/m).
  const Vec& schur_diagonal() const { return schur_diagonal_; }
  // Fixes the search directions k (one per row) and forms H = (S0 + k)^-1; `plain` factorises A + k and solves in full
  // instead.
  void set_search_directions(const Vec& k, bool plain);
  const Vec& k() const { return k_; }
  // Velocities at the rows for a unit q at each of them, T H T^T (n_rows x n_rows).
  Mat row_compliance() const;
  // Has the node given its mass away in this step (manual, eq. S7)?
  bool is_massless(int node) const {
    const std::vector<char>& massless = setup_.body->mass->is_massless;
    return !setup_.scheme.is_static && !massless.empty() && massless[node];
  }
  double node_mass(int node) const { return setup_.body->mass->lumped[node]; }

  // State from nodal fields (3 x n_nodes): displacement, velocity, and the external and interface forces in balance
  // with them.
  void set_state(const Points& displacement, const Points& velocity, const Points& force,
                 const Points& interface_force);
  // Right-hand side of an increment: external force (3 x n_nodes), velocities of the motions at its end. The increment
  // is solved for the change of velocity that the change of forces makes; where the forces changed by less than `quiet`
  // (sum of f^2 dt/m, W) nothing is solved until the interfaces ask for it.
  void begin(const Points& force, const std::vector<double>& motion_velocity, double quiet = 0.0);
  // Forward and backward solves of equal pieces together; of those that have something to solve.
  static void forward(const std::vector<Piece*>& equal);
  static void backward(const std::vector<Piece*>& equal);
  // Velocities at the rows for interface data q.
  void interface_velocity(Eigen::Ref<const Vec> q, Eigen::Ref<Vec> velocity);
  // For a system solved elsewhere (is_assembled): matrix and right-hand side of this increment on the free unknowns,
  // those of a node (n_free of them from first_free, along the columns of its basis), and the velocities found.
  SparseMatrix matrix() const { return free_matrix(Vec::Zero(n_rows())); }
  const Vec& right_hand_side() const { return x_; }
  int first_free(int node) const { return first_free_[node]; }
  int n_free(int node) const { return n_free_of_[node]; }
  Mat3 basis(int node) const { return special_of_[node] < 0 ? Mat3(Mat3::Identity()) : bases_[special_of_[node]]; }
  void set_velocity(const Vec& free) { v_ = free; }
  // After the backward solve, for the q last given: advances the state. interface_force: on held directions of moving
  // nodes (3 x n_nodes), or null.
  IncrementEnergy finish(Eigen::Ref<const Vec> q, const Points* interface_force);

  Points displacement() const { return expand(u_, held_u_); }  // 3 x n_nodes, m
  Points velocity() const { return expand(v_, held_v_); }
  Points acceleration() const;  // mean over the last increment
  Vec row_values(const Points& nodal) const;
  Vec row_displacements() const;  // u at the rows
  // Force (N) of supports and prescribed motions on the piece in the last increment, one column per node.
  Points reactions(const Points& interface_force) const;
  // Force (N) of absorbing supports on the piece in the last increment, one column per node.
  Points absorbing_force() const;
  // Velocities (m/s) of the free unknowns and their masses (kg), both in this piece's own order: for norms.
  const Vec& free_velocity() const { return v_; }
  const Vec& free_mass() const { return mass_; }
  IncrementEnergy stored_energy() const;  // kinetic and strain now
  bool is_finite() const { return v_.allFinite(); }
  // Substitutions (forward and backward are one each) done and spared because nothing had changed.
  long n_solved() const { return n_solved_; }
  long n_spared() const { return n_spared_; }

  // The state an increment starts from: windows of several steps go back to it.
  struct Snapshot {
    Vec u, v, p, w, z, force, held_pull, q_before;
    int n_since_product = 0;
    std::vector<double> held_u, held_v;
  };
  Snapshot snapshot() const {
    return {u_, v_, p_, w_, z_, force_, held_pull_, q_before_, n_since_product_, held_u_, held_v_};
  }
  void restore(const Snapshot& s);
  double bytes() const;            // held by factor, interface operators and vectors
  double predicted_bytes() const;  // the same, known before factorising

 private:
  struct HeldDirection {
    int node;
    Vec3 direction;
    std::vector<std::pair<int, double>> motion;
  };
  struct Trace {  // a row in terms of free unknowns
    int n = 0;
    std::array<int, 3> at{};
    std::array<double, 3> value{};
  };

  void make_bases();
  Trace trace(int node, const Vec3& direction) const;
  SparseMatrix free_matrix(const Vec& row_stiffness) const;
  void factorise();
  Vec stiffness_times(const Points& nodal) const;
  void resynchronise();
  Mat plain_row_compliance() const;
  double bytes_of_operator_entry() const;
  bool is_condensed() const { return factor_ && !plain_factor_; }
  bool costs_less_in_full(const SparseMatrix& matrix, const std::vector<char>& is_interface);
  void make_couplings();
  Vec restrict_nodal(const Points& nodal) const;
  Points expand(const Vec& free, const std::vector<double>& held) const;
  std::vector<double> held_stiffness(const Points& nodal) const;  // d . K nodal at every held direction
  std::vector<double> held_forces(const Points& interface_force) const;
  void apply_absorbing(const Vec& v, double factor, Vec& out) const;
  // Increments are solved for the change of velocity: nothing changes, nothing to solve.
  bool solves_for_change() const { return !setup_.scheme.is_static && !setup_.is_assembled && massless_.empty(); }
  double at_row(int i, const Vec& v) const {  // v (free unknowns) along row i
    double value = 0.0;
    for (int a = 0; a < traces_[i].n; ++a) value += traces_[i].value[a] * v[traces_[i].at[a]];
    return value;
  }
  // Factor of M V1 in the equation of an increment, 1/s.
  double mass_share() const {
    const Scheme& s = setup_.scheme;
    return s.inverse_dt() + (1 - s.g) * s.alpha(setup_.body->part->material.damping);
  }
  void make_mass();
  void make_massless();
  Vec mass_times(const Vec& v) const;
  Points nodal_mass_times(const Points& nodal) const;
  Vec momentum() const;  // of the free unknowns, what moving supports bring included
  double kinetic_energy() const;
  double damped_energy(const Vec& v) const;
  std::vector<double> held_mass(const Points& nodal) const;  // d . M nodal at every held direction
  Vec mean_velocity() const;  // of the last increment: g V0 + (1 - g) V1, and V1 where there is no mass
  void start_massless();
  void advance_massless();
  double massive_flow(const Vec& v_mean) const;
  Mat with_search_directions(const Mat& schur, const Vec& k) const;

  Setup setup_;
  // Free unknowns of a node: bases_[special_of_[node]] (identity for -1), numbered from first_free_[node].
  std::vector<int> special_of_, n_free_of_, first_free_, node_of_free_;
  std::vector<Mat3> bases_;
  std::vector<int> position_;  // free unknown -> position in the factor (identity until ordered)
  std::vector<HeldDirection> held_;
  bool has_motions_ = false, is_mostly_interface_ = false;
  std::shared_ptr<const Factor> factor_;
  std::unique_ptr<Factor> plain_factor_;
  std::shared_ptr<const Mat> schur_;  // until the search directions are set
  std::shared_ptr<const SymmetricOperator> h_;
  Vec schur_diagonal_, k_;
  std::vector<Trace> traces_;
  std::vector<Vec> coupling_,
      mass_coupling_;         // B^T K, B^T M of a unit velocity of each motion; empty where the motion is elsewhere
  Vec mass_;                  // lumped
  SparseMatrix mass_matrix_;  // of the free unknowns in factor order; empty: lumped
  Vec momentum_;              // M v, kept from one increment to the next
  // Unknowns without mass in a dynamic step: their force is that of the step's end (manual, eq. S7).
  std::vector<int> massless_;
  SparseMatrix massless_columns_;  // of K, one a massless unknown
  Vec end_factor_;                 // D: 1 - g, and 1 for them
  Vec change_;                     // K (U1 - U0) of the last increment, N
  double predicted_factor_bytes_ = 0.0;
  int n_interface_ = 0;
  std::vector<std::pair<int, Mat3>> absorbing_;
  double c0_ = 0.0, c1_ = 0.0;

  Vec u_, v_, p_, w_, force_;  // state, in factor order
  Vec z_;                      // dt K G V, where there are unknowns without mass
  std::vector<double> held_u_, held_v_;
  Vec held_pull_;    // of A, what the motions' velocities at hand bring to the free unknowns
  Vec q_before_;     // of the last increment: forces are counted from it
  Vec start_force_;  // on the rows: q of the last increment less k times the velocity this one starts from
  double quiet_ = 0.0;
  bool is_forward_due_ = false,
       is_moved_ = false;    // forward solve put off; the interfaces have moved in this increment
  int n_since_product_ = 0;  // increments since P and W were computed from K itself
  long n_solved_ = 0, n_spared_ = 0;
  Vec residual_, x_, b_, dv_b_, v_old_, w_old_, start_imbalance_, force_old_;
  std::vector<double> held_v_old_, held_v_new_, held_reaction_;
  Points nodal_force_;
};

}  // namespace dygita
