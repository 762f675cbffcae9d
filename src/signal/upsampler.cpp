#include "signal/upsampler.hpp"

#include <cmath>
#include <numbers>

#include "base/error.hpp"

namespace dygita {

namespace {

constexpr int half_width = 32, width = 2 * half_width;
constexpr double kaiser_beta = 8.96;  // 0.1102 (A - 8.7), A = 90 dB

double sinc(double x) {
  const double angle = std::numbers::pi * x;
  return std::abs(angle) < 1e-9 ? 1.0 : std::sin(angle) / angle;
}

double kaiser(double x) {
  if (std::abs(x) >= 1.0) return 0.0;
  return std::cyl_bessel_i(0.0, kaiser_beta * std::sqrt(1.0 - x * x)) / std::cyl_bessel_i(0.0, kaiser_beta);
}

// Weights of the samples -half_width + 1 ... half_width for the value at `share` of the interval 0 to 1; their sum is
// one.
void fill_row(double* row, double share) {
  double sum = 0.0;
  for (int k = 0; k < width; ++k) {
    const double distance = share - (k - half_width + 1);
    row[k] = sinc(distance) * kaiser(distance / half_width);
    sum += row[k];
  }
  for (int k = 0; k < width; ++k) row[k] /= sum;
}

std::vector<double> extend(const std::vector<double>& signal) {
  const int n = static_cast<int>(signal.size());
  std::vector<double> extended(signal.size() + width);
  double* x = extended.data() + half_width;
  std::copy(signal.begin(), signal.end(), x);
  // A signal shorter than the kernel is reflected about what was reflected before.
  for (int k = 1; k <= half_width; ++k) {
    x[-k] = n > 1 ? 2.0 * x[0] - x[k] : x[0];
    x[n - 1 + k] = n > 1 ? 2.0 * x[n - 1] - x[n - 1 - k] : x[0];
  }
  return extended;
}

}  // namespace

Upsampler::Upsampler(const std::vector<double>& signal, int factor) : factor_(factor) {
  CHECK(factor >= 1 && !signal.empty(), "a signal and a factor are needed");
  n_intervals_ = signal.size() - 1;
  extended_ = extend(signal);
  kernel_.resize(static_cast<size_t>(factor) * width);
  for (int phase = 0; phase < factor; ++phase) {
    fill_row(kernel_.data() + static_cast<size_t>(phase) * width, static_cast<double>(phase) / factor);
  }
}

void Upsampler::intervals(size_t from, size_t to, std::vector<double>& out) const {
  CHECK(from <= to && to <= n_intervals_, "intervals beyond the signal");
  out.resize((to - from) * static_cast<size_t>(factor_));
  double* next = out.data();
  for (size_t i = from; i < to; ++i) {
    const double* samples = extended_.data() + i + 1;  // sample i - half_width + 1
    *next++ = samples[half_width - 1];
    for (int phase = 1; phase < factor_; ++phase) {
      const double* row = kernel_.data() + static_cast<size_t>(phase) * width;
      double sum = 0.0;
      for (int k = 0; k < width; ++k) sum += row[k] * samples[k];
      *next++ = sum;
    }
  }
}

}  // namespace dygita
