// The operator of a piece in one step, integrated implicitly: matrix of an increment, mass, couplings to moving
// supports, traces of the interface rows. Nothing of it changes while the step runs.
#pragma once

#include <limits>
#include <string>

#include "numerics/factor.hpp"
#include "pieces/piece_mass.hpp"

namespace dygita {

// Force on a node by the velocity of another one, or its own (N s/m).
struct NodePairImpedance {
  int node, other;
  Mat3 impedance;
};

// What a piece is in a step.
struct PieceSetup {
  const Body* body = nullptr;
  TimeScheme scheme;
  std::vector<InterfaceRow> rows;
  std::unordered_map<int, Held> held;
  std::unordered_map<int, Mat3> absorbing;         // impedance of nodes (N s/m), dynamic steps
  std::vector<NodePairImpedance> absorbing_pairs;  // of facets of order two
  int n_motions = 0;
  std::string what;                                   // "substructure 'rod' in step 'shock'", for messages
  Precision precision = Precision::double_precision;  // of what is stored of the factor and of H
  double storage_error = 0x1p-26;                     // in single precision, of entries of the factor; H: a sixteenth
  double half_error = 0.0, rough_error = 0.0;         // of entries of the H in half precision and of the rough one
                                                      // beside it; 0: there is none
  double n_products = std::numeric_limits<double>::infinity();  // with H, that the step is expected to take
  double tuned_speed = 0.0;        // m/s, of the waves that an explicit piece's mass is tuned to; 0: lumped
  std::vector<char> keeps_lumped;  // then: nodes whose cells stay lumped

  int n_nodes() const { return body->part->mesh->n_nodes(); }
  double mass_share() const;  // of M V1 in the equation of an increment, 1/s
  const Interior& inside() const { return *body->part->mesh->inside; }
  // N s/m, 3n x 3n: that inside of it in a dynamic step; null: there is none.
  const SparseMatrix* damping() const {
    return !scheme.is_static && inside().damping.size() > 0 ? &inside().damping : nullptr;
  }
};

FreeUnknowns unknowns_of(const PieceSetup& setup);

// (M/dt (1 + ...) + c1 K + absorbing) on the free unknowns, in the order of their numbers.
// With T^T k T, k (N s/m) one per row; or with the rows' reference stiffness, as springs on their nodes that couple
// none with another.
SparseMatrix piece_matrix(const PieceSetup& setup, const FreeUnknowns& unknowns, const Vec& row_stiffness);
SparseMatrix matrix_with_reference(const PieceSetup& setup, const FreeUnknowns& unknowns);
// The latter at one node of a row (3 x 3, N/m).
Mat3 reference_spring(const InterfaceRow& row, const NodeAlong& on);

class PieceOperator {
 public:
  // unknowns: in their final order.
  PieceOperator(PieceSetup setup, FreeUnknowns unknowns);

  const PieceSetup& setup() const { return setup_; }
  const TimeScheme& scheme() const { return setup_.scheme; }
  const Damping& damping() const { return setup_.body->part->material.damping; }
  const FreeUnknowns& unknowns() const { return unknowns_; }
  const std::vector<HeldDirection>& held() const { return unknowns_.held(); }
  const PieceMass& mass() const { return mass_; }
  const Traces& traces() const { return traces_; }  // of the rows, on the free unknowns
  // Rows with held directions in them: what those add, given their values.
  bool has_held_rows() const { return has_held_rows_; }
  Vec held_at_rows(const std::vector<double>& held) const;
  int n_rows() const { return static_cast<int>(setup_.rows.size()); }
  int n_free() const { return unknowns_.size(); }
  bool has_motions() const { return has_motions_; }
  double c0() const { return c0_; }
  double c1() const { return c1_; }
  double mass_share() const { return setup_.mass_share(); }

  SparseMatrix matrix(const Vec& row_stiffness) const { return piece_matrix(setup_, unknowns_, row_stiffness); }
  Vec at_rows(const Vec& x) const;
  // K times a nodal field: 3 x n_nodes; on the free unknowns; at the held directions.
  Points elastic_force(const Points& nodal) const;
  Vec stiffness_times(const Points& nodal) const { return unknowns_.restrict_nodal(elastic_force(nodal)); }
  std::vector<double> stiffness_times_held(const Points& nodal) const;
  // Momentum of the free unknowns, what moving supports bring included.
  Vec momentum(const Vec& v, const std::vector<double>& held_v) const;
  // A times velocities of held directions, of all motions, on the free unknowns.
  Vec pull_of_held(const std::vector<double>& held_v) const;
  Vec pull_of_motions(const std::vector<double>& motion_velocity) const;
  // out += factor Z v, at non-reflecting supports; with C V of a body without cells, held directions included.
  void apply_absorbing(const Vec& v, double factor, Vec& out) const;
  void apply_rates(const Vec& v, const std::vector<double>& held_v, double factor, Vec& out) const;
  // C times a nodal velocity (3 x n_nodes), where there is a C.
  bool has_damping_matrix() const { return setup_.damping() != nullptr; }
  Points damping_force(const Points& nodal) const;
  bool absorbs() const { return !setup_.absorbing.empty() || !setup_.absorbing_pairs.empty(); }
  const std::vector<std::pair<int, Mat3>>& absorbing() const { return absorbing_; }  // node, impedance (N s/m), by node

 private:
  void make_couplings();

  PieceSetup setup_;
  StiffnessPtr stiffness_;
  FreeUnknowns unknowns_;
  PieceMass mass_;
  std::vector<std::pair<int, Mat3>> absorbing_;
  Traces traces_, held_traces_;
  // B^T K, B^T M, B^T C of a unit velocity of each motion; empty where the motion is elsewhere.
  std::vector<Vec> coupling_, mass_coupling_, damping_coupling_;
  bool has_motions_ = false, has_held_rows_ = false;
  double c0_, c1_;
};

}  // namespace dygita
