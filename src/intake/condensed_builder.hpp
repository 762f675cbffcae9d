// A condensed body that grows node by node, and then takes its matrices.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace dygita {

constexpr int no_row = -1;  // something inside holds it, or there is none

class CondensedBuilder {
 public:
  // Rows (from 0, or no_row) of three unknowns of a node at a place (m). Answers the node.
  int add(NodeKind kind, const Vec3& place, const std::array<int, 3>& rows);
  // A node of a rigid face: of its point, its turn (-1: it has none) and its size (m).
  void add_follower(const Vec3& place, int point, int turn, double size);
  int n_nodes() const { return static_cast<int>(places_.size()); }
  CondensedBody& body() { return *body_; }

  // Amplitudes for the rows that no node has yet, and all entries; damping may be empty. The mesh has its faces, and
  // where it comes from. Throws InputError where two nodes have one row.
  MeshPtr finish(const Mat& stiffness, const Mat& mass, const Mat& damping, std::shared_ptr<Mesh> mesh);

 private:
  void check_rows_once(const std::string& source) const;
  void add_amplitudes(Eigen::Index n_rows);
  SparseMatrix dense_pattern() const;
  SparseMatrix on_nodes(const Mat& matrix, const SparseMatrix& pattern) const;
  double mass_of_translation(const Points& x) const;

  std::shared_ptr<CondensedBody> body_ = std::make_shared<CondensedBody>();
  std::vector<Vec3> places_;
  std::vector<std::array<int, 3>> rows_;
};

// A body that does not deform: a mass with its inertia, and facets that move with it.
struct RigidBody {
  struct Side {
    std::string name;
    std::vector<Facet> facets;  // outward from what it touches: they are turned round
    Points places;              // 3 x n, m, of their nodes
  };
  double mass;   // kg
  Mat3 inertia;  // kg m^2, about `at`
  Vec3 at;       // m, its centre of mass
  std::vector<Side> sides;
};
// Its six motions are those of its centre. Throws InputError where its facets have no extent about that.
MeshPtr rigid_body(const RigidBody& given);

}  // namespace dygita
