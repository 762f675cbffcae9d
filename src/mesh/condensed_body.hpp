// A body that is known by its matrices alone, as another program or output.superelement has condensed it: it has faces
// and no cells (manual, superelements as parts).
#pragma once

#include <array>
#include <vector>

#include "numerics/types.hpp"

namespace dygita {

// What the three unknowns of a node are.
enum class NodeKind {
  point,      // its displacement (m)
  turn,       // the rotation of a rigid face, times its size (m)
  amplitude,  // amplitudes of three modes
  follower,   // none of its own: it moves with a rigid face
};

struct CondensedBody {
  // A node of a rigid face: u = u_point + u_turn / size x arm.
  struct Follower {
    int node, point, turn;  // turn: -1 where the face does not turn
    Vec3 arm;               // m, from the point to the node
    double size;            // m
  };

  SparseMatrix stiffness, mass;     // 3n x 3n, N/m, kg, symmetric, with all 3 x 3 blocks of the same pairs of nodes
  SparseMatrix damping;             // the same, N s/m; empty: there is none
  std::vector<NodeKind> kinds;      // of each node; amplitudes come last
  std::vector<Follower> followers;  // by node
  std::vector<std::pair<int, Vec3>> held;    // a node and a direction (unit) that something inside holds: points
  std::vector<std::pair<int, Vec3>> absent;  // the same of turns and amplitudes: no unknown
  double mass_of_parts = 0.0;                // kg
  double valid_to = 0.0;                     // Hz; 0: nobody says
  // 3n x 6: amplitudes that go with motions as a whole, translations and rotations about the origin: those that leave
  // least energy. Zero where they are of modes with the interface held.
  Mat carried;

  int n_rows() const;    // unknowns, what is held inside apart
  int n_places() const;  // points, and nodes of rigid faces
  int n_nodes() const { return static_cast<int>(kinds.size()); }
  bool is_place(int node) const { return kinds[node] == NodeKind::point || kinds[node] == NodeKind::follower; }
  const Follower* follower(int node) const;  // null: the node is none
  double size_of_turn(int node) const;       // m, of the rigid face that turns

  // Fills `carried`, which the other members count on; x: 3 x n, m, of the nodes.
  void find_carried(const Points& x);
  // Nodal values (3 x n) of a motion as a whole: of velocity `translation` at the origin and `rotation` about it.
  Points rigid_motion(const Points& x, const Vec3& translation, const Vec3& rotation) const;
  // kg, of each node: the diagonal of the mass, scaled so that points have all of it (Hinton, Rock, Zienkiewicz,
  // Earthquake Eng. Struct. Dyn. 4, 1976); none of followers, turns and amplitudes.
  Vec node_masses() const;
  // What resists motions as a whole from inside (a support that was condensed with the body): each motion m =
  // (translation at the origin, rotation about it) is resisted by columns c with c . m != 0. 6 x number of them.
  Eigen::Matrix<double, 6, Eigen::Dynamic> resisted_motions(const Points& x) const;
  // Does something inside resist a translation along a direction?
  bool resists(const Points& x, const Vec3& direction) const;
  // N/m^2, of what lies behind the points: stiffness of a point over its distance from the next. A guess, for search
  // directions.
  double modulus(const Points& x) const;
  // The same body turned; x: as turned.
  CondensedBody turned(const Mat3& turn, const Points& x) const;
};

}  // namespace dygita
