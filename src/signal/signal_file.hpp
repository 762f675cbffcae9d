// Signals on files: two columns of numbers, or one of several beside the time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "signal/text_table.hpp"

namespace dygita {

struct SampledSignal {
  std::vector<double> times;   // s, strictly increasing
  std::vector<double> values;  // as many, SI where `unit` is given, else as they stand
  std::string unit;            // SI, of the values ("m/s^2"); empty where the file gives none
  std::string unit_written;    // as the file has it ("g")
  double unit_factor = 1.0;    // of one of unit_written, in SI
  bool has_unit = false;       // the file gives one, or the deck does
};

// Reads time and value, of a TextTable. Without a unit times are seconds. `column`: the title of the values, where
// there are several columns; else there are two. Throws InputError with file:line on anything else, on a unit that is
// not known, on times that do not increase, on a file that cannot be read and on one without points.
SampledSignal read_signal(const std::string& path, const std::string& column = "");

// The column with that title. Throws InputError with the closest.
size_t column_named(const std::vector<Title>& titles, const std::string& name, const std::string& path);

}  // namespace dygita
