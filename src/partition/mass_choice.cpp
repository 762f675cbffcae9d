#include "partition/mass_choice.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fem/mass.hpp"
#include "model/load_content.hpp"

namespace dygita {

namespace {

constexpr double most_phase = 0.1;               // rad
constexpr double fewest_cells_a_wavelength = 5;  // of what a mesh carries
constexpr double most_on_interfaces = 0.5;

bool is_of_bricks(const Mesh& mesh) {
  return !has_consistent_mass(mesh) && std::all_of(mesh.blocks.begin(), mesh.blocks.end(), [](const CellBlock& block) {
    return cell_shape(block.type).cells_per_brick == 1;
  });
}

}  // namespace

std::vector<double> brought_frequencies(const Problem& problem) {
  std::vector<double> brought;
  for (const StepPtr& step : problem.steps)
    brought.push_back(step->is_static ? 0.0 : brought_frequency(problem, *step));
  return brought;
}

double phase_of_lumped_mass(const Problem& problem, const std::vector<double>& brought, const Substructure& part) {
  if (!part.mesh->has_cells()) return 0.0;
  const double h = std::cbrt(volume(*part.mesh) / part.mesh->n_cells()), speed = part.material.s_wave_speed();
  const double highest = speed / (fewest_cells_a_wavelength * h);
  double phase = 0.0;
  for (size_t i = 0; i < problem.steps.size(); ++i) {
    const double w = 2.0 * std::numbers::pi * std::min(highest, brought[i]);
    phase += w * problem.steps[i]->duration * std::pow(w / speed * h, 2) / 24.0;
  }
  return phase;
}

bool wants_tuned_mass(const Substructure& part, double phase, double interface_share) {
  return phase > most_phase && why_lumped(part, phase, interface_share).empty();
}

std::string why_lumped(const Substructure& part, double phase, double interface_share) {
  if (phase <= most_phase) return "";
  if (!is_of_bricks(*part.mesh)) return "its cells are no hexahedra of order one";
  if (!part.material.is_isotropic()) return "its waves have other speeds in other directions";
  return interface_share < most_on_interfaces ? "" : "half of its nodes or more have laws";
}

bool may_be_tuned(const Problem& problem, const std::vector<double>& brought, const Substructure& part) {
  if (part.integration.value_or(problem.solver.integration) == IntegrationChoice::implicitly) return false;
  const MassSettings mass = problem.mass();
  if (!mass.is_chosen) return mass.is_tuned && is_of_bricks(*part.mesh) && part.material.is_isotropic();
  return wants_tuned_mass(part, phase_of_lumped_mass(problem, brought, part), 0.0);
}

std::vector<std::string> tuned_by_choice(const Problem& problem) {
  std::vector<std::string> names;
  if (!problem.mass().is_chosen) return names;
  const std::vector<double> brought = brought_frequencies(problem);
  for (const SubstructurePtr& part : problem.substructures)
    if (may_be_tuned(problem, brought, *part)) names.push_back(part->name);
  return names;
}

}  // namespace dygita
