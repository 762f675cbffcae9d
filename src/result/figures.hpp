// What a run was, in figures: every one with the name under which the run record states it, unit included, said once.
#pragma once

#include <map>
#include <string>

#include "step/solver_figures.hpp"

namespace dygita {

// Empty: the run has none of it.
struct Figures : OwnFigures {
  // %, of the energy of the motion; where there is none, of the largest energy of the static steps.
  std::optional<double> energy_imbalance, numerical_dissipation, energy_gain;
  // The same of the static steps of a run with both.
  std::optional<double> static_imbalance, static_dissipation, static_gain;
  std::optional<double> largest_energy;       // J, with what static steps have stored
  std::optional<double> energy_of_motion;     // J
  std::optional<double> largest_penetration;  // m
  std::optional<double> gap_difference;       // m, between the interfaces' gaps and the displacements'
  std::optional<double> factor_memory;        // MB
  // The run's own estimates (manual, eq. Q1-Q6), %, energy norm, of the shock or of the static steps.
  std::optional<double> iteration_error, time_step_error, mesh_error, penalty_error;
  std::optional<double> static_iteration_error, static_mesh_error;
  std::optional<double> step_frequency_error, mesh_frequency_error, mesh_amplitude_error;  // apart (eq. Q14), %
  std::optional<double> interface_error, static_interface_error;                           // J
  std::optional<double> mean_frequency;                                                    // Hz
  std::optional<double> passes, iterations_of_passes;
  std::optional<double> spectra_moved;  // dB, in the last pass
  std::optional<double> largest_slip,
      largest_rotation;                      // contact cells, degrees; where small displacements do not hold
  std::optional<double> state_file;          // MB
  std::optional<double> earlier_iterations;  // before the run was continued
  std::optional<double> yield_margin;   // yield / von Mises - 1, the smallest of the parts whose material has a yield
  std::optional<double> failure_index;  // the largest of the parts whose material has strengths
};

// One of them: `&Figures::energy_imbalance`.
using Figure = std::optional<double> Figures::*;

// "energy imbalance [%]".
const char* label(Figure figure);

// What the run has, by label.
std::map<std::string, double> by_label(const Figures& figures);

}  // namespace dygita
