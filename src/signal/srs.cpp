#include "signal/srs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/log.hpp"
#include "signal/frequency_range.hpp"
#include "signal/oscillator.hpp"
#include "signal/upsampler.hpp"

namespace dygita {

namespace {

constexpr double samples_per_period = 40.0;
constexpr int least_factor =
    8;  // content above the natural frequency needs its samples too: 16 a period at the Nyquist frequency
constexpr int largest_factor = 64;  // far above the Nyquist frequency the response is the signal itself

void check(const std::vector<double>& signal, double dt, const SrsSettings& settings) {
  if (signal.empty()) throw InputError("srs: the signal is empty");
  const auto odd = std::find_if(signal.begin(), signal.end(), [](double value) { return !std::isfinite(value); });
  if (odd != signal.end()) {
    throw InputError(fmt::format("srs: sample {} of the signal is {}", odd - signal.begin() + 1, *odd));
  }
  if (!(dt > 0.0) || !std::isfinite(dt))
    throw InputError(fmt::format("srs: sampling interval {} s must be above 0", dt));
  if (!(settings.from > 0.0)) throw InputError(fmt::format("srs: 'from' = {} Hz must be above 0", settings.from));
  if (!(settings.from < settings.to) || !std::isfinite(settings.to)) {
    throw InputError(fmt::format("srs: 'from' = {} Hz must be below 'to' = {} Hz", settings.from, settings.to));
  }
  if (settings.per_octave < 1) {
    throw InputError(fmt::format("srs: 'per_octave' = {} must be 1 or more", settings.per_octave));
  }
  if (!(settings.q_factor > 0.5)) {
    throw InputError(
        fmt::format("srs: 'q_factor' = {} must be above 0.5 (0.5 is critical damping)", settings.q_factor));
  }
}

void warn_of_limits(size_t n_samples, double dt, const SrsSettings& settings) {
  const double duration = static_cast<double>(n_samples) * dt;
  const FrequencyRange reliable = reliable_range(duration, dt);
  if (settings.from < reliable.from) {
    warn(fmt::format("srs: the spectrum is unreliable below {:.4g} Hz, 1/record length ({:.4g} s)", reliable.from,
                     duration));
  }
  if (settings.to > reliable.to) {
    warn(fmt::format(
        "srs: above {:.4g} Hz, half the sampling rate, the record has no content: the spectrum is its peak there",
        reliable.to));
  }
}

std::vector<double> natural_frequencies(const SrsSettings& settings) {
  const int n = static_cast<int>(settings.per_octave * std::log2(settings.to / settings.from) + 1e-9) + 1;
  std::vector<double> frequencies;
  for (int i = 0; i < n; ++i)
    frequencies.push_back(settings.from * std::exp2(static_cast<double>(i) / settings.per_octave));
  return frequencies;
}

// A power of two, so that frequencies share few upsampled signals.
int upsampling_factor(double frequency, double dt) {
  int factor = least_factor;
  while (factor < largest_factor && factor < samples_per_period * frequency * dt) factor *= 2;
  return factor;
}

void run(const Upsampler& upsampler, double last, std::vector<Oscillator>& oscillators) {
  constexpr size_t chunk_length = 4096;
  const size_t step = std::max<size_t>(1, chunk_length / static_cast<size_t>(upsampler.factor()));
  std::vector<double> chunk;
  for (size_t from = 0; from < upsampler.n_intervals(); from += step) {
    upsampler.intervals(from, std::min(from + step, upsampler.n_intervals()), chunk);
    if (from == 0) chunk.erase(chunk.begin());  // the oscillators start from the first sample
    for (Oscillator& oscillator : oscillators) oscillator.advance(chunk);
  }
  if (upsampler.n_intervals() > 0) {
    for (Oscillator& oscillator : oscillators) oscillator.advance({last});
  }
}

void append(Srs& srs, double frequency, const Oscillator& oscillator) {
  const ResponsePeaks during = oscillator.during(), after = oscillator.after();
  srs.frequency.push_back(frequency);
  srs.positive.push_back(std::max(during.highest, after.highest));
  srs.negative.push_back(-std::min(during.lowest, after.lowest) + 0.0);  // + 0: no "-0"
  srs.maximax.push_back(std::max(during.maximax(), after.maximax()));
  srs.primary.push_back(during.maximax());
  srs.residual.push_back(after.maximax());
}

}  // namespace

std::string srs_unit(SrsQuantity quantity, const std::string& unit) {
  if (quantity == SrsQuantity::absolute_acceleration || unit.empty()) return unit;
  const bool is_velocity = quantity == SrsQuantity::pseudo_velocity;
  if (unit == "m/s^2") return is_velocity ? "m/s" : "m";
  return unit + (is_velocity ? " s" : " s^2");
}

double q_factor_of(double damping) { return damping > 0.0 ? 0.5 / damping : std::numeric_limits<double>::infinity(); }

Srs shock_response_spectrum(const std::vector<double>& signal, double dt, const SrsSettings& settings) {
  check(signal, dt, settings);
  warn_of_limits(signal.size(), dt, settings);
  const std::vector<double> frequencies = natural_frequencies(settings);
  Srs srs;
  // Run the oscillators that need the same upsampling together.
  for (size_t first = 0; first < frequencies.size();) {
    const int factor = upsampling_factor(frequencies[first], dt);
    size_t end = first;
    std::vector<Oscillator> oscillators;
    for (; end < frequencies.size() && upsampling_factor(frequencies[end], dt) == factor; ++end) {
      oscillators.emplace_back(frequencies[end], settings.q_factor, dt / factor, signal.front(), settings.quantity);
    }
    run(Upsampler(signal, factor), signal.back(), oscillators);
    for (size_t i = first; i < end; ++i) append(srs, frequencies[i], oscillators[i - first]);
    first = end;
  }
  return srs;
}

}  // namespace dygita
