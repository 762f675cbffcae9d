#include "drawing/part_color.hpp"

#include "base/log.hpp"
#include "drawing/svg_text.hpp"

namespace dygita {

std::string part_color(int i_part) {
  const std::string color = series_color(i_part);
  std::string result = "#";
  for (size_t c = 1; c < 7; c += 2)
    result += fmt::format("{:02x}", (2 * std::stoi(color.substr(c, 2), nullptr, 16) + 225) / 3);
  return result;
}

}  // namespace dygita
