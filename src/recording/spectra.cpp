#include "recording/spectra.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "model/places.hpp"
#include "model/refusal.hpp"
#include "result/limits.hpp"

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
      throw InputError("'q_factor' and 'damping' are mutually exclusive: omit one (Q = 1 / (2 damping))");
    srs.q_factor = q_factor_of(arguments.number("damping"));
  }
  srs.taper = arguments.number_or("taper", 0.0);
  if (srs.from >= srs.to)
    throw InputError(fmt::format("'from' = {:g} Hz is not below 'to' = {:g} Hz", srs.from, srs.to));
  return srs;
}

std::string spectrum_unit(const SrsSettings& settings) { return srs_unit(settings.quantity, "m/s^2"); }

void check_spectrum(const Problem& problem, const Output& output, const SrsSettings& settings) {
  if (!has_dynamic_step(problem))
    check::fail(problem, output.origin, output.known_as() + ": the problem has no dynamic step",
                "a spectrum requires a dynamic step");
  double duration = 0.0;
  for (const StepPtr& step : problem.steps) duration += step->is_static ? 0.0 : step->duration;
  if (settings.taper >= duration)
    check::fail(problem, output.origin,
                fmt::format("{}: 'taper' = {:g} s leaves nothing of the {:g} s of the dynamic steps", output.known_as(),
                            settings.taper, duration),
                "it is a time before their end, typically a quarter of their duration");
}

std::vector<EvenStretch> stretches_of(const std::vector<double>& time, const std::vector<double>& dt,
                                      const std::vector<double>& value) {
  constexpr double rounding = 1e-6;
  std::vector<EvenStretch> stretches;
  for (size_t i = 0; i < time.size(); ++i) {
    const EvenStretch* last = stretches.empty() ? nullptr : &stretches.back();
    const bool goes_on = last && std::abs(last->dt - dt[i]) < rounding * dt[i] &&
                         std::abs(last->time(last->values.size()) - time[i]) < 0.5 * dt[i];
    if (!goes_on) stretches.push_back({time[i], dt[i], {}});
    stretches.back().values.push_back(value[i]);
  }
  return stretches;
}

Srs spectrum_of(const Problem& problem, const SrsSettings& settings, const Table& history, size_t column) {
  std::vector<double> time, dt, value;
  for (int i = 0; i < history.n_rows(); ++i) {
    const Step& step = *problem.steps[history.step[i]];
    if (step.is_static) continue;
    time.push_back(history.columns[0][i]);
    value.push_back(history.columns[column][i]);
    dt.push_back(step.dt);
  }
  if (time.empty()) return {};
  return shock_response_spectrum(stretches_of(time, dt, value), settings);
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

EndOfRecord end_of_record(const Problem& problem, const Table& history, size_t column) {
  EndOfRecord end;
  for (int i = 0; i < history.n_rows(); ++i) {
    const Step& step = *problem.steps[history.step[i]];
    if (step.is_static) continue;
    const double change = history.columns[column][i] * step.dt;
    end.displacement += (end.velocity + 0.5 * change) * step.dt;
    end.velocity += change;
    end.length += step.dt;
  }
  return end;
}

namespace {

// Frequencies at which the band is beyond its limit.
struct Doubted {
  double from = 0.0, to = 0.0, worst = 0.0, at = 0.0;  // Hz, Hz, dB, Hz

  void add(double frequency, double decibels) {
    if (worst == 0.0) from = frequency;
    to = frequency;
    if (decibels > worst) worst = decibels, at = frequency;
  }
  std::string range() const {
    return from < to ? fmt::format("from {:.4g} to {:.4g} Hz", from, to) : fmt::format("at {:.4g} Hz", from);
  }
};

}  // namespace

std::vector<std::string> doubts_of_end(const std::string& who, const Srs& srs, const std::vector<double>& band,
                                       const FrequencyRange& judged, const EndOfRecord& end) {
  Doubted moves, grows;
  for (size_t i = 0; i < band.size(); ++i)
    if (judged.holds(srs.frequency[i]) && band[i] > limit::record_band)
      (srs.ending.grows[i] ? grows : moves).add(srs.frequency[i], band[i]);
  std::vector<std::string> doubts;
  if (moves.worst > 0.0)
    doubts.push_back(fmt::format(
        "{} depends on where its record ends {}: truncation within its last quarter changes it by up to {:.2g} dB, at "
        "{:.4g} Hz; at the end, {:.4g} ms, the velocity has changed by {:.3g} m/s and the displacement by {:.3g} mm, "
        "and the spectrum sees the velocity as a step; use a longer 'duration' or more damping, or 'taper' = {:.3g}*ms",
        who, moves.range(), moves.worst, moves.at, 1e3 * end.length, end.velocity, 1e3 * end.displacement,
        250.0 * end.length));
  if (grows.worst > 0.0)
    doubts.push_back(
        fmt::format("{} still grows when its record ends {}: by {:.2g} dB in the last quarter of {:.4g} ms, at {:.4g} "
                    "Hz; an oscillator that has not peaked gives no maximum: use a longer 'duration'",
                    who, grows.range(), grows.worst, 1e3 * end.length, grows.at));
  return doubts;
}

}  // namespace dygita
