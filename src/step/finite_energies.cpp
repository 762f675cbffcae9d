#include "step/finite_energies.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace dygita {

namespace {

std::string owner(const StepModel& model, const State& state, const std::vector<IncrementEnergy>& pieces) {
  const auto piece = std::find_if(pieces.begin(), pieces.end(), [](const IncrementEnergy& e) {
    return !std::isfinite(e.kinetic + e.strain + e.loads + e.friction + e.plastic + e.damping + e.scheme + e.stored);
  });
  if (piece != pieces.end()) {
    const int part = model.cut->piece(static_cast<int>(piece - pieces.begin())).part;
    return "substructure '" + model.problem->substructures[static_cast<size_t>(part)]->name + "'";
  }
  const auto surface = std::find_if(state.surfaces.begin(), state.surfaces.end(), [](const SurfaceState& s) {
    const Work work = s.work();
    return !std::isfinite(work.dissipated() + work.stored);
  });
  if (surface != state.surfaces.end())
    return "interface '" + (*model.surfaces)[static_cast<size_t>(surface - state.surfaces.begin())].name() + "'";
  return "the assembly";
}

}  // namespace

void check_energies(const StepModel& model, const State& state, const std::vector<IncrementEnergy>& pieces,
                    int increment) {
  const Energies& e = state.energies;
  if (std::isfinite(e.kinetic + e.strain + e.loads + e.friction + e.plastic + e.damping + e.scheme + e.stored)) return;
  throw NumericalError(
      fmt::format("step '{}', increment {} (t = {:.6g} s): the energies of {} are not finite; likely cause: a load out "
                  "of proportion",
                  model.step->name, increment + 1, state.time, owner(model, state, pieces)));
}

}  // namespace dygita
