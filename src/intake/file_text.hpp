// What can be known of a CAD or .geo file from its text alone.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace dygita {

struct GeoFacts {
  std::vector<std::string> parameters;  // names declared with DefineConstant, sorted
  std::vector<std::string> unfinished;  // files without a newline at their end: gmsh 4.8 drops their last line silently
};

// Facts of a .geo and of the files it includes.
GeoFacts geo_facts(const std::string& file);

// Length (m) of the unit that a STEP file states, where it is a multiple of the metre.
std::optional<double> step_unit(const std::string& file);

}  // namespace dygita
