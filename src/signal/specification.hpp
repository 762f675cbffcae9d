// The shock response spectrum that a test or a customer asks for: a broken line in log-log.
#pragma once

#include <string>
#include <vector>

#include "signal/frequency_range.hpp"

namespace dygita {

struct Specification {
  std::vector<double> frequency;  // Hz, increasing
  std::vector<double> level;      // m/s^2, above zero
  std::string source;             // "deck", or the file's path
  std::string unit = {};          // of the levels as the file gives it ("g"); empty: none given, SI

  // m/s^2, linear in log-log between points (manual, eq. N1); nan outside.
  double level_at(double frequency) const;
};

// Throws InputError unless there are two points at least, frequencies above zero that increase, levels above zero.
// `where` starts the message, point by point ("spec.csv:3", "'specification[2]'").
void check_specification(const Specification& specification, const std::vector<std::string>& where);

// Two columns, frequency (Hz) and level (m/s^2), separated by a comma, a semicolon or blanks; a header line gives other
// units in brackets: "frequency [kHz], level (g)". Throws InputError with file:line, also on a unit that is not known.
Specification read_specification(const std::string& path);

// Where a spectrum is highest above its specification, or nearest below it (manual, eq. N2).
struct Exceedance {
  double decibels = 0.0;   // 20 log10(spectrum / specification); negative: a margin
  double frequency = 0.0;  // Hz
  bool is_known = false;   // false: the spectrum and the specification share no frequency
};

// Frequencies (Hz) and values (m/s^2) of the spectrum; those outside the specification or outside `judged`, and values
// that are not above zero, are passed over.
Exceedance largest_exceedance(const Specification& specification, const std::vector<double>& frequency,
                              const std::vector<double>& value, const FrequencyRange& judged = {});

}  // namespace dygita
