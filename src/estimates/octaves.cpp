#include "estimates/octaves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "numerics/time_scheme.hpp"

namespace dygita {

int OctaveSamples::add(const Vec& mass, const Vec& velocity, double* content2) {
  const Vec* sample = &velocity;
  int n = 0;
  for (size_t i = 0;; ++i) {
    if (i == octaves_.size()) octaves_.emplace_back();
    Octave& octave = octaves_[i];
    std::array<Vec, 3>& last = octave.last;
    // The third difference passes what turns by a right angle a sample, the middle of the octave, with the factor
    // 2^(3/2), the square root of 8.
    if (octave.n_samples >= 3)
      content2[n++] = (mass.array() * (*sample - last[2] - 3.0 * (last[0] - last[1])).array().square()).sum() / 8.0;
    // Every other sample, smoothed, goes to the octave below.
    const bool goes_on = octave.n_samples % 2 == 1 && octave.n_samples >= 2 && i + 1 < most_octaves;
    Vec& smooth = smooth_[i % 2];
    if (goes_on) smooth = 0.25 * (*sample + 2.0 * last[0] + last[1]);
    ++octave.n_samples;
    last[2].swap(last[1]);
    last[1].swap(last[0]);
    last[0] = *sample;
    if (!goes_on) return n;
    sample = &smooth;
  }
}

void OctaveBank::add(std::span<const double> content2) {
  if (octaves_.size() < content2.size()) octaves_.resize(content2.size());
  for (size_t i = 0; i < content2.size(); ++i) {
    constexpr double quarter = std::numbers::pi / 2;
    const double content = std::sqrt(content2[i]), steps = std::exp2(i);
    octaves_[i].content = std::max(octaves_[i].content, content);
    octaves_[i].phase += steps * TimeScheme::phase_lag(quarter / steps, is_tuned_) * content;
    octaves_[i].turned += quarter * content;
  }
}

// What has lost its phase has nothing in common with the exact motion.
double OctaveBank::error_of(const Octave& octave, double factor, double shift) const {
  return std::min(factor * octave.phase + shift * octave.turned, std::numbers::sqrt2 * octave.content);
}

double OctaveBank::phase_error(double factor, double shift) const {
  double sum = 0.0;
  for (const Octave& octave : octaves_) sum += std::pow(error_of(octave, factor, shift), 2);
  return std::sqrt(sum);
}

std::vector<OctaveBank::Lag> OctaveBank::lags(double factor) const {
  std::vector<Lag> all;
  for (size_t i = 0; i < octaves_.size(); ++i)
    all.push_back({std::numbers::pi / 2 / std::exp2(i), error_of(octaves_[i], factor, 0.0)});
  return all;
}

}  // namespace dygita
