// A body that is known by its matrices alone, as another program or output.superelement has condensed it: it has faces
// and no cells (manual, superelements as parts).
#pragma once

#include <array>
#include <vector>

#include "mesh/interior.hpp"

namespace dygita {

// What the three unknowns of a node are.
enum class NodeKind {
  point,      // its displacement (m)
  turn,       // the rotation of a rigid face, times its size (m)
  amplitude,  // amplitudes of three modes
  follower,   // none of its own: it moves with a rigid face
};

struct CondensedBody final : Interior {
  // 3n x 3n, N/m, kg, symmetric, with all 3 x 3 blocks of the same pairs of nodes, as `damping` has them.
  SparseMatrix stiffness, mass_matrix;
  std::vector<NodeKind> kinds;  // of each node; amplitudes come last
  double mass_of_parts = 0.0;   // kg
  // 3n x 6: amplitudes that go with motions as a whole, translations and rotations about the origin: those that leave
  // least energy. Zero where they are of modes with the interface held.
  Mat carried;

  int n_rows() const;    // unknowns, what is held inside apart
  int n_places() const;  // points, and nodes of rigid faces
  int n_nodes() const { return static_cast<int>(kinds.size()); }

  const CondensedBody* matrices() const override { return this; }
  bool is_place(int node) const override {
    return kinds[static_cast<size_t>(node)] == NodeKind::point ||
           kinds[static_cast<size_t>(node)] == NodeKind::follower;
  }
  using Interior::rigid_motion;
  Points rigid_motion(const Points& x, const Vec3& about, const Vec3& translation, const Vec3& rotation) const override;
  ResistedMotions resisted_motions(const Points& x) const override;
  Points acceleration(const Points& x, const std::function<Vec3(const Vec3&)>& at) const override;
  bool is_rigid() const { return stiffness.norm() == 0.0; }
  double mass(double) const override { return mass_of_parts; }
  std::shared_ptr<const Interior> turned(const Mat3& turn, const Points& x) const override;
  void add_to(Fnv1a& digest) const override;

  // Fills `carried`, which the other members count on; x: 3 x n, m, of the nodes.
  void find_carried(const Points& x);
  // kg, of each node: the diagonal of the mass, scaled so that points have all of it (Hinton, Rock, Zienkiewicz,
  // Earthquake Eng. Struct. Dyn. 4, 1976); none of followers, turns and amplitudes.
  Vec node_masses() const;
  // N/m^2, of what lies behind the points: stiffness of a point over its distance from the next. A guess, for search
  // directions.
  double modulus(const Points& x) const;
};

}  // namespace dygita
