// What a record can say of a spectrum.
#pragma once

#include <limits>

namespace dygita {

struct FrequencyRange {
  double from = 0.0, to = std::numeric_limits<double>::infinity();  // Hz

  // Frequencies of a spectrum are made by multiplying: one on the limit is in.
  bool holds(double frequency) const { return frequency >= from * (1.0 - 1e-9) && frequency <= to * (1.0 + 1e-9); }
};

// Of a record of this length, sampled every dt (both s): from one period in it to half the sampling rate. Nothing where
// there is no record.
inline FrequencyRange reliable_range(double record, double dt) {
  if (!(record > 0.0) || !(dt > 0.0)) return {std::numeric_limits<double>::infinity(), 0.0};
  return {1.0 / record, 0.5 / dt};
}

}  // namespace dygita
