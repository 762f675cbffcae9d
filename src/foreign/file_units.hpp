// Units of a file that states none: a consistent system, by its length, its mass or force, and its time.
#pragma once

#include <string>

namespace dygita {

struct FileUnits {
  double length = 1.0, mass = 1.0, time = 1.0;  // m, kg, s

  double stress() const { return mass / (length * time * time); }       // Pa
  double density() const { return mass / (length * length * length); }  // kg/m^3
  double force() const { return mass * length / (time * time); }        // N
  double acceleration() const { return length / (time * time); }        // m/s^2
};

// Of "mm t s", "mm kg ms", "in lbf s", "m kg s": length, then mass or force, then time. Throws InputError otherwise.
FileUnits file_units(const std::string& text);

}  // namespace dygita
