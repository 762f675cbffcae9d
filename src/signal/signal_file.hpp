// Signals on files: two columns of numbers.
#pragma once

#include <string>
#include <vector>

namespace dygita {

struct SampledSignal {
  std::vector<double> times;   // s, strictly increasing
  std::vector<double> values;  // as many
};

// Reads time (s) and value, separated by blanks, a comma or a semicolon. Lines that are empty or start with '#' are
// passed over, and one line of titles may come first. Throws InputError with file:line on anything else, on times that
// do not increase, on a file that cannot be read and on one without points.
SampledSignal read_signal(const std::string& path);

}  // namespace dygita
