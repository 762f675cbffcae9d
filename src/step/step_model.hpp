// Everything of one step that does not change while it is iterated: conditions, exchange, loads and factorised pieces.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "exchange/exchange.hpp"
#include "exchange/near_unknowns.hpp"
#include "interfaces/loads.hpp"
#include "interfaces/state.hpp"
#include "pieces/piece.hpp"
#include "step/bodies.hpp"
#include "step/integration.hpp"
#include "step/mean_motion.hpp"

namespace dygita {

// The undeformed state at rest, of pieces or of whole substructures.
State initial_state(const Problem& problem, const std::vector<Surface>& surfaces, const Cut& cut);
State initial_state(const Problem& problem, const std::vector<Surface>& surfaces);

struct StepModel {
  const Problem* problem = nullptr;
  const Step* step = nullptr;
  const std::vector<Surface>* surfaces = nullptr;
  TimeScheme scheme;
  Conditions conditions;
  CutPtr cut;
  Exchange exchange;
  std::unique_ptr<Loads> loads;
  std::vector<std::unique_ptr<Piece>> pieces;
  std::vector<int> here;                // pieces that this rank solves; the others are solved elsewhere
  ranks::Segments unknowns;             // of all pieces, of which each rank knows its own
  NearUnknowns near;                    // iterated points and unknowns of this rank
  std::vector<std::vector<int>> equal;  // pieces that share a factor and are solved together, at most 16 in a group
  Integration integration;              // of the pieces
  bool is_assembled = false;            // the pieces are not factorised one by one; every rank solves all
  std::vector<Body> assembled_bodies;   // then, of several ranks: with the matrices of pieces elsewhere
  std::vector<int> offset;              // of each piece in the assembled q; the last entry is its length

  int n_q() const { return offset.back(); }
  bool solves(int piece) const { return is_assembled || cut->is_here(piece); }
  // Increments in each time step of the deck: the scheme's dt is that of one.
  int n_substeps() const { return integration.n_substeps; }
  bool has_explicit() const { return integration.has_explicit(); }
  // Index in the assembled q of a port's direction; -1 where it has none.
  int assembled_unknown(const Port& port, int d) const {
    return port.unknown[d] < 0 ? -1 : offset[port.piece] + port.unknown[d];
  }
  // The same among the near unknowns, for ports of near points.
  int unknown(const Port& port, int d) const {
    const int assembled = assembled_unknown(port, d);
    return assembled < 0 ? -1 : near.at(assembled);
  }
  // Do inner iterations follow each iteration (manual, eq. A5)?
  bool has_inner_iterations() const;
  // Is the mass of all cells tuned to the time scheme? That of explicit ones is not where laws act.
  bool is_tuned() const;
  // By how much the time scheme turns a motion, of what trapezoidal steps of the deck's dt would (manual, eq. Q2):
  // explicit increments turn it half as much, but contact in them adds its own.
  double phase_factor() const;
  // What a static step has to tell of what is free, once its last increment is done.
  FreeStep what_is_free() const;
  // Velocities of all motions at the end of an increment.
  std::vector<double> motion_velocities(int increment) const;
  // Velocity of a held direction of a port, from the motions' velocities.
  double held_velocity(const Port& port, const Vec3& direction, const std::vector<double>& motions) const;
  // External forces on a substructure (3 x n_nodes, N) as the loads were last evaluated, absorbing supports' anchors
  // included.
  Points external_force(int part, const State& state) const;
  // The same on a piece: on the copies that own their node.
  Points piece_force(int piece, const State& state) const;
  // What absorbing supports keep of it in dynamic steps.
  Points piece_anchor(int piece, const State& state) const;

  // Force (N, 3 x n_nodes) of supports and prescribed motions on a substructure in the last increment.
  Points reactions(int part, const State& state) const;

  // The same of a piece.
  Points reactions_of(int piece, const State& state) const;

  // Nodes of a load pattern that a piece of a cut substructure owns; the other pieces need none.
  struct PieceLoad {
    size_t pattern;
    std::vector<std::pair<int, Vec3>> nodes;
  };
  std::vector<std::vector<PieceLoad>> piece_loads;  // of each piece
  MeanMotion mean;                                  // of what is free in a static step
  std::optional<InertiaRelief> relief;              // of its loads, where it asks for that
};

// May one system of all parts solve the static steps of a problem: does the deck leave it to the program, and is it
// not too large?
bool fits_in_one(const Problem& problem);

// Builds and factorises; pieces side by side on the threads at hand. bodies: of the pieces. Throws InputError,
// NumericalError. In static steps that the solver assembles the pieces are not factorised.
StepModel make_step_model(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces,
                          const std::vector<Body>& bodies, const State& start, const CutPtr& cut);
// The same over what runs share.
class SharedOperators;
StepModel make_step_model(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces,
                          const State& start, const SharedOperators& operators);
// Builds only, for a solver that factorises the substructures together: one piece each.
StepModel make_assembled_model(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces,
                               const std::vector<Body>& bodies, const State& start);

// Memory (bytes) that a step's pieces will hold, and its interface unknowns; nothing is factorised.
struct StepSize {
  double bytes = 0.0;
  long n_unknowns = 0;
  Integration integration;
};
StepSize predict_step(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces,
                      const std::vector<Body>& bodies, const State& start, const CutPtr& cut);

// Force of all interfaces on the nodes of a substructure (3 x n_nodes, N), from the surfaces' state.
Points interface_force(const Problem& problem, const std::vector<Surface>& surfaces, const State& state, int part);

}  // namespace dygita
