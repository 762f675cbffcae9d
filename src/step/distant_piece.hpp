// What a rank has of a piece that another one solves: nothing but ways to ask for it. Only rank 0 asks, for results.
#pragma once

#include <memory>
#include <span>

#include "pieces/body.hpp"
#include "pieces/explicit_nodes.hpp"
#include "pieces/piece.hpp"
#include "ranks/ranks.hpp"

namespace dygita {

struct StepModel;

class DistantPiece : public Piece {
 public:
  // rank: who has it; mass: of its body, which outlives it.
  DistantPiece(int piece, int rank, const Mass& mass, bool has_motions);

  const std::vector<InterfaceRow>& rows() const override { return rows_; }
  const Vec& node_masses() const override { return none_; }  // nobody asks for those of a piece elsewhere
  double mass() const override { return mass_->all; }
  bool is_here() const override { return false; }
  const Vec& unknown_masses() const override;
  Points unknown_directions() const override;
  bool is_massless(int node) const override { return !mass_->is_massless.empty() && mass_->is_massless[node] != 0; }
  bool has_motions() const override { return has_motions_; }
  Points elastic_force(const Points& displacement) const override;
  const Vec& schur_diagonal() const override { return none_; }
  void set_search_directions(const Vec& /*k*/) override {}
  const Vec& k() const override { return none_; }
  Mat row_compliance(const std::vector<int>& /*columns*/) const override { return {}; }

  void set_state(const Points&, const Points&, const Points&, const Points&) override {}
  Points velocity_of_impulse(const Points&) const override { return {}; }
  const PieceState& state() const override;
  void restore(const PieceState& /*state*/) override {}
  IncrementEnergy stored_energy() const override { return {}; }
  void begin(const Points&, const std::vector<double>&, double) override {}
  void interface_velocity(Eigen::Ref<const Vec>, Eigen::Ref<Vec>) override {}
  IncrementEnergy finish(Eigen::Ref<const Vec>, const Points*) override { return {}; }

  Points displacement() const override;
  Points velocity() const override;
  Points acceleration() const override;
  Points displacement(const std::vector<int>& nodes) const override { return ask_at(u, nodes); }
  Points velocity(const std::vector<int>& nodes) const override { return ask_at(v, nodes); }
  Points acceleration(const std::vector<int>& nodes) const override { return ask_at(a, nodes); }
  Vec row_displacements() const override { return {}; }
  Points reactions(const Points& interface_force) const override;
  Points absorbing_force() const override;
  PieceFigures figures() const override { return {}; }

 private:
  enum What { u, v, a, force_of_u, held, absorbed, state_v, masses, directions };
  friend std::vector<double> answer_for(const Piece& piece, int what, std::span<const double> with);
  std::vector<double> ask(What what, std::span<const double> with = {}) const;
  // At some nodes alone.
  Points ask_at(What what, const std::vector<int>& nodes) const;
  Points ask_nodal(What what, std::span<const double> with = {}) const;

  int piece_, rank_;
  const Mass* mass_;
  bool has_motions_;
  Vec none_;
  std::vector<InterfaceRow> rows_;
  mutable Vec unknown_masses_;
  mutable PieceState shown_;
};

// What rank 0 has asked for, of a piece that is here.
std::vector<double> answer_for(const Piece& piece, int what, std::span<const double> with);

// The nodes of an explicit piece elsewhere that laws solved in closed form act on.
class DistantNodes final : public DistantPiece, public ExplicitNodes {
 public:
  // nodes: of the piece, increasing; dt: increment, s.
  DistantNodes(DistantPiece piece, std::vector<int> nodes, double dt);
  bool is_explicit() const override { return true; }
  ExplicitNodes* explicit_nodes() override { return this; }
  int index_of(int node) const override;
  Mat3 node_compliance(int index) const override { return compliances_[static_cast<size_t>(index)]; }
  void set_compliance(int index, const Mat3& compliance) override {
    compliances_[static_cast<size_t>(index)] = compliance;
  }

 private:
  std::vector<int> nodes_;
  std::vector<Mat3> compliances_;
};

// Collective. Puts one in the place of every piece that is on another rank.
void add_distant(const StepModel& model, const std::vector<Body>& bodies, std::vector<std::unique_ptr<Piece>>& pieces);

}  // namespace dygita
