#include "signal/ringdown.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

#include "base/error.hpp"

namespace dygita {

namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

// cos^4 over a window, its slope (1/s), and the carrier that takes the middle of the band to zero frequency.
struct Window {
  std::vector<double> weight, slope;
  std::vector<Complex> carrier;
  double sum = 0.0;

  Window(double half, double dt, double middle) {
    const int n = static_cast<int>(std::floor(half / dt));
    for (int j = -n; j <= n; ++j) {
      const double angle = 0.5 * pi * j * dt / half, c = std::cos(angle);
      weight.push_back(c * c * c * c);
      slope.push_back(-2.0 * pi / half * c * c * c * std::sin(angle));
      carrier.push_back(std::polar(1.0, -2.0 * pi * middle * j * dt));
    }
    sum = std::accumulate(weight.begin(), weight.end(), 0.0);
  }

  // What it makes of exp(rate t).
  double response(Complex rate, double dt) const {
    Complex total = 0.0;
    const auto n = static_cast<double>(weight.size() / 2);
    for (size_t j = 0; j < weight.size(); ++j) total += weight[j] * std::exp(rate * (static_cast<double>(j) - n) * dt);
    return std::abs(total) / sum;
  }
};

}  // namespace

double ringdown_window(double from, double to) {
  constexpr double tenth = 2.22;  // the transform of cos^4 over a window of one is 1/10 at half of this
  return tenth / (to - from);
}

Ringdown ring_down(const EvenStretch& signal, double from, double to) {
  constexpr double least = 1e-3;  // of the first amplitude
  if (!(from > 0.0) || !(from < to) || to > 3.0 * from * (1.0 + 1e-9))
    throw InputError(fmt::format("a band from {:g} to {:g} Hz: it requires 0 < from < to <= 3 from", from, to));
  if (2.0 * to * signal.dt >= 1.0)
    throw InputError(
        fmt::format("a band up to {:g} Hz is beyond half the sampling rate, {:g} Hz", to, 0.5 / signal.dt));
  const double middle = 0.5 * (from + to);
  const Window window(ringdown_window(from, to), signal.dt, middle);
  const size_t width = window.weight.size(), half = width / 2;
  const auto stride = static_cast<size_t>(std::max(1.0, std::round(1.0 / (middle * signal.dt))));
  const std::vector<double>& x = signal.values;
  Ringdown found;
  if (x.size() < width) return found;
  const double mean = std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
  for (size_t k = half; k + half < x.size(); k += stride) {
    Complex z = 0.0, change = 0.0;
    for (size_t j = 0; j < width; ++j) {
      const Complex moved = (x[k - half + j] - mean) * window.carrier[j];
      z += window.weight[j] * moved;
      change -= window.slope[j] * moved;
    }
    if (!(std::abs(z) > 0.0)) break;
    // The window moves along the signal, the carrier with the window: the rate is that of the signal less the
    // carrier's.
    const Complex rate = change / z;
    const double omega = rate.imag() + 2.0 * pi * middle, natural = std::hypot(omega, rate.real());
    if (omega < 2.0 * pi * from || omega > 2.0 * pi * to) continue;  // what leaks in from outside the band
    const double amplitude = 2.0 * std::abs(z) / window.sum / window.response(rate, signal.dt);
    if (!found.amplitude.empty() && !(amplitude >= least * found.amplitude.front())) break;
    found.time.push_back(signal.time(k));
    found.amplitude.push_back(amplitude);
    found.frequency.push_back(natural / (2.0 * pi));
    found.damping.push_back(-rate.real() / natural);
  }
  return found;
}

}  // namespace dygita
