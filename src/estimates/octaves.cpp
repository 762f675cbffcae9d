#include "estimates/octaves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "numerics/time_scheme.hpp"

namespace dygita {

namespace {

constexpr double quarter = std::numbers::pi / 2;

}  // namespace

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

// How much of the octave's motion is left since the sample before. Its velocities swing: the squares of four samples,
// one full turn, make twice that of the envelope, and a wave that a fixed end turns back is at rest for a moment.
double OctaveBank::Octave::falls_by(double content2, double& envelope) {
  const double before = *std::max_element(crests.begin(), crests.end());
  last[static_cast<size_t>(n) % last.size()] = content2;
  envelope = std::sqrt(0.5 * std::accumulate(last.begin(), last.end(), 0.0));
  crests[static_cast<size_t>(n++) % crests.size()] = envelope;
  const double now = *std::max_element(crests.begin(), crests.end());
  return before > 0.0 ? std::min(1.0, now / before) : 1.0;
}

// An oscillator of the octave with the damping that spectra have gathers what its envelope brings; its largest
// response, and all that come near it, see the phase error of their time.
void OctaveBank::Octave::add(double content2, double lag) {
  constexpr double damping = 0.05, near = 0.9;
  double envelope = 0.0;
  const double share = falls_by(content2, envelope), now = std::sqrt(content2);
  content = std::max(content, now);
  phase = share * phase + lag * now;
  turned = share * turned + quarter * now;
  most_phase = std::max(most_phase, phase);
  most_turned = std::max(most_turned, turned);
  response += damping * quarter * (envelope - response);
  largest_response = std::max(largest_response, response);
  if (response < near * largest_response) return;
  responding_phase = std::max(responding_phase, phase);
}

void OctaveBank::add(std::span<const double> content2) {
  if (octaves_.size() < content2.size()) octaves_.resize(content2.size());
  for (size_t i = 0; i < content2.size(); ++i) {
    const double steps = std::exp2(i);
    octaves_[i].add(content2[i], steps * TimeScheme::phase_lag(quarter / steps, is_tuned_));
  }
}

// What has lost its phase has nothing in common with the exact motion.
double OctaveBank::phase_error(double factor, double shift) const {
  double sum = 0.0;
  for (const Octave& octave : octaves_)
    sum += std::pow(
        std::min(factor * octave.most_phase + shift * octave.most_turned, std::numbers::sqrt2 * octave.content), 2);
  return std::sqrt(sum);
}

std::vector<OctaveBank::Lag> OctaveBank::lags(double factor) const {
  std::vector<Lag> all;
  for (size_t i = 0; i < octaves_.size(); ++i)
    all.push_back({quarter / std::exp2(i),
                   std::min(factor * octaves_[i].responding_phase, std::numbers::sqrt2 * octaves_[i].content)});
  return all;
}

}  // namespace dygita
