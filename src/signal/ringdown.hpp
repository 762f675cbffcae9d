// Frequency and damping of a vibration that decays, against its amplitude (manual, eq. D20-D21).
#pragma once

#include <vector>

#include "signal/srs.hpp"

namespace dygita {

// One entry a period: the middle of the window (s), the amplitude (unit of the signal), natural frequency (Hz), damping
// ratio (negative where the vibration grows).
struct Ringdown {
  std::vector<double> time, amplitude, frequency, damping;
};

// Half the length (s) of the window that passes a band (Hz): a tenth of what is at its edges.
double ringdown_window(double from, double to);

// Of what a signal has in a band (Hz), from one half window after its start to one before its end, or until the
// amplitude is a thousandth of the first. A single vibration that decays exponentially is found exactly, anywhere in
// the band; where a stronger one outside the band drowns it there is no entry. Empty where the signal is shorter than a
// window. Throws InputError unless 0 < from < to <= 3 from and `to`
// is below half the sampling rate.
Ringdown ring_down(const EvenStretch& signal, double from, double to);

}  // namespace dygita
