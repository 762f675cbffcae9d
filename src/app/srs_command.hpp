// dygita srs: the shock response spectrum of a CSV file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "signal/srs.hpp"

namespace dygita {

struct SrsCommand {
  std::string signal, column, out;  // file; column of values (empty: the first); file to write (empty: standard output)
  SrsSettings settings;
  std::optional<double> damping;  // takes the place of settings.q_factor
  std::string quantity = "absolute_acceleration";
};

// What --quantity may ask for.
std::vector<std::string> srs_quantities();

// Reads time (s) in the first column and values in the column asked for, in files like those that dygita writes:
// columns of text are passed over, of rows of the same time the last counts. A sampling that is not even is made so,
// with a warning. Throws InputError with file:line,
// or for an unknown quantity.
void write_srs(const SrsCommand& command);

}  // namespace dygita
