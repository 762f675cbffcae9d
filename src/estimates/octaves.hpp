// What a motion holds at which frequency, by octaves, and the phase error of each (manual, eq. Q2-Q4).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "numerics/types.hpp"

namespace dygita {

// The velocities of a piece by octave of frequency (eq. Q2): what each sample has in the middle of an octave.
class OctaveSamples {
 public:
  // Samples the velocities. Writes the square of the content of each octave that it completes, from octave 0 on, and
  // says how many these are: the same for pieces that have been given as many samples. mass: kg, weights.
  int add(const Vec& mass, const Vec& velocity, double* content2);
  static constexpr int most_octaves = 32;

 private:
  struct Octave {
    std::array<Vec, 3> last;  // samples, the latest first
    long n_samples = 0;
  };
  std::vector<Octave> octaves_;
  std::array<Vec, 2> smooth_;  // on its way to the octave below
};

// Content of the velocities of the assembly by octave of frequency, and the phase error that the time scheme gives each
// (eq. Q2-Q4): a trapezoidal step turns a motion of angular frequency w by (w dt)^3 / 12 too little, until it has
// nothing in common with the exact one.
class OctaveBank {
 public:
  // is_tuned: the cells' mass undoes the phase error to the next order, (w dt)^5 / 80.
  explicit OctaveBank(bool is_tuned) : is_tuned_(is_tuned) {}

  // Squares of the contents of the first octaves in a sample.
  void add(std::span<const double> content2);
  // Norm (sqrt of J) of the accumulated phase error; `factor` multiplies the phases, to which `shift`, a relative error
  // of all frequencies, adds what it turns them by.
  double phase_error(double factor = 1.0, double shift = 0.0) const;
  bool is_tuned() const { return is_tuned_; }
  // What an octave turns by in a sample (rad), and its phase error (sqrt of J) when an oscillator responds to it most.
  struct Lag {
    double turn = 0.0, error = 0.0;
  };
  std::vector<Lag> lags(double factor) const;

 private:
  struct Octave {
    double content = 0.0;  // largest norm so far
    // Sums of content x what it turns by in a sample, which fall with the motion that carries them: phase error, and
    // the whole turn. Now, largest so far, and the former when an oscillator's response to the octave is largest.
    double phase = 0.0, most_phase = 0.0, responding_phase = 0.0;
    double turned = 0.0, most_turned = 0.0;
    std::array<double, 4> last{};     // squares of contents
    std::array<double, 16> crests{};  // envelopes, of which the largest carries the errors
    double response = 0.0, largest_response = 0.0;
    long n = 0;
    double falls_by(double content2, double& envelope);
    void add(double content2, double lag);
  };

  bool is_tuned_;
  std::vector<Octave> octaves_;
};

}  // namespace dygita
