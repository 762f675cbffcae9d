// What a body is made of inside: cells, or matrices in their place. Its motions as a whole, its places, what its nodes
// follow and what holds it are asked here, and are the same question for both.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "numerics/types.hpp"

namespace dygita {

class Fnv1a;
struct CondensedBody;

using ResistedMotions = Eigen::Matrix<double, 6, Eigen::Dynamic>;

// The lists are empty of a body of cells: all its nodes move by themselves, and nothing is hidden in it.
struct Interior {
  // A node of a rigid face: u = u_point + u_turn / size x arm.
  struct Follower {
    int node, point, turn;  // turn: -1 where the face does not turn
    Vec3 arm;               // m, from the point to the node
    double size;            // m
  };
  std::vector<Follower> followers;           // by node
  std::vector<std::pair<int, Vec3>> held;    // a node and a direction (unit) that something inside holds: points
  std::vector<std::pair<int, Vec3>> absent;  // the same of turns and amplitudes: no unknown
  SparseMatrix damping;                      // 3n x 3n, N s/m, beside that of the material; empty: there is none
  double valid_to = 0.0;                     // Hz; 0: nobody says

  static const std::shared_ptr<const Interior>& of_cells();
  virtual ~Interior() = default;

  // Matrices in the place of cells, or null: who needs cells for stress, waves or a mass at each node refuses them.
  virtual const CondensedBody* matrices() const = 0;
  // Does the node stand for a place, whose displacement it has?
  virtual bool is_place(int node) const = 0;
  // Nodal values (3 x n) of a motion as a whole: of velocity `translation` at a point, and `rotation` about it; x:
  // 3 x n, m, of the nodes.
  virtual Points rigid_motion(const Points& x, const Vec3& about, const Vec3& translation,
                              const Vec3& rotation) const = 0;
  // What resists motions as a whole from inside (a support that was condensed with the body): each motion m =
  // (translation at the origin, rotation about it) is resisted by columns c with c . m != 0. 6 x number of them.
  virtual ResistedMotions resisted_motions(const Points& x) const = 0;
  // Nodal values of an acceleration (m/s^2, of a place in the axes of x) that a load gives to all of the body, at most
  // linear in the place: that of each node; of matrices that of a motion as a whole with the same force and moment.
  virtual Points acceleration(const Points& x, const std::function<Vec3(const Vec3&)>& at) const = 0;
  virtual double mass(double of_cells) const = 0;  // kg; of_cells: density times volume
  virtual std::shared_ptr<const Interior> turned(const Mat3& turn, const Points& x) const = 0;  // x: as turned
  virtual void add_to(Fnv1a& digest) const = 0;

  Points rigid_motion(const Points& x, const Vec3& translation, const Vec3& rotation) const {
    return rigid_motion(x, Vec3::Zero(), translation, rotation);
  }
  // Does something inside resist a translation along a direction?
  bool resists(const Points& x, const Vec3& direction) const;
  const Follower* follower(int node) const;  // null: the node is none
  // m, of the rigid face that this node turns; 0: it turns none.
  double size_of_turn(int node) const;
};

}  // namespace dygita
