// What a frame holds at most, for who sets up a picture of it without reading it back.
#pragma once

#include <string>

#include "result/frame.hpp"

namespace dygita {

struct FrameSummary {
  double label_time = 0.0;
  std::string step;
  double displacement = 0.0;  // m, largest modulus of the parts'
  // Pa, what one point in two hundred exceeds, so that a notch does not hide the rest; 0 where no such field was asked
  // for.
  double von_mises = 0.0, pressure = 0.0;
  bool has_interfaces = false;
  int missed = 0;  // increments up to there that have not converged
};

// Of the parts that have fields. Values that are not finite are passed over.
FrameSummary summary_of(const Frame& frame);

// The von Mises stresses (Pa) of these parts, of each node by one of its ranks.
std::vector<double> stresses_of(const Frame& frame);
// Of n values, how many the summary passes over as a notch: one in two hundred.
inline size_t n_exceeding(size_t n) { return n == 0 ? 0 : (n - 1) / 200; }
// The value that n others exceed; 0 where there is none. Changes their order.
double exceeded_by(size_t n, std::vector<double>& values);

}  // namespace dygita
