// The facets of a joint laid flat, at a few instants: state, pressure, slip or plastic opening.
#include <algorithm>
#include <cmath>
#include <map>

#include "base/log.hpp"
#include "drawing/svg_text.hpp"
#include "drawing/units.hpp"
#include "report/html.hpp"
#include "report/report_parts.hpp"

namespace dygita {

namespace {

constexpr int n_levels = 12;
constexpr double map_space = 132.0, left = 92.0, top = 40.0, gap = 14.0, scale_space = 118.0;  // px

const char* state_color(int state) { return state == 0 ? "#dddddd" : state == 1 ? "#0072b2" : "#e69f00"; }

struct Grid {
  double unit = 1.0;                 // px of a unit of the corners
  double width = 0.0, height = 0.0;  // px, of a map
};

Grid grid_of(const Json& joint) {
  const double unit = number(joint, "unit"), across = joint.at("size").at(0).get<double>() / unit,
               up = joint["size"].at(1).get<double>() / unit;
  const double pixels = std::min(map_space / std::max(across, 1.0), 150.0 / std::max(up, 1.0));
  return {pixels, across * pixels, up * pixels};
}

std::string path_of(const Json& cell, const Grid& grid) {
  std::string path;
  for (size_t k = 0; k + 1 < cell.size(); k += 2)
    path += (k == 0   ? "M"
             : k == 2 ? "L"
                      : " ") +
            coordinate(cell[k].get<double>() * grid.unit) + " " +
            coordinate(grid.height - cell[k + 1].get<double>() * grid.unit);
  return path + "z";
}

// One map: cells of one colour in one path.
std::string map_of(const std::vector<std::string>& paths, const std::vector<std::string>& colors, double x, double y,
                   const Grid& grid) {
  std::map<std::string, std::string> of_color;
  for (size_t i = 0; i < paths.size(); ++i) of_color[colors[i]] += paths[i];
  std::string result = fmt::format("<g transform=\"translate({} {})\" stroke-width=\"0.4\">\n",
                                   coordinate(x + 0.5 * (map_space - grid.width)), coordinate(y));
  for (const auto& [color, path] : of_color)
    result += fmt::format("<path fill=\"{0}\" stroke=\"{0}\" d=\"{1}\"/>\n", color, path);
  return result + "</g>\n";
}

std::string words(double x, double y, const std::string& text, const char* anchor = "start") {
  return fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"{}\">{}</text>\n", coordinate(x), coordinate(y), anchor,
                     escaped(text));
}

struct MapRow {
  const char *key, *name, *unit;
};

// Largest value of a quantity over all instants and cells.
double largest(const Json& joint, const char* key) {
  double high = 0.0;
  for (const Json& instant : joint.at("instants"))
    if (instant.contains(key))
      for (const Json& value : instant[key])
        if (value.is_number()) high = std::max(high, std::abs(value.get<double>()));
  return high;
}

std::string state_scale(double x, double y, bool is_contact) {
  std::string result;
  const std::pair<int, const char*> states[] = {
      {1, is_contact ? "sticking" : "elastic"}, {2, is_contact ? "sliding" : "yielding"}, {0, "open"}};
  for (const auto& [state, name] : states) {
    if (!is_contact && state == 0) continue;
    result += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"12\" height=\"12\" fill=\"{}\"/>", coordinate(x),
                          coordinate(y), state_color(state)) +
              words(x + 18.0, y + 11.0, name);
    y += 18.0;
  }
  return result;
}

std::string value_scale(double x, double y, double high, const char* unit) {
  std::string result;
  for (int level = 0; level < n_levels; ++level)
    result += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"12\" height=\"6.4\" fill=\"{}\"/>", coordinate(x),
                          coordinate(y + 6.0 * (n_levels - 1 - level)), scale_color((level + 0.5) / n_levels));
  return result + words(x + 18.0, y + 10.0, with_unit(high, unit)) + words(x + 18.0, y + 6.0 * n_levels, "0");
}

int level_of(double share) { return share > 0.0 ? static_cast<int>(std::min(n_levels * share, n_levels - 1.0)) : 0; }

std::vector<std::string> colors_of(const Json& values, double high, bool is_state) {
  std::vector<std::string> colors;
  for (const Json& value : values) {
    if (is_state)
      colors.emplace_back(state_color(whole_number(value)));
    else if (!value.is_number())
      colors.emplace_back("#ff00ff");
    else
      colors.push_back(scale_color((level_of(value.get<double>() / high) + 0.5) / n_levels));
  }
  return colors;
}

}  // namespace

std::string maps_of_joint(const RunFolder& run, const Json& joint) {
  if (!joint.value("flat", false))
    return html::paragraph("'" + text(joint, "name") + "' is too curved to be drawn flat: no maps.");
  const Json& instants = joint.at("instants");
  if (instants.empty()) return "";
  const Grid grid = grid_of(joint);
  std::vector<std::string> paths;
  for (const Json& cell : joint.at("cells")) paths.push_back(path_of(cell, grid));
  std::vector<MapRow> rows = {{"state", "state", ""}};
  for (const MapRow& quantity : {MapRow{"pressure", "pressure", "Pa"}, MapRow{"slip", "slip", "m"},
                                 MapRow{"plastic_opening", "plastic opening", "m"}})
    if (largest(joint, quantity.key) > 0.0) rows.push_back(quantity);
  // Tension of a bolt reads better than a negative pressure.
  const bool is_contact = joint.value("contact", true);
  const double row_height = std::max(grid.height, 76.0) + gap + 6.0, column = map_space + gap;
  const double width = left + column * static_cast<double>(instants.size()) + scale_space,
               height = top + row_height * static_cast<double>(rows.size()) + 8.0;
  std::string drawing = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" role=\"img\" "
      "aria-label=\"{2}\" "
      "font-family=\"Helvetica, Arial, sans-serif\" font-size=\"13\" fill=\"#222222\">\n<title>{2}</title>\n",
      coordinate(width), coordinate(height), escaped("Maps of " + text(joint, "name")));
  bool has_missed = false;
  for (size_t i = 0; i < instants.size(); ++i) {
    const double x = left + column * static_cast<double>(i) + 0.5 * map_space;
    const bool is_static = instants[i].value("static", false);
    drawing += words(x, 14.0, text(instants[i], "step"), "middle") +
               words(x, 30.0,
                     (is_static ? "(static)" : with_unit(number(instants[i], "time"), "s")) +
                         (number(instants[i], "missed") > 0 ? " *" : ""),
                     "middle");
    has_missed |= number(instants[i], "missed") > 0;
  }
  for (size_t r = 0; r < rows.size(); ++r) {
    const double y = top + row_height * static_cast<double>(r), high = largest(joint, rows[r].key);
    const bool is_state = std::string(rows[r].key) == "state",
               is_tension = std::string(rows[r].key) == "pressure" && !is_contact;
    drawing += words(0.0, y + 0.5 * grid.height + 4.0, is_tension ? "tension" : rows[r].name);
    for (size_t i = 0; i < instants.size(); ++i) {
      if (!instants[i].contains(rows[r].key) || instants[i][rows[r].key].size() != paths.size()) continue;
      Json values = instants[i][rows[r].key];
      if (is_tension)
        for (Json& value : values)
          if (value.is_number()) value = -value.get<double>();
      drawing += map_of(paths, colors_of(values, high, is_state), left + column * static_cast<double>(i), y, grid);
    }
    const double x = width - scale_space + 6.0;
    drawing += is_state ? state_scale(x, y, is_contact) : value_scale(x, y, high, rows[r].unit);
  }
  drawing += "</svg>\n";
  const Json axes = joint.value("axes", Json::array());
  std::string caption = "'" + text(joint, "name") + "' laid flat";
  if (axes.size() == 2 && axes[0].is_string() && axes[1].is_string())
    caption += ", " + axes[0].get<std::string>() + " to the right, " + axes[1].get<std::string>() + " up";
  caption += fmt::format(", {} by {}.", with_unit(joint.at("size").at(0).get<double>(), "m"),
                         with_unit(joint["size"].at(1).get<double>(), "m"));
  if (has_missed) caption += " *: after increments that have NOT CONVERGED.";
  return doubted_figure(run, drawing, caption);
}

}  // namespace dygita
