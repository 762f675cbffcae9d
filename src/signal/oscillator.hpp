// A damped oscillator on a moving base: the filter behind a shock response spectrum.
#pragma once

#include <complex>
#include <vector>

#include "signal/srs.hpp"

namespace dygita {

// Largest and smallest response met, zero at rest included.
struct ResponsePeaks {
  double highest = 0.0, lowest = 0.0;

  void meet(double value);
  double maximax() const;
};

// Absolute acceleration y of a mass on a spring and a damper whose base has the acceleration x, exact where x is linear
// between samples (ramp-invariant): the filter of Smallwood (Shock and Vibration Bulletin 51, 1981; ISO 18431-4).
// It is run as its one complex pole, u_1 = e^(pT) u_0 + a x_0 + b x_1 and y = Re u, with p = -z wn + i wd; that is the
// same filter as his y_n = b0 x_n + b1 x_(n-1) + b2 x_(n-2) - a1 y_(n-1) - a2 y_(n-2), without the loss of digits that
// the latter has where wn T is small. The relative displacement (z'' + 2 zeta wn z' + wn^2 z = -x) and the
// pseudo-velocity wn z have the same pole and another residue.
class Oscillator {
 public:
  // natural frequency (Hz), q_factor > 0.5 (may be infinite), seconds between samples, first sample of the base.
  Oscillator(double frequency, double q_factor, double dt, double first,
             SrsQuantity quantity = SrsQuantity::absolute_acceleration);

  // The samples that follow are this far apart (s).
  void sample_every(double dt);
  void advance(const std::vector<double>& base);
  // The base continues along a straight line to the value `to`, for `length` (s): sampled where the response can be
  // largest, as often however long it is.
  void follow_line(double to, double length);

  double response() const { return u_.real(); }
  // During the samples met so far; a peak between samples is the vertex of the parabola through three of them.
  ResponsePeaks during() const;
  // After the last one, if the base stood still from then on: closed form.
  ResponsePeaks after() const;

 private:
  double wd_;
  std::complex<double> pole_, residue_, decay_, from_old_, from_new_;
  std::complex<double> u_ = 0.0;
  double x_, y_old_ = 0.0;
  ResponsePeaks extremes_;
};

}  // namespace dygita
