// What a measured signal shows that its spectrum would hide.
#pragma once

#include <string>
#include <vector>

namespace dygita {

// Of an acceleration sampled every dt (s), whose spectrum goes up to `to` (Hz): an offset, a first or last value that
// is no rest, too few samples for what it holds. Each as it follows on the signal's name: "ends with ...".
std::vector<std::string> doubts_of_signal(const std::vector<double>& signal, double dt, double to);

}  // namespace dygita
