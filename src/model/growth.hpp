// How a part grows with temperature, alike in all directions (manual, eq. S8): what a load says of it, and who looks
// for stress needs to know.
#pragma once

#include <optional>
#include <string>

namespace dygita {

// Name of a load's value (K), with the strain (1/K) that a value of one brings; and that strain, of the key of such a
// value (State::reached). None: of another load.
std::string growth_name(double expansion);
std::optional<double> expansion_of(const std::string& key);

}  // namespace dygita
