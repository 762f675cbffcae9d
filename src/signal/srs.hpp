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
  double taper = 0.0;        // s, before the end of the record, over which half a cosine takes the signal to zero
  bool watches_end = false;  // see Srs::Ending
};

// One entry a natural frequency (Hz), from, from 2^(1/per_octave), ..., and `to` last. The others in
// srs_unit, none negative: `positive` and `negative` are the largest response of each sign, during the record and after
// it, `maximax` the larger of the two; `primary` is the maximax during the record, `residual` after it, where the base
// is constant.
struct Srs {
  std::vector<double> frequency, maximax, positive, negative, primary, residual;

  // How the end of the record matters: how far the spectrum lies, in dB, from those of the same record cut off
  // anywhere in its last quarter (manual, eq. N3), at most 40; `grows` where it has grown all through that quarter, as
  // an oscillator does that has not come to its peak. Empty unless watched.
  struct Ending {
    std::vector<double> maximax, primary;
    std::vector<bool> grows;
  } ending = {};
};

// Samples taken every dt (s), the first at `start` (s).
struct EvenStretch {
  double start = 0.0, dt = 0.0;
  std::vector<double> values = {};

  double time(size_t i) const { return start + static_cast<double>(i) * dt; }
  double end() const { return time(values.size() - 1); }
};

// Response to a base acceleration sampled in stretches (at rest before the first sample), which a straight line joins.
// Each is upsampled (band-limited) to 40 times the natural frequency, eight times at least (what it
// holds above that frequency answers too), peaks are read
// off the parabola through three samples. What it costs goes with the samples, not with the length of the record.
// Warns below 1/T of the record and above its Nyquist frequency (of the finest stretch). Throws
// InputError on an empty signal, a value that is not finite or too large to compute with, dt <= 0, stretches that
// overlap, from <= 0, from >= to, per_octave < 1, q_factor <= 0.5, a negative taper (a long one is that of the whole
// record).
Srs shock_response_spectrum(const std::vector<EvenStretch>& signal, const SrsSettings& settings);
Srs shock_response_spectrum(const std::vector<double>& signal, double dt, const SrsSettings& settings);

}  // namespace dygita
