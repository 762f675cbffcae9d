#include "drawing/units.hpp"

#include <cmath>
#include <map>
#include <vector>

#include "base/log.hpp"
#include "signal/unit.hpp"

namespace dygita {

namespace {

// From small to large.
const std::map<std::string, std::vector<EngineeringUnit>>& known_units() {
  static const std::map<std::string, std::vector<EngineeringUnit>> units = {
      {"s", {{1e-9, "ns"}, {1e-6, "µs"}, {1e-3, "ms"}, {1.0, "s"}}},
      {"Hz", {{1.0, "Hz"}, {1e3, "kHz"}, {1e6, "MHz"}}},
      {"m", {{1e-9, "nm"}, {1e-6, "µm"}, {1e-3, "mm"}, {1.0, "m"}}},
      {"m/s", {{1e-6, "µm/s"}, {1e-3, "mm/s"}, {1.0, "m/s"}}},
      {"m/s^2", {{standard_gravity, "g"}}},
      {"m^2", {{1e-6, "mm²"}, {1.0, "m²"}}},
      {"N", {{1e-3, "mN"}, {1.0, "N"}, {1e3, "kN"}, {1e6, "MN"}}},
      {"Pa", {{1.0, "Pa"}, {1e3, "kPa"}, {1e6, "MPa"}, {1e9, "GPa"}}},
      {"kg", {{1e-6, "mg"}, {1e-3, "g"}, {1.0, "kg"}, {1e3, "t"}}},
      {"kg/m^3", {{1.0, "kg/m³"}}},
      {"J", {{1e-9, "nJ"}, {1e-6, "µJ"}, {1e-3, "mJ"}, {1.0, "J"}, {1e3, "kJ"}}},
  };
  return units;
}

std::string superscript(int exponent) {
  static const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (const char c : std::to_string(std::abs(exponent))) text += digits[c - '0'];
  return text;
}

}  // namespace

EngineeringUnit engineering_unit(const std::string& si_unit, double largest) {
  const auto found = known_units().find(si_unit);
  if (found == known_units().end()) return {1.0, si_unit};
  const std::vector<EngineeringUnit>& units = found->second;
  if (!std::isfinite(largest) || largest == 0.0) {
    for (const EngineeringUnit& unit : units)
      if (unit.size == 1.0) return unit;
    return units.front();
  }
  EngineeringUnit chosen = units.front();
  for (const EngineeringUnit& unit : units)
    if (std::abs(largest) >= 0.9999 * unit.size) chosen = unit;
  // Areas of joints are read in mm² up to a hundredth of a square metre.
  if (si_unit == "m^2") chosen = std::abs(largest) < 1.0 ? units.front() : units.back();
  return chosen;
}

std::string plain_number(double value, int digits) {
  if (std::isnan(value)) return "not a number";
  if (std::isinf(value)) return value > 0 ? "infinite" : "minus infinite";
  if (value == 0.0) return "0";
  std::string text = fmt::format("{:.{}e}", value, digits - 1);
  const size_t e = text.find('e');
  const int exponent = std::stoi(text.substr(e + 1));
  if (exponent >= -3 && exponent < 5) {
    text = fmt::format("{:.{}f}", value, std::max(0, digits - 1 - exponent));
    if (text.find('.') != std::string::npos) {
      while (text.back() == '0') text.pop_back();
      if (text.back() == '.') text.pop_back();
    }
  } else {
    text = text.substr(0, e);
    if (text.find('.') != std::string::npos) {
      while (text.back() == '0') text.pop_back();
      if (text.back() == '.') text.pop_back();
    }
    text += "·10" + superscript(exponent);
    if (const size_t one = text.find("1·10"); one == 0 || (one == 1 && text[0] == '-'))
      text.erase(one, std::string("1·").size());
  }
  return text.front() == '-' ? "−" + text.substr(1) : text;
}

std::string with_unit(double value, const std::string& si_unit, int digits) {
  if (!std::isfinite(value)) return plain_number(value);
  return in_unit(value, engineering_unit(si_unit, value), digits);
}

std::string in_unit(double value, const EngineeringUnit& unit, int digits) {
  if (!std::isfinite(value)) return plain_number(value);
  const std::string number = plain_number(value / unit.size, digits);
  return unit.name.empty() ? number : number + "\u00a0" + unit.name;
}

}  // namespace dygita
