// The local stage: at each interface point, the law; nothing global.
#pragma once

#include <map>
#include <utility>

#include "law/law_slope.hpp"
#include "step/interface_sums.hpp"
#include "step/preload.hpp"
#include "step/tangents.hpp"

namespace dygita {

// Sums of the indicator over the points (manual, eq. I1), W.
struct IndicatorSums {
  double force_distance = 0.0, velocity_distance = 0.0;  // sum (F - F_hat)^2 / k,  sum k (V - W_hat)^2
  // sum (F^2 + F_hat^2) / 2k,  sum k (V^2 + W_hat^2) / 2; forces of a dynamic step are what it adds to those it found.
  double force_size = 0.0, velocity_size = 0.0;
};

// Of each preload in an increment: shortening (m), force through it and force asked for (N), stiffness of its search
// directions (N/m).
struct PreloadFigures {
  Vec shortening, force, target, stiffest;
  std::vector<const Interface*> interfaces;
};

// Of the points that are near this rank. Fields V, q and image are of the near unknowns; an answer counts where V and q
// are those of all ranks.
//
// Copyable: a window of several steps keeps the copy it starts from.
class LocalStage {
 public:
  // Takes the laws' memory from `start`. k: search directions of the near unknowns.
  LocalStage(const StepModel& model, const State& start, const Vec& k);

  // Interface data that continues the state: q = F_hat + k W_hat with the forces and velocities at hand.
  Vec initial_q() const;
  // What an increment changes before any iteration: jumps, shortenings, velocities of held sides (motions: at its end).
  // Jumps come from the substructures' displacements at the start of a window; inside a window of several steps from
  // W_hat, since the displacements of an unfinished iteration would be answered with a velocity of jump / dt.
  void begin(int increment, const std::vector<double>& motions, bool starts_window);
  // sum k U^2 / 2 (W) of the displacements that the increment starts from; collective.
  double displacement_size();
  // From velocities V and data q of the linear stage: F_hat, W_hat and their q (the fixed-point image). First at points
  // whose unknowns are all here, while others' are on their way, then at the rest.
  void run_inner(const Vec& velocity, const Vec& q, Vec& image);
  void run_outer(const Vec& velocity, const Vec& q, Vec& image);
  void answer(const Vec& velocity, const Vec& q, Vec& image) {
    run_inner(velocity, q, image);
    run_outer(velocity, q, image);
  }
  // Both, and their distance, where all unknowns are here.
  IndicatorSums run(const Vec& velocity, const Vec& q, Vec& image) {
    answer(velocity, q, image);
    return measure(velocity, q, image);
  }
  // The sums that say how far both answers are apart, and what they say. Fields stay what they were meanwhile.
  InterfaceSums::ToCome distance_sums(const Vec& velocity, const Vec& q, const Vec& image) const;
  static IndicatorSums distance_of(const double* sums) { return {sums[0], sums[0], sums[1], sums[2]}; }
  // How far both answers are apart; with it sums of the own unknowns that somebody else needs, which go to
  // receive(sums). Collective, unless every rank has all pieces.
  IndicatorSums measure(const Vec& velocity, const Vec& q, const Vec& image, const InterfaceSums::ToCome& also = {},
                        const std::function<void(const double*)>& receive = nullptr);
  // Accepts the fields of the last iteration: the laws move on.
  void accept() { accept(nullptr, nullptr); }
  // The same; forces, gaps, slips and works go into the state, energies of the points are added to those of the pieces
  // that they are booked with (one each).
  void accept(State& state, std::vector<IncrementEnergy>& energy) { accept(&state, &energy); }
  // J, of each piece, since they were last taken: work of what the forces of its points have changed since the dynamic
  // step began on what the iteration leaves between V and W_hat at them, on all their sides (manual, eq. Q17).
  std::vector<double> take_work_left() {
    return std::exchange(work_left_, std::vector<double>(work_left_.size(), 0.0));
  }
  // Largest difference so far between a contact law's gap and that of the displacements, m.
  double gap_difference() const { return gap_difference_; }
  bool has_preloads() const { return !preloads_.empty(); }
  // Does a force of the law pass between the sides of a point, in the last iteration?
  bool carries(int i_point) const { return !points_[static_cast<size_t>(i_point)].force.isZero(0.0); }
  // Do the sides of a point hold each other, in the last iteration: by a force, or by a law that would pull? least: W,
  // of forces that tell something.
  bool links(int i_point, double least) const;
  // How far (m) its sides may come together; infinite where nothing keeps them apart.
  double gap(int i_point) const;
  const Vec& k() const { return k_; }  // search directions of the near unknowns
  // Prescribes the shortenings of all preloads (m) from now on; empty: they are found again.
  void prescribe_shortenings(Vec d) { prescribed_ = std::move(d); }
  PreloadFigures preload_figures() const;  // of the last iteration
  // Force of the laws on held directions of a piece's nodes (3 x n_nodes, N).
  Points held_force(int piece) const;
  // Normal trials (m/s) of the last iteration, one a point; and those that limit tangential forces from now on, empty:
  // each point's own.
  std::vector<double> normal_trials() const;
  void limit_friction(std::vector<double> trials) { limits_ = std::move(trials); }
  // How the forces of the last iteration answer to the velocities (manual, eq. U1-U3). sticks: what touches does not
  // slide, as where nothing is known yet. follows: with how friction follows the normal force (eq. U6). least: velocity
  // (m/s; static m) below which differences tell nothing.
  Tangents tangents(bool sticks, bool follows, double least, const TangentBounds& bounds) const;

 private:
  struct PortState {
    Vec3 u = Vec3::Zero(), offset = Vec3::Zero();  // m; rate that closes the jump inside the group, m/s
    Vec3 w_old = Vec3::Zero(), w = Vec3::Zero();   // W_hat at the start and now, m/s
    Vec3 f_old = Vec3::Zero(), f = Vec3::Zero();   // F_hat of the last increment and now, N
    Vec3 residual = Vec3::Zero();                  // F - F_hat, N
  };
  // An unknown of a point: its share of the mean velocity of its side (0 where that is held), the side's sign in the
  // jump.
  struct PortRow {
    int unknown, direction;
    double share, sign;
  };
  struct Side {
    Vec3 r = Vec3::Zero(), inverse_k = Vec3::Zero();
  };

  void accept(State* state, std::vector<IncrementEnergy>* energy);
  void run_points(const std::vector<int>& points, const Vec& velocity, const Vec& q, Vec& image);
  Side gather(int first, int end, const Vec& velocity, const Vec& q) const;
  void scatter(int first, int end, const Side& side, const Vec3& force, const Vec& velocity, const Vec& q, Vec& image);
  // The trial of a point with a law, from both its sides.
  void set_trial(const Point& point, const Side& side_1, const Side& side_2, PointRecord& record) const;
  // Finds the shortening of a preloaded interface for the fields at hand, or takes the one prescribed.
  void shorten(int i_preload, const Vec& velocity, const Vec& q);
  void run_point(size_t i_point, const Vec& velocity, const Vec& q, Vec& image);
  const double* limit_at(size_t i_point) const { return limits_.empty() ? nullptr : &limits_[i_point]; }
  std::vector<PortRow> port_rows(const Point& point) const;
  PointTangent point_tangent(const Point& point, const Mat3& of_law, const Vec3& following, double tie) const;
  // Of the law at a point: its stiffness, and how tangential forces follow the normal one.
  struct LawTangent {
    Mat3 stiffness = Mat3::Zero();
    Vec3 following = Vec3::Zero();
  };
  PreloadTangent preload_tangent(const Preload& preload, const std::vector<LawTangent>& of_law) const;
  LawTangent law_tangent(size_t i_point, bool sticks, bool follows, double least, const TangentBounds& bounds) const;
  Vec3 mean_displacement(int first, int end) const;
  double work_on_pieces(const Point& point) const;
  void show_residuals(const Point& point, State& state) const;
  Vec found_forces(const State& start) const;
  double work_of_found(int i_point);
  void book_work_left(const Point& point);
  void find_surfaces();
  void follow_loads(State& state) const;
  // Points between nodes without mass take the force and the gap of the step's end (manual, eq. S7).
  bool is_massless(const Point& point) const;
  Increment increment_at(const Point& point) const {
    return is_massless(point) ? Increment{increment_.of_end(), increment_.push_out} : increment_;
  }

  const StepModel* model_;
  Vec k_;
  Vec found_;  // N, on the near unknowns when a dynamic step begins, a static one: zero
  InterfaceSums sums_;
  std::vector<PortState> ports_;
  std::vector<PointRecord> points_;
  std::vector<Preload> preloads_;
  std::map<int, const Interface*> interfaces_;  // of surfaces whose laws are iterated on any rank, not preloaded
  std::vector<double> points_left_;             // W, of found_ on what is left at each point, in the last increment
  std::vector<double> work_left_;               // J, of each piece, since they were last taken
  std::vector<double> limits_;                  // normal trials that limit tangential forces; empty: each point's own
  Vec prescribed_;                              // shortenings of the preloads; empty: found
  Increment increment_;
  int i_increment_ = 0;
  double gap_difference_ = 0.0;
};

}  // namespace dygita
