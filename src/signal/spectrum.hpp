// Where the energy of a signal lies in frequency.
#pragma once

#include <vector>

namespace dygita {

// Lowest frequency (Hz) below which lies `share` (0 to 1) of the energy of samples taken every dt (s), less their first
// value; zero for a signal that does not change. The record is taken once more as long with zeros, so that its ends do
// not meet.
double band_limit(const std::vector<double>& samples, double dt, double share);

}  // namespace dygita
