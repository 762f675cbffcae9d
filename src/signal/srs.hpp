// Shock response spectrum of a sampled signal (Smallwood's ramp-invariant filter, ISO 18431-4).
#pragma once

#include <vector>

namespace dygita {

struct SrsSettings {
  double q_factor = 10.0;
  double from = 100.0;     // Hz
  double to = 10000.0;     // Hz
  int per_octave = 12;
};

// One row a natural frequency; primary: during the record, residual: after it, both as maximax.
struct Srs {
  std::vector<double> frequency, maximax, positive, negative, primary, residual;
};

// Absolute-acceleration response to a base acceleration sampled every `dt` seconds (first sample at t = 0, at rest before).
// The signal is upsampled (band-limited) to 40 times the natural frequency where it is coarser. Warns below 1/T of the
// record. Throws InputError on an empty signal, dt <= 0, from >= to, to above the Nyquist frequency is a warning.
Srs shock_response_spectrum(const std::vector<double>& signal, double dt, const SrsSettings& settings);

}  // namespace dygita
