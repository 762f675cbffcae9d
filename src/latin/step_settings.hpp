// What a step asks of the method, with the defaults of the manual's table where the deck says nothing.
#pragma once

#include "latin/persistence.hpp"
#include "step/step_model.hpp"

namespace dygita {

struct StepSettings {
  int i_step = 0;  // in the problem's steps
  double tolerance = 1e-6;
  IterationLimit limit;  // of an increment, or of a window
  // From kept fields: so many iterations more, down to rounding errors, whatever the tolerance; 0: as tolerance asks.
  int more_iterations = 0;
  double round_off = 1e-13;     // indicator below which iterations change rounding errors only
  int window = 1;               // time steps; 1 in a static step
  double assembly_size = 0.0;   // m
  bool has_correction = false;  // coarse
  int n_inner = 0;              // inner iterations after each: an even number (manual, A5)
  bool is_assembled = false;    // static, all pieces in one system
  struct Acceleration {
    int depth, n_problems;  // see Anderson
    double relaxation;
  } of_increment{}, of_window{};
};

StepSettings step_settings(const Problem& problem, const StepModel& model, bool has_start);

}  // namespace dygita
