#include "drawing/svg_text.hpp"

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

std::string series_color(int i) {
  // Chosen one after the other as far from all before them as colours can be (CIELAB), neither pale nor black.
  static constexpr std::array colors = {
      "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7a5195", "#0000ff", "#00dd00", "#ff00dd",
      "#554411", "#ff0066", "#0066ff", "#779900", "#ccbb99", "#771122", "#004444", "#660099", "#ee88ff", "#11dd77",
      "#ff0022", "#bb1188", "#ee8877", "#005500", "#bb11ff", "#553344", "#ccbbff", "#888899", "#55cccc", "#aa8833",
      "#003399", "#aa0011", "#99cc77", "#cccc00", "#009900", "#7788ee", "#0022cc", "#884400", "#557755", "#cc4466"};
  const auto place = static_cast<size_t>(std::max(i, 0));
  if (place < colors.size()) return colors[place];
  // Hues by the golden ratio never meet; three lightnesses keep neighbours apart.
  const double hue = 6.0 * std::fmod(0.618033988749895 * static_cast<double>(place), 1.0);
  const double value = 0.55 + 0.2 * static_cast<double>(place % 3);
  const auto channel = [&](double offset) {
    const double k = std::fmod(offset + hue, 6.0);
    return std::lround(255.0 * value * (1.0 - 0.75 * std::clamp(std::min(k, 4.0 - k), 0.0, 1.0)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", channel(5.0), channel(3.0), channel(1.0));
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

std::string open_svg(double width, double height, const std::string& title) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" role=\"img\" "
      "aria-label=\"{2}\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"13\" fill=\"#222222\">\n"
      "<title>{2}</title>\n",
      coordinate(width), coordinate(height), escaped(title));
}

}  // namespace dygita
