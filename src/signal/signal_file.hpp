// Signals on files: two columns of numbers.
#pragma once

#include <string>
#include <vector>

namespace dygita {

struct SampledSignal {
  std::vector<double> times;   // s, strictly increasing
  std::vector<double> values;  // as many, SI where `unit` is given, else as they stand
  std::string unit;            // SI, of the values ("m/s^2"); empty where the file gives none
  std::string unit_written;    // as the file has it ("g")
  double unit_factor = 1.0;    // of one of unit_written, in SI
};

// Reads time and value, separated by blanks, a comma or a semicolon. A line of titles may come first, which gives units
// in brackets: "time [ms], acceleration (g)"; without one, times are seconds. Lines that are empty or start with '#'
// are passed over. Throws InputError with file:line on anything else, on a unit that is not known, on times that do not
// increase, on a file that cannot be read and on one without points.
SampledSignal read_signal(const std::string& path);

}  // namespace dygita
