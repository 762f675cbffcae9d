// Numbers as an engineer reads them: us, kHz, kN, um, MPa, g.
#pragma once

#include <string>

namespace dygita {

struct EngineeringUnit {
  double size = 1.0;  // in the SI unit
  std::string name;   // "kN", "µm"; empty for a number without unit
};

// The unit in which `largest` (SI, its sign does not matter) is between 1 and 1000 where there is one. Known SI units:
// s Hz m m/s m/s^2 (drawn in g = 9.80665 m/s^2) m^2 N Pa J kg kg/m^3; any other stays as it is.
EngineeringUnit engineering_unit(const std::string& si_unit, double largest);

// "30.6 kN", "120 µs", "0.5 %" ("%" is a unit like another): `digits` significant ones; "not a number", "infinite".
std::string with_unit(double value, const std::string& si_unit, int digits = 3);

// In a unit that is given, as all numbers of a column: "0.85 kN".
std::string in_unit(double value, const EngineeringUnit& unit, int digits = 3);

// A coordinate (m): zero where it is but round-off of a part's own size.
inline double without_round_off(double x) { return x < 1e-12 && x > -1e-12 ? 0.0 : x; }

// Significant digits, no exponent between 1e-3 and 1e5, a true minus; else "1.2·10⁻⁶".
std::string plain_number(double value, int digits = 3);

}  // namespace dygita
