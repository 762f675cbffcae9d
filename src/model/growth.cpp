#include "model/growth.hpp"

#include <spdlog/fmt/fmt.h>

#include <cstdlib>

namespace dygita {

namespace {

constexpr std::string_view growth = "load.temperature of ";

}  // namespace

std::string growth_name(double expansion) { return fmt::format("{}{:.17g} 1/K", growth, expansion); }

std::optional<double> expansion_of(const std::string& key) {
  if (key.rfind(growth, 0) != 0) return std::nullopt;
  return std::strtod(key.c_str() + growth.size(), nullptr);
}

}  // namespace dygita
