// The one object through which substructures and interfaces exchange velocity and traction.
//
// A port is one piece's side of one law at one node; its unknowns q = F_hat + k W_hat live in the law's frame.
// Plain bonded ties that meet at a node form a group, and so do the copies of a node that a cut has made; a point is
// the law between two groups (or a group and a wall), or the tie of one group alone (manual, groups).
#pragma once

#include <array>
#include <vector>

#include "exchange/reach.hpp"
#include "interfaces/conditions.hpp"
#include "interfaces/surfaces.hpp"
#include "partition/cut.hpp"

namespace dygita {

struct Port {
  int part = -1, node = -1;                // substructure and its node; where it moves with several, the main one
  int piece = -1, piece_node = -1;         // the same in the piece; equal where nothing is cut
  const SideTrace* trace = nullptr;        // where faces do not match: what point `point` of it moves with; else null
  int point = -1, side = -1;               // side: one number for all ports of a side of such an interface
  bool is_owner = true;                    // of the node's copies the one that forces of surfaces are booked on
  double area = 0.0;                       // m^2, of the facets that meet there
  std::array<int, 3> unknown{-1, -1, -1};  // index in the piece's q of each frame direction; -1: none
  std::array<bool, 3> is_held{};           // the direction belongs to a support or a prescribed motion

  // Its motion, given a field on the substructure (3 x n_nodes).
  Vec3 motion(const Points& nodal) const { return trace ? trace->at(point, nodal) : Vec3(nodal.col(node)); }
  // Calls back with each node that it moves with and what that node's velocity adds to its own (3 x 3).
  template <typename Visit>
  void for_each_node(Visit&& visit) const {
    if (!trace) return visit(node, Mat3(Mat3::Identity()));
    for (int k = 0; k < trace->n_shares(point); ++k) visit(trace->share(point, k).node, trace->block(point, k));
  }
};

// The nodes of its piece that a port moves with.
std::vector<int> piece_nodes(const Cut& cut, const Port& port);

// Adds a force on a port to those on the nodes of its piece.
void spread(const Cut& cut, const Port& port, const Vec3& force, Points& on_piece);

// One point of a surface that a law point stands for, and its share of the force.
struct Member {
  int surface, point;
  double share;
};

struct Point {
  Mat3 frame = Mat3::Identity();                       // columns N, T1, T2; N from side 1 to side 2
  double area = 0.0;                                   // m^2
  const Law* law = nullptr;                            // null: the tie of a group alone
  int first_port = 0, first_port_2 = 0, end_port = 0;  // ports of side 1, then of side 2
  int first_tie = 0, end_tie = 0;                      // of the exchange's ties
  bool is_wall = false;                                // side 2 is rigid and at rest
  std::array<bool, 3> has_law{};                       // directions on which the law acts in this step
  std::array<bool, 3> is_active{};                     // directions that carry an unknown
  bool is_direct = false;                              // solved in closed form, without unknowns (manual, eq. G4-G6)
  bool is_everywhere = false;                          // solved by all ranks (a bolt whose shortening is searched for)
  std::vector<Member> members;
};

// A plain bonded pair inside a group: how outputs split a substructure's force over its interfaces.
struct Tie {
  int point;  // index of the group's point
  int port_1, port_2;
  int surface, surface_point;
};

// How the forces on a group's ports are split over its ties: least norm, weighted with the ties' areas. Many groups
// share theirs.
class TieSplits {
 public:
  TieSplits() = default;
  TieSplits(const std::vector<Point>& points, const std::vector<Tie>& ties, const std::vector<Surface>& surfaces);

  // n_ties x n_ports, force of each tie of the point by those on its ports.
  const Mat& of(const Point& point) const { return splits_[static_cast<size_t>(of_tie_[point.first_tie])]; }

 private:
  std::vector<int> of_tie_;  // of a point's first tie
  std::vector<Mat> splits_;
};

// Of several ranks each has the points that it solves, in the order that they have where one process has all.
struct Exchange {
  std::vector<Port> ports;
  std::vector<Point> points;
  std::vector<Tie> ties;        // one point's after another's
  TieSplits splits;             // of points with ties
  std::vector<int> n_unknowns;  // of each piece
};

// explicit_pieces: which are integrated explicitly; points that connect to no other piece, not even through points that
// share a node of theirs, are direct. Empty: none.
//
// Builds the points of a step from the surfaces that have a part in it and what the step holds. Throws InputError when
// both sides of a law belong to one group (a bolt shortened between bodies that are tied), or a held direction lies
// oblique to a law's normal. Within a reach that is not all: collective.
Exchange make_exchange(const Problem& problem, const Step& step, const Cut& cut, const std::vector<Surface>& surfaces,
                       const Conditions& conditions, const std::vector<char>& explicit_pieces = {},
                       const Reach& reach = {});

}  // namespace dygita
