#include "report/svg_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/log.hpp"

namespace dygita {

std::string coordinate(double value) {
  if (!std::isfinite(value)) return "0";
  const long tenths = std::lround(10.0 * value);
  if (tenths % 10 == 0) return std::to_string(tenths / 10);
  return fmt::format("{}{}.{}", tenths < 0 ? "-" : "", std::labs(tenths) / 10, std::labs(tenths) % 10);
}

const char* series_color(int i) {
  static constexpr std::array colors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7a5195"};
  return colors[static_cast<size_t>(std::max(i, 0)) % colors.size()];
}

std::string scale_color(double x) {
  static constexpr double stops[][3] = {{68, 1, 84},    {71, 44, 122}, {59, 81, 139},  {44, 113, 142}, {33, 144, 141},
                                        {39, 173, 129}, {92, 200, 99}, {170, 220, 50}, {253, 231, 37}};
  constexpr int n = 8;
  const double place = n * std::clamp(std::isfinite(x) ? x : 0.0, 0.0, 1.0);
  const int i = std::min(static_cast<int>(place), n - 1);
  const auto channel = [&](int c) { return std::lround(stops[i][c] + (place - i) * (stops[i + 1][c] - stops[i][c])); };
  return fmt::format("#{:02x}{:02x}{:02x}", channel(0), channel(1), channel(2));
}

}  // namespace dygita
