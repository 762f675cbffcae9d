#include "latin/step_data.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"

namespace dygita {

namespace {

// One by one: Eigen's root of eight numbers at once (AVX-512) has other last digits than that of one, so that what an
// unknown gets would depend on where it stands among those of its rank.
double inverse_root(double k) { return 1.0 / std::sqrt(k); }

}  // namespace

StepData::StepData(const StepSettings& of_step, StepModel& operators, const Vec& k, const RunFiles& run_files)
    : settings(of_step),
      files(run_files),
      model(operators),
      iterates_roughly(settings.n_inner > 0 &&
                       ranks::any(std::any_of(model.here.begin(), model.here.end(),
                                              [&](int i) { return model.pieces[i]->has_rough_operator(); }))),
      weight(model.near.part(k).head(model.near.n_own()).unaryExpr(&inverse_root)),
      local(model, files.state, model.near.part(k)),
      at{local.initial_q(), Vec::Zero(model.near.n()), {}, {}},
      indicator(model.scheme.is_static ? k.sum() * settings.assembly_size * settings.assembly_size : 0.0,
                settings.is_assembled ? 1e-1 : 1e-2),
      loops(model),
      energy(model.pieces.size()) {
  const Energies& energies = files.state.energies;
  const double before = energies.held() + std::abs(energies.loads);
  if (model.scheme.is_static)
    indicator.start_from(before);
  else if (before > energies.kinetic)
    indicator.start_motion(before, model.scheme.dt, settings.tolerance);
}

Goal StepData::goal(bool has_start) const {
  const double furthest = local.has_preloads()     ? settings.assembly_size
                          : model.scheme.is_static ? too_far * settings.assembly_size
                                                   : 0.0;
  if (settings.more_iterations == 0 || !has_start) return {settings.tolerance, settings.limit, furthest};
  const int most = 1 + settings.more_iterations;
  return {settings.round_off, {most, most}, furthest};
}

// Where all pieces are in one system, every rank has all of them.
double StepData::largest_velocity() const {
  const int n = model.near.n_own();
  const double own = n > 0 ? at.velocity.head(n).cwiseAbs().maxCoeff() : 0.0;
  return settings.is_assembled ? own : ranks::largest(own);
}

void StepData::check_finite(const Outcome& outcome, int increment) const {
  if (std::isfinite(outcome.eta) && std::isfinite(outcome.size)) return;
  throw NumericalError(
      fmt::format("step '{}', increment {} (t = {:.6g} s): the iteration has diverged{}; likely cause: a load, "
                  "search direction, stiffness or density out of proportion, or a time step far too large",
                  model.step->name, increment + 1, files.state.time, place_of_divergence()));
}

std::string StepData::place_of_divergence() const {
  const Exchange& exchange = model.exchange;
  const Port* worst = nullptr;
  const Point* meeting = nullptr;
  double largest = -1.0;
  for (const int i : model.near.points()) {
    const Point& point = exchange.points[static_cast<size_t>(i)];
    for (int p = point.first_port; p < point.end_port && std::isfinite(largest); ++p)
      for (int d = 0; d < 3; ++d) {
        const int unknown = model.unknown(exchange.ports[p], d);
        const double size = unknown < 0 || unknown >= at.velocity.size() ? -1.0 : std::abs(at.velocity[unknown]);
        if (size <= largest) continue;
        largest = std::isfinite(size) ? size : std::numeric_limits<double>::infinity();
        worst = &exchange.ports[p];
        meeting = &point;
      }
  }
  std::string place;
  if (worst) place = fmt::format(" at substructure '{}'", model.problem->substructures[worst->part]->name);
  if (worst && !meeting->members.empty())
    place += fmt::format(", interface '{}'", (*model.surfaces)[meeting->members.front().surface].name());
  if (model.near.is_all()) return place;
  // Of the first rank where it is largest.
  const std::vector<std::vector<double>> of_all = ranks::of_all({largest});
  const auto first = std::max_element(of_all.begin(), of_all.end());
  const std::vector<std::string> places = ranks::gathered(place);
  return ranks::shared(places.empty() ? "" : places[static_cast<size_t>(first - of_all.begin())]);
}

}  // namespace dygita
