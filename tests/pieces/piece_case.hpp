// A small piece and the same equations in dense matrices over all nodal directions: what its operator, state and
// increments are checked against (manual, eq. S1-S7).
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numeric>

#include "meeting/facing.hpp"
#include "mesh/box.hpp"
#include "pieces/make_piece.hpp"

namespace dygita {

Elastic steel();

// Reproducible numbers in [-1, 1].
double pseudo_random(int i);
Points random_points(int n, int seed);
Vec random_vector(int n, int seed);

// A block of 10 x 10 x 20 mm in 2 x 2 x 2 cells: z = 0 held (all or the normal alone, at rest or moved along x and z by
// two motions), an interface with a row for each direction of an inclined frame on top, of a node each or spread over
// several.
struct PieceCase {
  PieceCase() = default;
  PieceCase(const PieceCase&) = delete;  // the set-up points into it
  PieceCase& operator=(const PieceCase&) = delete;

  double dt = 0.0;  // s; 0: static
  double g = 0.5;
  Damping damping;
  bool is_held = true, holds_normal_alone = false, is_moved = false, is_absorbing = false;
  bool has_matrix = false, has_massless = false, has_spread_rows = false;

  std::shared_ptr<Substructure> part;
  Body body;
  PieceSetup setup;

  void make();
  // Everything that has been made, about the origin; the mass stays.
  void turn(const Mat3& by);

  std::vector<int> nodes(const char* face) const { return nodes_of(part->mesh->faces.at(face)); }
  int n_nodes() const { return part->mesh->n_nodes(); }
  int n_rows() const { return static_cast<int>(setup.rows.size()); }

  // Search directions of about the interface's own stiffness, none like the other.
  Vec directions() const;
  std::unique_ptr<ImplicitPiece> piece(bool is_plain = false) const;

 private:
  void make_mass();

  void hold();

  void make_rows();
  void spread_rows();
};

// The same without factor, recurrence or numbering.
class DensePiece {
 public:
  explicit DensePiece(const PieceCase& of);

  // A on all nodal directions: of V1 in the equation of an increment, without the rows.
  Mat matrix() const;
  // Velocities at the rows for unit q.
  Mat compliance(const Vec& directions) const;
  Vec held_velocity(const std::vector<double>& motion_velocity) const;
  // S2 for V1, by elimination.
  Vec solve(const Vec& u0, const Vec& v0, const Vec& force, const Vec& q, const Vec& directions,
            const std::vector<double>& motion_velocity) const;
  // What of the equation's left side is known, moved to the right.
  Vec rest(const Vec& u0, const Vec& v0) const;
  Vec mean_velocity(const Vec& v0, const Vec& v1) const { return start.cwiseProduct(v0) + end.cwiseProduct(v1); }
  Vec next_displacement(const Vec& u0, const Vec& v0, const Vec& v1) const;

  TimeScheme scheme;
  double g;  // weight of the start
  Damping damping;
  int n;
  Mat k, mass, z, rows, held, free;
  Vec end, start;  // D, G of eq. S7
  std::vector<std::vector<std::pair<int, double>>> motions;
};

Vec flat(const Points& points);
Points nodal(const Vec& values);

// An increment of one piece by itself, for data q.
IncrementEnergy advance(Piece& piece, const Points& force, const Vec& q, const std::vector<double>& motions,
                        Vec* velocity = nullptr);

// T (A + T^T k T)^-1 T^T.
inline Mat row_compliance(const Piece& piece) {
  std::vector<int> all(static_cast<size_t>(piece.n_rows()));
  std::iota(all.begin(), all.end(), 0);
  return piece.row_compliance(all);
}

}  // namespace dygita
