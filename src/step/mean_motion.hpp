// Motions that a static step leaves free, weighed with the masses that make them (manual, free rigid motions).
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "exchange/rigid_motions.hpp"
#include "interfaces/loads.hpp"
#include "pieces/body.hpp"
#include "pieces/piece.hpp"
#include "step/solver_figures.hpp"

namespace dygita {

// The answer is the one in which the masses, on the whole, have no part in what is free.
class MeanMotion {
 public:
  MeanMotion() = default;  // nothing is free
  // Collective. bodies: of the pieces.
  MeanMotion(FreeMotions free, CutPtr cut, const std::vector<Body>& bodies);

  // Collective. Takes the mean off the increment that the pieces have finished. here: those that are solved here.
  void take_off(const std::vector<std::unique_ptr<Piece>>& pieces, const std::vector<int>& here) const;
  bool is_whole_free() const { return free_.whole.cols() > 0; }

 private:
  bool moves(int piece) const;
  RigidMotion moment(int piece, const Points& field) const;

  FreeMotions free_;
  CutPtr cut_;
  std::vector<std::shared_ptr<const Mass>> masses_;
  Mat inverse_;  // of the motions' kinetic energies, twice; 1/kg
};

// The inertia of what is free, something at least, opposes the loads of a static step.
class InertiaRelief {
 public:
  InertiaRelief(const Problem& problem, const FreeMotions& free, const InertiaForce& inertia, Loads& loads);
  // Of the whole, by the loads as last evaluated.
  RigidAcceleration acceleration(const Loads& loads) const;

 private:
  Vec3 centre_ = Vec3::Zero();  // m, of mass
  Mat whole_;                   // 6 x motions, of the whole by a unit of each motion: linear, angular
};

// Throws InputError where, in some increment, loads drive what is free. Evaluates the loads.
void check_loads(const Problem& problem, const Step& step, const FreeMotions& free, Loads& loads);

}  // namespace dygita
