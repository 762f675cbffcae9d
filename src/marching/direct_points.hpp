// Interface points between explicit pieces: the velocity of a node without a force is known, and so is what a force
// adds to it, so the law of a point gives its force at once (manual, eq. G4-G6). Points that share a node take turns.
#pragma once

#include <utility>

#include "base/fair_shares.hpp"
#include "exchange/direct_links.hpp"
#include "marching/force_mixing.hpp"
#include "pieces/explicit_piece.hpp"
#include "ranks/neighbours.hpp"
#include "step/point_record.hpp"

namespace dygita {

class DirectPoints {
 public:
  // Takes the laws' memory from `start`.
  DirectPoints(const StepModel& model, const State& start);

  // A time step of the deck begins: what has let go by its middle has let go for all of it.
  void begin_interval(int increment);
  // Pieces whose nodes other ranks solve points at: once these have begun the increment, `tell` sends their motions.
  const std::vector<int>& border_pieces() const { return border_pieces_; }
  void tell();
  // Forces and velocities of one increment, all pieces having begun it, and told. motions: velocities at its end.
  // most_threads: as parallel_for has them. Points that touch no other rank's nodes come first, while motions are on
  // their way.
  void solve(const std::vector<double>& motions, int most_threads);
  // Fields and works of the time step of the deck into the state and the energies of the pieces that book them: forces
  // are means over its increments. On several ranks of the points that are kept here.
  void show(State& state, std::vector<IncrementEnergy>& energy, int most_threads);

  // Largest part of a force, relative to the largest, that points sharing nodes have left to each other since this was
  // last asked.
  double take_change();
  double gap_difference() const { return gap_difference_; }  // as LocalStage's
  double bytes() const;

 private:
  // Where faces do not match: one of the nodes that a port moves with.
  struct Share {
    int node = 0;  // of the port's nodes
    bool has_held = false;
    Mat3 block = Mat3::Zero();   // its velocity times this is what it adds to the port's, in the frame
    Mat3 answer = Mat3::Zero();  // s/kg, its velocity for a force on the port
  };
  struct OwnPort {
    ExplicitNodes* nodes = nullptr;
    ExplicitPiece* piece = nullptr;                  // null: on another rank
    int node = 0, index = 0;                         // of the nodes; of the port in the exchange
    int first_share = 0, end_share = 0;              // none: it moves with its node
    bool is_plain = true;                            // a force along an axis of the frame moves it along that axis
    bool has_held = false, is_moved = false;         // directions that a support holds; one that moves does
    Vec3 inverse = Vec3::Zero();                     // 1/k along the frame's axes, s/kg; 0 where held
    Vec3 held_velocity = Vec3::Zero();               // m/s, in the frame
    Vec3 v_old = Vec3::Zero();                       // m/s, in the frame
    Vec3 free = Vec3::Zero();                        // m/s, in the frame, without this law's force
    Vec3 force = Vec3::Zero(), last = Vec3::Zero();  // N, in the frame; of the increment before
    Vec3 impulse = Vec3::Zero();                     // N s, so far in the time step
    Vec3 offset = Vec3::Zero();                      // m/s, closes the jump inside the group

    bool is_spread() const { return first_share < end_share; }
  };
  struct Side {
    int first = 0, end = 0;
    Vec3 r = Vec3::Zero(), inverse_k = Vec3::Zero();
  };
  struct OwnPoint {
    const Point* point = nullptr;
    int index = 0;
    PointRecord record;
    Side side_1, side_2;
    bool keeps_gap = false;       // its law does, from this on
    double gap_difference = 0.0;  // m, of the gap that the law keeps from that of the displacements, as last shown
    bool needs_place = false;     // it needs displacements: its law holds the jump, or a side is a group
    Vec3 impulse = Vec3::Zero();
    Work work;
    double on_pieces = 0.0;
    bool is_booked_here = true;
  };

  // Points whose works a piece's energies take.
  struct Book {
    int piece = 0;
    std::vector<int> points;
    double gap_difference = 0.0;  // m, the largest of theirs
  };

  struct Motions {
    int piece, index;  // index: among the nodes
    ExplicitNodes* nodes = nullptr;
    bool is_here = false;
  };
  void find_motions(const StepModel& model, const NearDirect& near);
  void receive_motions();
  void complete_starts(const ranks::Neighbours& of_starts);
  void split_points();
  void solve_some(int turn, const std::vector<double>& motions, int most_threads);
  void solve_some_clusters(const std::vector<int>& clusters, const std::vector<double>& motions, int most_threads);
  void find_books();
  void book(Book& book, IncrementEnergy& energy) const;
  void set_point(const StepModel& model, OwnPoint& p, int index, const State& start,
                 const std::vector<PortMotion>& motions);
  OwnPort make_port(const StepModel& model, const Point& point, int index);
  Mat3 spread_port(const StepModel& model, const Point& point, const Port& port, OwnPort& own);
  void find_clusters();
  void find_released();
  template <typename Visit>
  void for_each_node(const OwnPort& port, Visit&& visit) const {
    if (!port.is_spread()) visit(port.node);
    for (int i = port.first_share; i < port.end_share; ++i) visit(shares_[i].node);
  }
  Vec3 velocity(const OwnPoint& p, const OwnPort& port) const;            // m/s, in the frame
  Vec3 start_displacement(const OwnPoint& p, const OwnPort& port) const;  // m, in the frame
  Vec3 end_displacement(const OwnPoint& p, const OwnPort& port) const;
  void begin_interval_of(OwnPoint& p);
  void begin_point(OwnPoint& p, const std::vector<double>& motions);
  void begin_places(OwnPoint& p);
  void gather(const OwnPoint& p, Side& side);
  void push(const OwnPoint& p, OwnPort& port, const Vec3& force);
  void scatter(const OwnPoint& p, const Side& side, const Vec3& force);
  void find_force(OwnPoint& p);
  void end_point(OwnPoint& p);
  void add_held_force(const OwnPoint& p, const OwnPort& port);
  double difference_of_gaps(const OwnPoint& p) const;
  void solve_alone(OwnPoint& p, const std::vector<double>& motions);
  std::pair<double, double> take_turns(const std::vector<int>& members, double share);
  void take_forces(const std::vector<int>& members, Vec& forces) const;
  void give_forces(const std::vector<int>& members, const Vec& forces);
  Vec weights_of(const std::vector<int>& members) const;
  bool have_bounded_forces(const std::vector<int>& members) const;
  void leap_from(const std::vector<int>& members, const Vec& weight);
  void start_from_last(OwnPoint& p);
  double least_force(const std::vector<int>& members) const;
  void solve_cluster(const std::vector<int>& members, const std::vector<double>& motions);

  const StepModel* model_;
  Increment increment_;
  double close_enough_;  // of the largest force, between rounds over points that share nodes
  // Nodes that several ranks solve points at, told by those who have them.
  std::vector<Motions> motions_;
  ranks::Neighbours of_motions_;
  std::vector<double> packed_;
  bool has_clusters_ = false;  // anywhere
  std::vector<OwnPort> ports_;
  std::vector<Share> shares_;
  std::vector<OwnPoint> points_;  // those that are kept here
  std::vector<int> released_;     // surfaces with points in closed form, on any rank, which a load may release
  // Points, and sets of points that take turns: those on nodes that are here, then the others.
  std::vector<int> alone_;
  std::vector<std::vector<int>> clusters_;
  std::array<std::vector<int>, 2> points_in_turn_, clusters_in_turn_;
  std::vector<int> border_pieces_;
  std::array<FairShares, 2> solved_shares_;  // of points_in_turn_
  FairShares shown_shares_;
  std::vector<Book> books_;
  std::vector<int> last_of_surfaces_;  // points with a law
  struct Swept {
    double change = 0.0;
    int sweeps = 0;
    ForceMixing mixing;
    Vec weight;  // s/kg, of the forces on its ports
  };
  std::vector<Swept> swept_;  // of each cluster in the last increment
  double interval_ = 0.0;     // s, of the time step that increments have gone through
  int i_interval_ = 0;
  ranks::LaterLargest largest_of_all_;
  double largest_force_ = 0.0, largest_change_ = 0.0, gap_difference_ = 0.0;
};

}  // namespace dygita
