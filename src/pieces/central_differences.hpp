// A piece integrated by central differences (manual, eq. S9-S11, E3): one product by K a step and a diagonal matrix.
#pragma once

#include "fem/mass_edges.hpp"
#include "interfaces/loads.hpp"
#include "pieces/explicit_piece.hpp"
#include "pieces/piece_operator.hpp"

namespace dygita {

// Its stiffness, and what tunes its mass: shared by equal bodies.
struct ExplicitOperator {
  std::shared_ptr<const EdgeBlocks> stiffness;
  MassEdges tuning;  // empty: the mass is lumped
  explicit ExplicitOperator(const PieceSetup& setup);
};

// Memory (bytes) that it will hold; shares: its stiffness is another's.
double explicit_bytes(const PieceSetup& setup, bool shares);

// Fields have four numbers a node, the fourth being zero. Displacements are counted from the step's start, and held
// half a step ahead of the velocities: D = U - U_start + dt/2 V.
class CentralDifferences final : public ExplicitPiece {
 public:
  CentralDifferences(PieceSetup setup, std::shared_ptr<const ExplicitOperator> op);

  const PieceSetup& setup() const { return setup_; }
  const std::shared_ptr<const ExplicitOperator>& op() const { return op_; }
  const std::vector<InterfaceRow>& rows() const override { return setup_.rows; }
  const Vec& node_masses() const override { return setup_.body->mass->lumped; }
  const Vec& unknown_masses() const override { return unknown_masses_; }
  Points unknown_directions() const override;
  bool is_massless(int) const override { return false; }
  bool has_motions() const override { return has_motions_; }
  Points elastic_force(const Points& displacement) const override;
  Points quick_elastic_force(const Points& displacement) const override;
  const Vec& schur_diagonal() const override { return schur_diagonal_; }
  void set_search_directions(const Vec& k) override;
  const Vec& k() const override { return k_; }
  Mat row_compliance(const std::vector<int>& columns) const override;

  void set_state(const Points& displacement, const Points& velocity, const Points& force,
                 const Points& interface_force) override;
  void set_elongations(const std::vector<Points>& elongation) override;
  std::vector<Points> elongations() const override;
  Points velocity_of_impulse(const Points& impulse) const override;
  const PieceState& state() const override;
  void restore(const PieceState& state) override;
  IncrementEnergy stored_energy() const override;

  void begin_interval() override;
  void begin(const Points& force, const std::vector<double>& motion_velocity, double quiet) override;
  void interface_velocity(Eigen::Ref<const Vec> q, Eigen::Ref<Vec> velocity) override;
  // Works alone: what is stored is asked of stored_energy, since it takes a pass over all nodes.
  IncrementEnergy finish(Eigen::Ref<const Vec> q, const Points* interface_force) override;

  Points displacement() const override;
  Points velocity() const override;
  Points acceleration() const override;
  Points displacement(const std::vector<int>& nodes) const override;
  Points velocity(const std::vector<int>& nodes) const override;
  Points acceleration(const std::vector<int>& nodes) const override;
  Vec row_displacements() const override;
  Points reactions(const Points& interface_force) const override;
  Points absorbing_force() const override;
  PieceFigures figures() const override;

  void set_loads(const Points& constant, const std::vector<PatternLoad>& loads) override;
  void begin(const std::vector<double>& load_values, const std::vector<double>& motion_velocity) override;
  void begin_pull(const std::vector<double>& load_values) override;
  void begin_motion(const std::vector<double>& motion_velocity) override { move(motion_velocity); }
  Vec3 pull_at(int node) const override { return Eigen::Map<const Vec3>(y_.data() + 4 * static_cast<size_t>(node)); }
  Points& share_pulls(std::vector<int> nodes) override {
    sharing_ = std::move(nodes);
    shared_pulls_ = Points::Zero(3, static_cast<Eigen::Index>(sharing_.size()));
    return shared_pulls_;
  }

  bool is_tuned() const override { return setup_.tuned_speed > 0.0; }
  Points coupled(const Points& velocity) const override;
  void set_momenta(const Points& z) override;

  int index_of(int node) const override { return node; }
  Mat3 node_compliance(int node) const override;
  bool has_held(int node) const override {
    const auto it = index_.find(node);
    return it != index_.end() && specials_[it->second].has_held;
  }
  void add_held_force(int node, const Vec3& force) override { special_at(node).held_force += force; }

 private:
  // A node with rows, held directions or an impedance.
  struct Special {
    int node = 0, n_free = 3;
    Mat3 free = Mat3::Identity();                              // its free directions: the first n_free columns
    Mat3 matrix = Mat3::Zero();                                // D on them
    Mat3 compliance = Mat3::Zero(), with_rows = Mat3::Zero();  // D^-1, (D + T^T k T)^-1, in global axes
    Mat3 impedance = Mat3::Zero();                             // N s/m
    bool absorbs = false, has_held = false;
    std::vector<int> rows;
    std::vector<std::pair<Vec3, std::vector<std::pair<int, double>>>> held;  // direction, motions
    // Of the increment at hand, then of the time step of the deck.
    Vec3 rhs = Vec3::Zero(), v_old = Vec3::Zero(), held_velocity = Vec3::Zero(), held_force = Vec3::Zero();
    Vec3 pull = Vec3::Zero(), moved = Vec3::Zero();  // N s, sum of dt (K X - f); m, sum of dt V_g
  };

  void make_specials();
  void make_compliance(Special& special);
  Special& special_at(int node) { return specials_[index_.at(node)]; }
  void pull();
  void move(const std::vector<double>& motion_velocity);
  void take_momenta();
  void look_back();
  void relax_branches();
  void start_momentum();
  // Nodes whose cells are lumped have mass times velocity; laws push them after the momenta are made.
  bool has_momentum(size_t node) const { return is_tuned() && !setup_.keeps_lumped[node]; }
  Vec3 pull_on(int node) const {  // K X - f + beta K V0, and what a tuned mass adds
    const Vec3 pull = pull_at(node);
    return is_tuned() ? Vec3(pull + Eigen::Map<const Vec3>(coupled_.data() + 4 * static_cast<size_t>(node))) : pull;
  }
  void update_loads(const std::vector<double>& values);
  void add_damping_of_strain();
  void advance_branches();
  double damping_work();
  double branch_work();
  bool is_damped() const { return !v_old_.empty(); }
  bool has_damping_of_strain() const { return !elastic_.empty(); }
  void book_special(Special& special, IncrementEnergy& energy);
  double at_row(int i, const Vec3& nodal) const { return setup_.rows[i].nodes[0].along.dot(nodal); }

  PieceSetup setup_;
  std::shared_ptr<const ExplicitOperator> op_;
  bool has_motions_ = false;
  double keep_ = 1.0;            // share of a velocity that mass damping leaves: (1/dt - alpha/2) / (1/dt + alpha/2)
  std::vector<double> inverse_;  // of D, s/kg, one a node
  Vec k_, schur_diagonal_, unknown_masses_;
  std::vector<Special> specials_;
  std::unordered_map<int, size_t> index_;  // of a node in them

  // A branch of the material's damping, held half an increment ahead of the velocities as D is: elongation, and K times
  // it. Until the first increment both are those of the start.
  struct OwnBranch {
    double strength;
    Relaxation whole, half;  // of an increment
    std::vector<double> e, force;
  };
  std::vector<OwnBranch> branches_;
  bool is_ahead_ = false;
  double in_branches_ = 0.0;  // J, stored

  // As the nodes' D and V: K X - f, and beta K V0; K U - f at the step's start with the loads at hand, and without; V
  // at the start of the deck's time step.
  std::vector<double> y_, base_, start_force_, v_interval_;
  std::vector<double> v_old_;  // with damping only
  // With damping of strain only: K (X - U_start) of the increment at hand, dt K V0.
  std::vector<double> elastic_, pull_of_motion_;
  // With a tuned mass only: M^-1 (K X - f) on free directions, C times that, momenta and those before.
  std::vector<double> free_pull_, coupled_, p_, p_old_;
  std::vector<int> sharing_;  // nodes on cuts and ties, and what the mass spreads there in place of K X - f
  Points shared_pulls_;
  double start_strain_ = 0.0, interval_ = 0.0;  // J, at U of the step's start; s, since the deck's time step began

  // Loaded nodes.
  std::vector<int> loaded_;
  std::vector<Vec3> constant_, load_, loaded_v_old_;
  struct SlotLoad {
    size_t pattern;
    std::vector<std::pair<int, Vec3>> slots;
  };
  std::vector<SlotLoad> patterns_;
  std::vector<double> load_values_;
  bool has_forces_ = false;  // those of the step are in base_
  mutable PieceState shown_;
};

}  // namespace dygita
