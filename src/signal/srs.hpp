// Shock response spectrum of a sampled signal (Smallwood's ramp-invariant filter, ISO 18431-4).
#pragma once

#include <string>
#include <vector>

namespace dygita {

// What of the oscillator is followed: the absolute acceleration of its mass (equivalent static acceleration), the
// displacement z of its mass relative to its base, or wn z.
enum class SrsQuantity { absolute_acceleration, relative_displacement, pseudo_velocity };

// The unit of a spectrum of a signal in `unit`: m/s^2 becomes m or m/s, g becomes g s^2 or g s.
std::string srs_unit(SrsQuantity quantity, const std::string& unit);

// Q = 1 / (2 damping ratio); infinite without damping.
double q_factor_of(double damping);

struct SrsSettings {
  double q_factor = 10.0;  // above 0.5; infinite: undamped
  double from = 100.0;     // Hz
  double to = 10000.0;     // Hz
  int per_octave = 12;
  SrsQuantity quantity = SrsQuantity::absolute_acceleration;
};

// One entry a natural frequency (Hz), from, from 2^(1/per_octave), ... up to `to`. The others in
// srs_unit, none negative: `positive` and `negative` are the largest response of each sign, during the record and after
// it, `maximax` the larger of the two; `primary` is the maximax during the record, `residual` after it, where the base
// stands still.
struct Srs {
  std::vector<double> frequency, maximax, positive, negative, primary, residual;
};

// Response to a base acceleration sampled every `dt` seconds (first sample at t = 0, at rest
// before). The signal is upsampled (band-limited) to 40 times the natural frequency, eight times at least (what it
// holds above that frequency answers too), peaks are read
// off the parabola through three samples. Warns below 1/T of the record and above its Nyquist frequency. Throws
// InputError on an empty signal or a value that is not finite, dt <= 0, from <= 0, from >= to, per_octave < 1, q_factor
// <= 0.5.
Srs shock_response_spectrum(const std::vector<double>& signal, double dt, const SrsSettings& settings);

}  // namespace dygita
