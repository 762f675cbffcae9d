// An explicit piece as steps see it, beside what any piece can: a node answers to a force on it at once, and to no
// other.
#pragma once

#include "pieces/explicit_nodes.hpp"
#include "pieces/piece.hpp"

namespace dygita {

class ExplicitPiece : public Piece, public ExplicitNodes {
 public:
  bool is_explicit() const final { return true; }
  ExplicitPiece* as_explicit() final { return this; }
  ExplicitNodes* explicit_nodes() final { return this; }

  // External forces of a step without a field of them in every increment: forces (3 x n_nodes, N) that stay, and those
  // of load patterns (index, force for a value of one at nodes of the piece).
  struct PatternLoad {
    size_t pattern;
    std::vector<std::pair<int, Vec3>> nodes;
  };
  virtual void set_loads(const Points& constant, const std::vector<PatternLoad>& loads) = 0;
  // An increment, for values of all patterns of the step and velocities of the motions at its end.
  using Piece::begin;
  virtual void begin(const std::vector<double>& load_values, const std::vector<double>& motion_velocity) = 0;
  // The same in two halves: what pulls at the nodes (N), and what it does to them. In between nodes on cuts and ties,
  // those of `share_pulls`, are given their shares of what pulls at all that move as they do, which their neighbours
  // feel where the mass is tuned: in every increment, in the field that it returns (3 x nodes).
  virtual void begin_pull(const std::vector<double>& load_values) = 0;
  virtual Vec3 pull_at(int node) const = 0;
  virtual Points& share_pulls(std::vector<int> nodes) = 0;
  virtual void begin_motion(const std::vector<double>& motion_velocity) = 0;

  // Forces (N) of laws on held directions of a node, in the increment at hand.
  virtual bool has_held(int node) const = 0;
  virtual void add_held_force(int node, const Vec3& force) = 0;

  // The tuned mass (manual, eq. S13): is there one? C V on free directions (3 x n_nodes), and the momenta M Z.
  virtual bool is_tuned() const = 0;
  virtual Points coupled(const Points& velocity) const = 0;
  virtual void set_momenta(const Points& z) = 0;
};

}  // namespace dygita
