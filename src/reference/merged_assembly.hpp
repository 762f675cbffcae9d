// All substructures of a step as one body: tied copies of a node share its unknowns, and what laws do not touch is
// condensed by the sparse factor (manual, eq. R1-R4).
#pragma once

#include "step/make_pieces.hpp"

namespace dygita {

// What follows from the matrix of the assembly and the law rows alone; steps that have both the same share it.
struct AssemblyFactor {
  SparseMatrix matrix, g_of_unknowns;  // A; G on the global unknowns
  std::unique_ptr<Factor> factor;
  std::vector<int> position;  // of the unknowns in the factor's order
  SparseMatrix g;             // G on the interface, n_rows x n_interface in the factor's order
  Mat inverse;                // (S + G^T R G)^-1 on the interface
  Mat compliance;             // W
  Vec softening;              // R
};

class MergedAssembly {
 public:
  // Assembles, factorises and forms the compliance of the law rows, unless those of the step before still hold; before:
  // theirs, or null. Throws InputError, NumericalError.
  explicit MergedAssembly(const StepModel& model, std::shared_ptr<const AssemblyFactor> before = nullptr);

  const std::shared_ptr<const AssemblyFactor>& factor() const { return made_; }

  // A law row is one direction of one point with a law; -1 where nothing can move there.
  int row(size_t i_point, int direction) const { return rows_[i_point][direction]; }
  int n_rows() const { return static_cast<int>(held_rate_.size()); }
  int n_unknowns() const { return n_; }
  // W: rates at the law rows for unit forces there, (n_rows x n_rows) m/(N s); see `softening`.
  const Mat& compliance() const { return made_->compliance; }
  // R: stiffness of the springs across the law rows that W includes, so that bodies held by laws alone have a W (zero
  // in dynamics).
  const Vec& softening() const { return made_->softening; }

  // Right-hand side of an increment, after `begin` of all pieces: forward solve.
  // displacement: of every substructure's nodes, m.
  void begin(const std::vector<double>& motions, const std::vector<Points>& displacement);
  // Rates (side 2 - side 1) at the law rows, without any force there, and the part of them that supports prescribe.
  const Vec& free_rate() const { return free_rate_; }
  const Vec& held_rate() const { return held_rate_; }
  // Interior for the reduced forces F - R (rate - held rate) at the law rows; gives every piece its velocities.
  void finish(const Vec& reduced_force);
  // Force (N) on each port, in its point's frame, from forces F on side 1 of every point (3 components each).
  std::vector<Vec3> port_forces(const std::vector<Vec3>& point_force) const;

  double bytes() const;

 private:
  // Velocity of a node: basis z + what supports and prescribed motions give it.
  struct Node {
    int first = -1, n = 0;          // of the global unknowns
    Mat3 basis = Mat3::Identity();  // first n columns
    std::vector<int> group;         // ports tied together here, empty for a node alone
    Mat3 frame = Mat3::Identity();  // of the group's point
  };
  void make_groups();
  void number_unknowns();
  void make_maps();
  SparseMatrix make_rows();
  std::shared_ptr<const AssemblyFactor> factorise(SparseMatrix rows,
                                                  const std::shared_ptr<const AssemblyFactor>& before) const;
  SparseMatrix whole_matrix() const;
  double usual_stiffness() const;
  const Node& node(int part, int i) const { return nodes_[node_of_[part][i]]; }
  Vec3 held_velocity(int part, int i, const std::vector<double>& motions) const;
  Vec3 held_velocity(const Port& port, const std::vector<double>& motions) const;
  Vec3 residual_force(const Port& port) const;
  void prescribe(const std::vector<double>& motions, const std::vector<Points>& displacement);

  const StepModel* model_;
  std::vector<AssembledPiece*> pieces_;
  std::vector<Node> nodes_;
  std::vector<std::vector<int>> node_of_;  // of each piece's nodes, index in nodes_
  std::vector<int> node_of_unknown_;
  std::vector<SparseMatrix> matrix_, map_;  // of each piece: matrix, and its free unknowns from the global ones
  std::vector<Vec> prescribed_;             // velocities of each piece's free unknowns that z does not give
  std::vector<std::array<int, 3>> rows_;
  int n_ = 0;
  std::shared_ptr<const AssemblyFactor> made_;
  std::vector<Vec> velocity_;  // of each piece's free unknowns
  Vec held_rate_, free_rate_, rhs_;
};

}  // namespace dygita
