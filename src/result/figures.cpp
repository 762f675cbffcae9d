#include "result/figures.hpp"

#include "base/error.hpp"

namespace dygita {

namespace {

struct Labelled {
  Figure figure;
  const char* label;
};

constexpr Labelled labels[] = {
    {&Figures::energy_imbalance, "energy imbalance [%]"},
    {&Figures::numerical_dissipation, "energy dissipated by the scheme [%]"},
    {&Figures::energy_gain, "energy created by the scheme [%]"},
    {&Figures::static_imbalance, "energy imbalance, static [%]"},
    {&Figures::static_dissipation, "energy dissipated by the scheme, static [%]"},
    {&Figures::static_gain, "energy created by the scheme, static [%]"},
    {&Figures::largest_energy, "largest energy [J]"},
    {&Figures::energy_of_motion, "energy of the motion [J]"},
    {&Figures::largest_penetration, "largest penetration [m]"},
    {&Figures::gap_difference, "largest difference between the interface gap and the displacements' [m]"},
    {&Figures::factor_memory, "memory of factors and interface operators [MB]"},
    {&Figures::iteration_error, "error estimate, iteration [%]"},
    {&Figures::time_step_error, "error estimate, time step [%]"},
    {&Figures::mesh_error, "error estimate, mesh [%]"},
    {&Figures::penalty_error, "error estimate, penalty [%]"},
    {&Figures::step_frequency_error, "error estimate, frequency, time step [%]"},
    {&Figures::mesh_frequency_error, "error estimate, frequency, mesh [%]"},
    {&Figures::mesh_amplitude_error, "error estimate, amplitude, mesh [%]"},
    {&Figures::static_iteration_error, "error estimate, static, iteration [%]"},
    {&Figures::static_mesh_error, "error estimate, static, mesh [%]"},
    {&Figures::interface_error, "interface constitutive-relation error [J]"},
    {&Figures::static_interface_error, "interface constitutive-relation error, static [J]"},
    {&Figures::mean_frequency, "mean frequency of the motion [Hz]"},
    {&Figures::yield_margin, "smallest margin against yield [1]"},
    {&Figures::failure_index, "largest failure index [1]"},
    {&Figures::passes, "passes over the run"},
    {&Figures::iterations_of_passes, "iterations of all passes"},
    {&Figures::spectra_moved, "spectra moved in the last pass [dB]"},
    {&Figures::largest_slip, "largest slip [contact cells]"},
    {&Figures::largest_rotation, "largest rotation [degrees]"},
    {&Figures::state_file, "state file [MB]"},
    {&Figures::earlier_iterations, "iterations before the run was continued"},
    {&Figures::fields_in_memory, "interface fields kept in memory [MB]"},
    {&Figures::fields_in_file, "interface fields kept in a file [MB]"},
    {&Figures::substitutions, "substitutions"},
    {&Figures::substitutions_spared, "substitutions spared where nothing changed"},
    {&Figures::pieces_in_full, "pieces solved in full at each iteration, over all steps"},
    {&Figures::shared_factors, "substructures that share another's factor, over all steps"},
    {&Figures::hourglass_energy, "largest hourglass energy [%]"},
    {&Figures::substeps, "explicit substeps per step"},
    {&Figures::critical_step, "critical time step [s]"},
};
static_assert(sizeof(Figures) == std::size(labels) * sizeof(std::optional<double>), "every figure has a label");

}  // namespace

const char* label(Figure figure) {
  for (const Labelled& entry : labels)
    if (entry.figure == figure) return entry.label;
  CHECK(false, "a figure without a label");
  return "";
}

std::map<std::string, double> by_label(const Figures& figures) {
  std::map<std::string, double> found;
  for (const Labelled& entry : labels)
    if (const std::optional<double>& value = figures.*entry.figure) found[entry.label] = *value;
  return found;
}

}  // namespace dygita
