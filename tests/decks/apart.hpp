// Two runs of one scene, what they differ by in frequency and what is left of the difference then.
#pragma once

#include <complex>
#include <numbers>

#include "decks/spectra.hpp"

namespace dygita::test {

inline std::vector<const Table*> tables_named(const SpectraRun& run, char first) {
  std::vector<const Table*> tables;
  for (const OutputPtr& output : run.problem.outputs)
    if (output->name.front() == first) tables.push_back(&run.result->tables.at(output.get()));
  return tables;
}

// A velocity of the last step: samples every `dt` from its start on.
struct Signal {
  std::vector<double> values;
  double dt = 0.0;
};

inline Signal last_step(const Table& table) {
  Signal signal;
  const std::vector<double>& time = table.column("time");
  const auto first =
      static_cast<size_t>(std::find(table.step.begin(), table.step.end(), table.step.back()) - table.step.begin());
  signal.values.assign(table.columns.back().begin() + static_cast<std::ptrdiff_t>(first), table.columns.back().end());
  signal.dt = (time.back() - time[first]) / static_cast<double>(signal.values.size() - 1);
  return signal;
}

// Velocities v1, v2, ... less those of the foot, which is shaken alike whatever dt and mesh.
inline std::vector<Signal> signals(const SpectraRun& run) {
  std::vector<Signal> all, feet;
  for (const Table* table : tables_named(run, 'v')) all.push_back(last_step(*table));
  for (const Table* table : tables_named(run, 'f')) feet.push_back(last_step(*table));
  for (size_t i = 0; i < feet.size(); ++i)
    for (size_t k = 0; k < all[i].values.size(); ++k) all[i].values[k] -= feet[i].values[k];
  return all;
}

// What a signal holds within half an octave of an angular frequency: its transform (of the signal and three times as
// much silence) times a Gaussian of the logarithm. With it the derivatives by time.
struct Passed {
  Signal value, first, second;
};

inline Passed passed(const Signal& signal, double middle) {
  constexpr double width = 0.35, least = 1e-5;
  const size_t n = signal.values.size();
  const double step = 2.0 * std::numbers::pi / (4.0 * static_cast<double>(n) * signal.dt);
  const std::vector<double> none(n, 0.0);
  Passed all{{none, signal.dt}, {none, signal.dt}, {none, signal.dt}};
  const double reach = std::exp(width * std::sqrt(-2.0 * std::log(least)));
  for (auto k = static_cast<long>(middle / reach / step) + 1; k * step < middle * reach; ++k) {
    const double w = static_cast<double>(k) * step;
    if (w * signal.dt > std::numbers::pi) break;
    const std::complex<double> turn = std::polar(1.0, -w * signal.dt);
    std::complex<double> sum = 0.0, now = 1.0;
    for (size_t i = 0; i < n; ++i, now *= turn) sum += signal.values[i] * now;
    sum *= std::exp(-0.5 * std::pow(std::log(w / middle) / width, 2)) * signal.dt * step / std::numbers::pi;
    now = sum;
    for (size_t i = 0; i < n; ++i, now *= std::conj(turn)) {
      all.value.values[i] += now.real();
      all.first.values[i] -= w * now.imag();
      all.second.values[i] -= w * w * now.real();
    }
  }
  return all;
}

// A signal at a time, by cubics through four samples; nothing beyond its ends.
inline std::optional<double> at_time(const Signal& signal, double t) {
  const double x = t / signal.dt, last = static_cast<double>(signal.values.size() - 1);
  if (x < 0.0 || x > last) return std::nullopt;
  const auto i = static_cast<size_t>(std::clamp(std::floor(x) - 1.0, 0.0, last - 3.0));
  double value = 0.0;
  for (size_t a = 0; a < 4; ++a) {
    double share = 1.0;
    for (size_t b = 0; b < 4; ++b)
      if (b != a) share *= (x - static_cast<double>(i + b)) / (static_cast<double>(a) - static_cast<double>(b));
    value += share * signal.values[i + a];
  }
  return value;
}

// Relative distance of two runs' velocities, the time of the other stretched.
inline double distance(const std::vector<Signal>& run, const std::vector<Signal>& other, double stretch) {
  double error = 0.0, all = 0.0;
  for (size_t k = 0; k < run.size(); ++k)
    for (size_t i = 0; i < run[k].values.size(); ++i) {
      const std::optional<double> exact = at_time(other[k], stretch * run[k].dt * static_cast<double>(i));
      if (!exact) continue;
      error += std::pow(run[k].values[i] - *exact, 2);
      all += std::pow(*exact, 2);
    }
  return std::sqrt(error / all);
}

struct Stretch {
  double by = 0.0, left = 0.0;
};

// The stretch by which the other run comes nearest, to a millionth of itself.
inline Stretch nearest(const std::vector<Signal>& run, const std::vector<Signal>& other, double most) {
  Stretch best{0.0, distance(run, other, 1.0)};
  const auto take = [&](double by) {
    if (const double left = distance(run, other, 1.0 + by); left < best.left) best = {by, left};
  };
  for (int i = -100; i <= 100; ++i) take(most * i / 100.0);
  for (double step = 0.5 * most / 100.0; step > 1e-9; step *= 0.5) {
    const double middle = best.by;
    take(middle - step);
    take(middle + step);
  }
  return best;
}

// What frequencies are off by at the mean frequency (Hz) that the run tells, and what is left of the distance when the
// whole motion has been stretched. Where the motion holds little at that frequency, the stretch is that of its
// neighbours: of the time step, whose errors go with the square of the frequency, it is taken back to the mean.
struct Apart {
  double frequency = 0.0, amplitude = 0.0;
};

inline Apart apart(const SpectraRun& run, const SpectraRun& other, double mean_frequency, bool goes_with_square) {
  const auto own = signals(run), exact = signals(other);
  const double middle = 2.0 * std::numbers::pi * mean_frequency;
  std::vector<Signal> own_passed, exact_passed;
  double turned = 0.0, moved = 0.0;
  for (size_t k = 0; k < own.size(); ++k) {
    const Passed passed_own = passed(own[k], middle);
    for (size_t i = 0; i < own[k].values.size(); ++i) {
      turned += std::pow(static_cast<double>(i) * passed_own.second.values[i], 2);
      moved += std::pow(static_cast<double>(i) * passed_own.first.values[i], 2);
    }
    own_passed.push_back(passed_own.value);
    exact_passed.push_back(passed(exact[k], middle).value);
  }
  const double back = goes_with_square ? middle * middle * moved / turned : 1.0;
  constexpr double most = 0.4;
  return {back * std::abs(nearest(own_passed, exact_passed, most).by), nearest(own, exact, most).left};
}

}  // namespace dygita::test
