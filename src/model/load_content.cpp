#include "model/load_content.hpp"

#include <algorithm>
#include <limits>

#include "model/effects.hpp"
#include "signal/spectrum.hpp"

namespace dygita {

namespace {

constexpr double share = 0.95;  // of a load's energy

bool is_listed(const LoadPtr& load, const Step* step) {
  return step && std::find(step->loads.begin(), step->loads.end(), load) != step->loads.end();
}

template <typename Kind>
bool has_effect(const Load& load) {
  for (const Effect& effect : load.effects())
    if (std::holds_alternative<Kind>(effect)) return true;
  return false;
}

bool is_steady_force(const Load& load) {
  for (const Effect& effect : load.effects())
    if (const auto* force = std::get_if<NodalForces>(&effect))
      if (force->value.history.is_constant() && force->value.history.value(0.0) != 0.0) return true;
  return false;
}

bool is_first_in_motion(const Step& step) {
  for (const Step* before = step.after.get(); before; before = before->after.get())
    if (!before->is_static) return false;
  return true;
}

// Some substructures move against others.
bool meet_at_speed(const Problem& problem) {
  return std::any_of(problem.substructures.begin(), problem.substructures.end(), [&](const SubstructurePtr& part) {
    return part->velocity != problem.substructures.front()->velocity;
  });
}

bool begins_with_a_jump(const Problem& problem, const Step& step) {
  if (is_first_in_motion(step) && meet_at_speed(problem)) return true;
  const Step* before = step.after.get();
  if (before && step.supports != before->supports) return true;
  for (const LoadPtr& load : step.loads)
    if (has_effect<Release>(*load) || (is_steady_force(*load) && !is_listed(load, before))) return true;
  if (!before || !before->is_static) return false;
  return std::any_of(before->loads.begin(), before->loads.end(),
                     [&](const LoadPtr& load) { return has_effect<NodalForces>(*load) && !is_listed(load, &step); });
}

}  // namespace

double load_frequency(const Load& load, const Step& step) {
  double highest = 0.0;
  for (const auto& value : load.values) {
    if (!value || value->history.is_constant()) continue;
    const int n = std::clamp(4 * step.n_increments(), 256, 2048);
    std::vector<double> samples(n + 1);
    for (int i = 0; i <= n; ++i) samples[i] = value->history.value(step.duration * i / n);
    highest = std::max(highest, band_limit(samples, step.duration / n, share));
  }
  return highest;
}

double brought_frequency(const Problem& problem, const Step& step) {
  if (begins_with_a_jump(problem, step)) return std::numeric_limits<double>::infinity();
  double highest = 0.0;
  for (const LoadPtr& load : step.loads) highest = std::max(highest, load_frequency(*load, step));
  return highest;
}

}  // namespace dygita
