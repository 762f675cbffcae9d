#include "signal/signal_doubts.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "signal/spectrum.hpp"

namespace dygita {

namespace {

constexpr double at_rest = 0.02;  // of the largest value

// Of a share of the signal at one of its ends.
double mean_of(const std::vector<double>& signal, size_t from, size_t n) {
  double sum = 0.0;
  for (size_t i = from; i < from + n; ++i) sum += signal[i] / static_cast<double>(n);
  return sum;
}

}  // namespace

std::vector<std::string> doubts_of_signal(const std::vector<double>& signal, double dt, double to) {
  double largest = 0.0;
  for (const double value : signal) largest = std::max(largest, std::abs(value));
  std::vector<std::string> doubts;
  if (largest == 0.0) return {"is zero throughout"};
  const auto percent = [&](double value) { return 100.0 * std::abs(value) / largest; };
  const size_t n = signal.size(), few = std::max<size_t>(1, n / 50);
  const double before = mean_of(signal, 0, few), after = mean_of(signal, n - few, few);
  const bool has_offset = n > 4 && before * after > 0.0 &&
                          std::abs(before - after) < 0.5 * std::abs(before + after) / 2.0 &&
                          std::min(percent(before), percent(after)) > 100.0 * 0.5 * at_rest;
  if (has_offset) {
    doubts.push_back(
        fmt::format("is {:.3g} before the shock and {:.3g} after it, {:.2g} % of its largest value: an offset "
                    "integrates to a growing velocity and distorts the spectrum; remove it first",
                    before, after, percent(0.5 * (before + after))));
  } else {
    if (std::abs(signal.front()) > at_rest * largest)
      doubts.push_back(
          fmt::format("begins with {:.4g}, {:.2g} % of its largest value: the spectrum includes a jump to it",
                      signal.front(), percent(signal.front())));
    if (std::abs(signal.back()) > at_rest * largest)
      doubts.push_back(
          fmt::format("ends with {:.4g}, {:.2g} % of its largest value: the spectrum includes a drop to zero; use a "
                      "longer record, or taper it",
                      signal.back(), percent(signal.back())));
  }
  constexpr double enough = 10.0, high = 0.4, much = 5e-4;  // samples a period; of the sampling rate; of the energy
  if (n > 4 && to * dt > 1.0 / enough && to * dt <= 0.5 && band_limit(signal, dt, 1.0 - much) * dt > high)
    doubts.push_back(
        fmt::format("has {:.3g} samples per period at {:.4g} Hz and more than {:g} % of its energy above {:.4g} Hz, "
                    "near half its sampling rate: peaks between samples are lost and higher frequencies may be "
                    "aliased; limit the spectrum to {:.4g} Hz, or use ten samples per period",
                    1.0 / (to * dt), to, 100.0 * much, high / dt, 1.0 / (enough * dt)));
  return doubts;
}

}  // namespace dygita
