#include "foreign/file_units.hpp"

#include <spdlog/fmt/fmt.h>

#include <map>
#include <sstream>

#include "base/error.hpp"
#include "base/names.hpp"

namespace dygita {

namespace {

using UnitTable = std::map<std::string, double>;

const UnitTable lengths = {{"m", 1.0}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}, {"in", 0.0254}, {"ft", 0.3048}};
const UnitTable masses = {{"kg", 1.0}, {"t", 1e3}, {"g", 1e-3}, {"lb", 0.45359237}, {"slug", 14.59390294}};
const UnitTable forces = {{"N", 1.0}, {"kN", 1e3}, {"MN", 1e6}, {"lbf", 4.4482216152605}};
const UnitTable times = {{"s", 1.0}, {"ms", 1e-3}, {"us", 1e-6}};

std::string names_in(const UnitTable& table) {
  std::string names;
  for (const auto& [name, value] : table) names += (names.empty() ? "" : ", ") + name;
  return names;
}

}  // namespace

FileUnits file_units(const std::string& text) {
  std::istringstream words(text);
  std::string length, mass, time, more;
  words >> length >> mass >> time;
  const bool is_force = forces.contains(mass);
  if (!lengths.contains(length) || !(is_force || masses.contains(mass)) || !times.contains(time) || words >> more)
    throw InputError(
        fmt::format("'units' = \"{}\" is no system of units\n    it is a length ({}), a mass ({}) or a force ({}), and "
                    "a time ({}), as in \"mm t s\" or \"in lbf s\"",
                    printable(text), names_in(lengths), names_in(masses), names_in(forces), names_in(times)));
  FileUnits units{lengths.at(length), 1.0, times.at(time)};
  units.mass = is_force ? forces.at(mass) * units.time * units.time / units.length : masses.at(mass);
  return units;
}

}  // namespace dygita
