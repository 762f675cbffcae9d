// A piece integrated by the implicit scheme (manual, eq. S1-S7): right-hand side without a product by K, and the update
// once the velocities are known. How they are found is the business of what derives from it.
#pragma once

#include "pieces/piece_operator.hpp"

namespace dygita {

struct Condensation;

// This alone is a piece without a free unknown: there is nothing to find.
class ImplicitPiece : public Piece {
 public:
  explicit ImplicitPiece(PieceOperator op) : op_(std::move(op)), k_(Vec::Zero(op_.n_rows())) {}

  const PieceOperator& op() const { return op_; }
  // What its factor leaves on the interface, for equal pieces to share; null: it has none.
  virtual const Condensation* condensation() const { return nullptr; }

  const std::vector<InterfaceRow>& rows() const override { return op_.setup().rows; }
  const Vec& node_masses() const override { return op_.setup().body->mass->lumped; }
  const Vec& unknown_masses() const override { return op_.mass().lumped(); }
  Points unknown_directions() const override { return op_.unknowns().directions(); }
  bool is_massless(int node) const override;
  bool has_motions() const override { return op_.has_motions(); }
  Points after_jump(const Points& before, const Points& held) const override;
  Points velocity_of_impulse(const Points& impulse) const override;
  Points elastic_force(const Points& displacement) const override { return op_.elastic_force(displacement); }
  const Vec& schur_diagonal() const override { return schur_diagonal_; }
  void set_search_directions(const Vec& k) override;
  const Vec& k() const override { return k_; }
  Mat row_compliance(const std::vector<int>& columns) const override {
    return Mat::Zero(n_rows(), static_cast<Eigen::Index>(columns.size()));
  }

  void set_state(const Points& displacement, const Points& velocity, const Points& force,
                 const Points& interface_force) override;
  void set_elongations(const std::vector<Points>& elongation) override;
  std::vector<Points> elongations() const override;
  const PieceState& state() const override { return state_; }
  void restore(const PieceState& state) override { state_ = state; }
  IncrementEnergy stored_energy() const override;

  void begin_interval() override;
  void begin(const Points& force, const std::vector<double>& motion_velocity, double quiet) override;
  void interface_velocity(Eigen::Ref<const Vec> q, Eigen::Ref<Vec> velocity) override;
  IncrementEnergy finish(Eigen::Ref<const Vec> q, const Points* interface_force) override;
  // Adds a motion (3 x n_nodes, m) that nothing resists to the last increment of a static step.
  void add_free_motion(const Points& motion);

  Points displacement() const override { return op_.unknowns().expand(state_.u, state_.held_u); }
  Points velocity() const override { return op_.unknowns().expand(state_.v, state_.held_v); }
  Points acceleration() const override;
  Points displacement(const std::vector<int>& nodes) const override {
    return op_.unknowns().expand(state_.u, state_.held_u, nodes);
  }
  Points velocity(const std::vector<int>& nodes) const override {
    return op_.unknowns().expand(state_.v, state_.held_v, nodes);
  }
  Points acceleration(const std::vector<int>& nodes) const override;
  Vec row_displacements() const override;
  Points reactions(const Points& interface_force) const override;
  Points absorbing_force() const override;
  PieceFigures figures() const override;

 protected:
  // Of the increment at hand.
  struct Work {
    Points nodal_force;
    Vec residual, x;  // R0; the right-hand side that is solved for, which a solve may overwrite
    Vec v_old, w_old, force_old;
    std::vector<double> held_v_old, held_v_new, held_load;  // held_load: mean external force, N
    Vec change;                                             // K (U1 - U0), N, where there are unknowns without mass
    Vec held_rows;                                          // m/s, at the rows, of moving supports; empty: none
    BranchState recalled;  // what the branches' elongations at the start bring to that which K multiplies
  };
  // The increment is set up: x is its right-hand side less what interface data bring.
  virtual void prepare(double /*quiet*/) {}
  // Puts the velocities at the end of the increment into the state. Are they others than at its start?
  virtual bool find_velocity() { return true; }
  // Increments solved for the change of velocity that a change of forces makes: nothing changes, nothing to solve.
  virtual bool solves_for_change() const { return false; }

  void add_start_force();  // of the interfaces, to x, where increments are solved for the change
  // Velocities at the rows that held directions bring at the increment's end; null where there are none.
  const Vec* held_rows() const { return work_.held_rows.size() > 0 ? &work_.held_rows : nullptr; }

  const PieceOperator op_;
  Vec k_, schur_diagonal_;
  PieceState state_;
  Work work_;

 private:
  void start_massless();
  void advance_massless();
  void advance_forces(Eigen::Ref<const Vec> q, bool is_moved);
  void resynchronise();
  bool has_past() const;
  const std::vector<Branch>& branches() const;
  void recall_branches();
  void advance_branches(const Vec& v_mean, IncrementEnergy& energy);
  double square(const BranchState& branch) const;
  std::vector<double> held_acceleration() const;  // m/s^2, mean over the last increment
  Vec mean_velocity() const;  // of the last increment: g V0 + (1 - g) V1, and V1 where there is no mass
  // What reactions follow from, mean over an increment or over several: the displacement that K multiplies in S1 and
  // the external force, the acceleration and the velocity; 3 x n_nodes each.
  struct Means {
    Points displacement, force, acceleration, velocity;
  };
  Means means_of_increment() const;
  Means means() const;
  void add_to_interval();
  // Of a time step of the deck that is made of several increments; no increments: there is none.
  struct Interval {
    bool has_begun = false;
    int n = 0;
    Means sum;
  };
  Interval interval_;

  double held_mean_velocity(size_t i) const;
  std::vector<double> held_mean_velocities() const;
  double kinetic_energy() const;
  IncrementEnergy static_works(const Vec& v_mean);
  IncrementEnergy dynamic_works(const Vec& v_mean);
  double damped_energy(const Vec& v) const;
  double massive_flow(const Vec& v_mean) const;
  double change_with_motions(const Vec& v) const;
  void add_work_of_motions(const Points& interface_force, double& work);
  std::vector<double> held_forces(const Points& interface_force, const Means& means) const;
};

}  // namespace dygita
