#include "result/spectra.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/log.hpp"
#include "signal/srs.hpp"

namespace dygita {

namespace {

// Of the dynamic rows; no frequency where there is none.
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

std::vector<std::string> axes(const Output& history) {
  if (history.direction) return {""};
  return {"_x", "_y", "_z"};
}

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// Rows of the spectrum in each band: centre (Hz), first and last row + 1. A band is kept if the spectrum goes through
// all of it; a spectrum of less than one band is one.
struct Band {
  double centre;
  size_t first, end;
};

std::vector<Band> bands_of(const std::vector<double>& frequency, const SrsSettings& settings, int per_octave) {
  std::vector<Band> bands;
  const double width = std::exp2(1.0 / per_octave);
  for (int b = 0;; ++b) {
    const double low = settings.from * std::exp2(static_cast<double>(b) / per_octave);
    if (low * width > settings.to * (1.0 + 1e-9)) break;
    Band band{low * std::sqrt(width), frequency.size(), 0};
    for (size_t i = 0; i < frequency.size(); ++i) {
      if (frequency[i] < low * (1.0 - 1e-9) || frequency[i] > low * width * (1.0 + 1e-9)) continue;
      band.first = std::min(band.first, i);
      band.end = i + 1;
    }
    if (band.end > band.first) bands.push_back(band);
  }
  if (bands.empty() && !frequency.empty())
    bands.push_back({std::sqrt(settings.from * settings.to), 0, frequency.size()});
  return bands;
}

double level(const std::vector<double>& maximax, const Band& band) {
  double sum = 0.0;
  for (size_t i = band.first; i < band.end; ++i) sum += std::log(maximax[i]);
  return std::exp(sum / static_cast<double>(band.end - band.first));
}

}  // namespace

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

Table spectrum_table(const Problem& problem, const Output& output, const Table& history) {
  const Srs srs = spectrum_of(problem, output.srs, history, 1);
  if (srs.frequency.empty()) return {};
  const std::string unit = srs_unit(output.srs.quantity, history.units[1]);
  return {{"frequency", "maximax", "positive", "negative", "primary", "residual"},
          {"Hz", unit, unit, unit, unit, unit},
          {srs.frequency, srs.maximax, srs.positive, srs.negative, srs.primary, srs.residual},
          {}};
}

Exceedance exceedance_of(const Output& output, const RunResult& result) {
  const auto found = result.tables.find(&output);
  if (!output.specification || found == result.tables.end() || found->second.n_rows() == 0) return {};
  return largest_exceedance(*output.specification, found->second.columns.front(), found->second.column("maximax"));
}

std::vector<std::string> attenuation_columns(const Output& output) {
  std::vector<std::string> names = {"frequency"};
  for (const std::string& axis : axes(*output.of))
    for (const char* name : {"entering", "leaving", "ratio"}) names.push_back(name + axis);
  return names;
}

Table attenuation_table(const Problem& problem, const Output& output, const Table& entering, const Table& leaving) {
  constexpr double nothing = 1e-6;  // of the level along the strongest axis
  Table table;
  table.names = attenuation_columns(output);
  table.columns.resize(table.names.size());
  table.units = {"Hz"};
  const std::string unit = srs_unit(output.srs.quantity, entering.units[1]);
  std::vector<double> strongest;
  for (size_t axis = 0; axis < axes(*output.of).size(); ++axis) {
    table.units.insert(table.units.end(), {unit, unit, "dB"});
    const Srs in = spectrum_of(problem, output.srs, entering, axis + 1);
    const Srs out = spectrum_of(problem, output.srs, leaving, axis + 1);
    const std::vector<Band> bands = bands_of(in.frequency, output.srs, output.bands);
    strongest.resize(bands.size(), 0.0);
    for (size_t b = 0; b < bands.size(); ++b) {
      if (axis == 0) table.columns[0].push_back(bands[b].centre);
      table.columns[3 * axis + 1].push_back(level(in.maximax, bands[b]));
      table.columns[3 * axis + 2].push_back(level(out.maximax, bands[b]));
      strongest[b] = std::max(strongest[b], table.columns[3 * axis + 1].back());
    }
  }
  for (size_t i = 1; i < table.columns.size(); i += 3)
    for (size_t b = 0; b < strongest.size(); ++b) {
      const double in = table.columns[i][b], out = table.columns[i + 1][b];
      table.columns[i + 2].push_back(in > nothing * strongest[b] ? 20.0 * std::log10(out / in) : not_a_number);
    }
  return table;
}

std::string attenuation_summary(const Output& output, const Table& table) {
  std::string text;
  for (const std::string& axis : axes(*output.of)) {
    const std::vector<double>& ratio = table.column("ratio" + axis);
    double sum = 0.0, n = 0.0, lowest = 0.0, highest = 0.0, lowest_at = 0.0, highest_at = 0.0;
    for (size_t i = 0; i < ratio.size(); ++i) {
      if (!std::isfinite(ratio[i])) continue;
      const double at = table.columns[0][i] / 1e3;
      if (n == 0.0 || ratio[i] < lowest) lowest = ratio[i], lowest_at = at;
      if (n == 0.0 || ratio[i] > highest) highest = ratio[i], highest_at = at;
      sum += ratio[i];
      n += 1.0;
    }
    text += text.empty() ? "" : "; ";
    if (!axis.empty()) text += axis.substr(1) + " ";
    text += n == 0.0 ? std::string("nothing enters")
                     : fmt::format("{:+.1f} dB ({:+.1f} at {:.3g} kHz, {:+.1f} at {:.3g} kHz)", sum / n, lowest,
                                   lowest_at, highest, highest_at);
  }
  return fmt::format(
      "attenuation '{}', mean of {} bands (lowest, highest): {}; rule of thumb for {} bolted joint{}: {:+.0f} dB",
      output.name, table.n_rows(), text, output.n_joints, output.n_joints == 1 ? "" : "s", -3.0 * output.n_joints);
}

}  // namespace dygita
