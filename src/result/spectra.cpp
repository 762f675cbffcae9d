#include "result/spectra.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <map>

#include "model/check.hpp"

namespace dygita {

SrsSettings srs_settings(const Arguments& arguments) {
  static const std::map<std::string, SrsQuantity> quantities = {
      {"absolute_acceleration", SrsQuantity::absolute_acceleration},
      {"relative_displacement", SrsQuantity::relative_displacement},
      {"pseudo_velocity", SrsQuantity::pseudo_velocity}};
  SrsSettings srs{arguments.number_or("q_factor", 10.0), arguments.number("from"), arguments.number("to"),
                  arguments.integer("per_octave"), quantities.at(arguments.text("quantity"))};
  if (arguments.has("damping")) {
    if (arguments.has("q_factor"))
      throw InputError("'q_factor' and 'damping' are the same quantity: leave one out (Q = 1 / (2 damping))");
    srs.q_factor = q_factor_of(arguments.number("damping"));
  }
  if (srs.from >= srs.to)
    throw InputError(fmt::format("'from' = {:g} Hz is not below 'to' = {:g} Hz", srs.from, srs.to));
  return srs;
}

std::string spectrum_unit(const SrsSettings& settings) { return srs_unit(settings.quantity, "m/s^2"); }

void check_spectrum(const Problem& problem, const Output& output) {
  if (!check::has_dynamic_step(problem))
    check::fail(problem, output.origin, output.known_as() + ": the problem has no dynamic step",
                "a spectrum is of dynamic steps only");
}

Srs spectrum_of(const Problem& problem, const SrsSettings& settings, const Table& history, size_t column) {
  std::vector<double> time, value;
  double dt = 0.0;
  for (int i = 0; i < history.n_rows(); ++i) {
    const Step& step = *problem.steps[history.step[i]];
    if (step.is_static) continue;
    time.push_back(history.columns[0][i]);
    value.push_back(history.columns[column][i]);
    dt = dt == 0.0 ? step.dt : std::min(dt, step.dt);
  }
  if (time.empty()) return {};
  return shock_response_spectrum(evenly(time, value, dt), dt, settings);
}

FrequencyRange judged_by(const Problem& problem, const Table& history) {
  double record = 0.0, longest = 0.0;
  for (const int i_step : history.step) {  // of each row, one an increment
    const Step& step = *problem.steps[static_cast<size_t>(i_step)];
    if (step.is_static) continue;
    record += step.dt;
    longest = std::max(longest, step.dt);
  }
  return reliable_range(record, longest);
}

std::vector<double> evenly(const std::vector<double>& time, const std::vector<double>& value, double dt) {
  std::vector<double> signal;
  size_t i = 0;
  for (long s = 0; time.front() + s * dt <= time.back() + 1e-6 * dt; ++s) {
    const double t = time.front() + s * dt;
    while (i + 2 < time.size() && time[i + 1] <= t) ++i;
    const double x = i + 1 < time.size() ? std::clamp((t - time[i]) / (time[i + 1] - time[i]), 0.0, 1.0) : 0.0;
    signal.push_back(value[i] + x * ((i + 1 < value.size() ? value[i + 1] : value[i]) - value[i]));
  }
  return signal;
}

}  // namespace dygita
