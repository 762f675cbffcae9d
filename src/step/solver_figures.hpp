// What a solver reports of a run.
#pragma once

#include <array>
#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "interfaces/interface_fields.hpp"

namespace dygita {

// An increment that missed the tolerance.
struct Missed {
  int increment = 0, iterations = 0;
  double indicator = 0.0, tolerance = 0.0;
  bool is_falling = false;        // it was still on its way: the later half of the iterations has halved the indicator
  std::optional<double> halving;  // iterations in which it did, lately
};

// Of an assembly as one rigid body.
struct RigidAcceleration {
  Vec3 centre = Vec3::Zero();                          // m, of mass
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();  // m/s^2, of the centre; rad/s^2
};

// What a static step has left free.
struct FreeStep {
  bool is_whole = false;                    // nothing holds the assembly
  std::optional<RigidAcceleration> relief;  // by the loads, in the last increment; none: inertia is not asked for
};

// What a run was, step by step.
struct StepFigures {
  int increments = 0, not_converged = 0;
  std::vector<Missed> missed;  // of solvers that tell
  long iterations = 0;
  double worst_indicator = 0.0;  // largest accepted
  double seconds = 0.0;
  std::vector<std::string> explicit_parts;  // substructures integrated explicitly
  int substeps = 1;                         // increments in each time step of the deck
  double stable_step = 0.0;                 // s, longest increment that they are stable with; 0: there are none
  std::vector<std::string> diagonal_parts;  // of those, with cells of order two, whose mass is a diagonal there
  std::vector<std::string> tuned_parts;     // of those, whose mass is tuned
  // Of those, where the program chose: by how much lumped mass would keep waves back, rad (manual, eq. S15).
  std::vector<std::pair<std::string, double>> phases;
};

// What only some solvers have to tell; empty: this one has not.
struct OwnFigures {
  std::optional<double> fields_in_memory, fields_in_file;     // MB, of the interface fields kept
  std::optional<double> substitutions, substitutions_spared;  // spared: nothing had changed
  std::optional<double> pieces_in_full;                       // solved in full at each iteration, over all steps
  std::optional<double> shared_factors;                       // substructures that use another's, over all steps
  std::optional<double> hourglass_energy;                     // %, largest
  std::optional<double> substeps;                             // per step, most
  std::optional<double> critical_step;                        // s
};

// What was shared out to several ranks (manual/parallel.md).
struct RankFigures {
  int pieces = 0;
  long unknowns = 0;
  // To neighbours, to all, for results of rank 0; over the run.
  std::array<double, 3> messages{}, bytes{};
  double seconds_waited = 0.0;
  double memory = 0.0, peak_memory = 0.0;  // bytes, resident: when the last step ended, and at most
  double shared_meshes = 0.0;              // bytes of nodes and cells that all ranks of the machine have in common
};
struct SharedPiece {
  int part = 0, rank = 0;  // its substructure; who has it
  long unknowns = 0;
  double seconds = 0.0;                         // of a processor, that it took over all steps
  std::vector<std::pair<int, int>> neighbours;  // other pieces, and how many points it has with each
};
struct Sharing {
  std::vector<RankFigures> ranks;  // empty: one process
  std::vector<SharedPiece> pieces;
};

struct SolverFigures {
  std::vector<StepFigures> steps;
  std::shared_ptr<const InterfaceFields> interface_fields;  // null: the solver keeps none
  bool interrupted = false;                                 // by the user, or by
  std::exception_ptr stopped_by;                            // an error; null: none
  std::vector<int> pieces;  // into which each substructure was cut; empty: the solver cuts none
  long n_dofs = 0, n_interface_unknowns = 0;
  long n_solved = 0, n_spared = 0;  // substitutions, and those spared because nothing had changed
  int n_in_full = 0;                // pieces solved in full at each iteration, summed over the steps
  int n_equal = 0;                  // pieces that use another one's factor, summed over the steps
  double factor_bytes = 0.0;        // factors and interface operators of the largest step
  double gap_difference = 0.0;      // m, largest between the laws' gaps and the displacements'
  OwnFigures own;                   // for the run record
  Sharing sharing;
  std::map<std::string, double> seconds;  // by phase: set up, linear, iterate, output
  std::vector<FreeStep> free;             // of the steps
};

}  // namespace dygita
