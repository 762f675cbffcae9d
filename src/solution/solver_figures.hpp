// What a solver tells of a run.
#pragma once

#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solution/interface_fields.hpp"

namespace dygita {

// An increment that missed the tolerance.
struct Missed {
  int increment = 0, iterations = 0;
  double indicator = 0.0, tolerance = 0.0;
  bool is_falling = false;        // it was still on its way: the later half of the iterations has halved the indicator
  std::optional<double> halving;  // iterations in which it did, lately
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

struct SolverFigures {
  std::vector<StepFigures> steps;
  std::shared_ptr<const InterfaceFields> interface_fields;  // null: the solver keeps none
  bool interrupted = false;                                 // by the user, or by
  std::exception_ptr stopped_by;                            // an error; null: none
  std::vector<int> pieces;  // into which each substructure was cut; empty: the solver cuts none
  long n_dofs = 0, n_interface_unknowns = 0;
  long n_solved = 0, n_spared = 0;        // substitutions, and those spared because nothing had changed
  int n_in_full = 0;                      // pieces solved in full at each iteration, summed over the steps
  int n_equal = 0;                        // pieces that use another one's factor, summed over the steps
  double factor_bytes = 0.0;              // factors and interface operators of the largest step
  double gap_difference = 0.0;            // m, largest between the laws' gaps and the displacements'
  OwnFigures own;                         // for the run record
  std::map<std::string, double> seconds;  // by phase: set up, linear, iterate, output
};

}  // namespace dygita
