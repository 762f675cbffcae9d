// The assembly as SVG: facets back to front, by part or by von Mises stress, the undeformed outline over it. Longer
// than most, since all of it draws the same facets.
#include <algorithm>
#include <cmath>
#include <complex>

#include "base/log.hpp"
#include "drawing/svg_text.hpp"
#include "drawing/units.hpp"
#include "report/html.hpp"
#include "report/part_groups.hpp"
#include "report/report_parts.hpp"
#include "report/stress_scale.hpp"

namespace dygita {

namespace {

constexpr int n_picture_levels = 16;

// Facets as the file has them: part, light, value, number of corners, corners.
struct DrawnFacet {
  int part, light, value;
  const Json* list;
  size_t first, n;
};

std::vector<DrawnFacet> facets_of(const Json& picture) {
  std::vector<DrawnFacet> facets;
  const Json& list = picture.at("facets");
  for (size_t i = 0; i + 4 <= list.size();) {
    const auto n = static_cast<size_t>(whole_number(list[i + 3]));
    if (n < 3 || n > 4 || i + 4 + 2 * n > list.size()) break;
    facets.push_back({whole_number(list[i]), whole_number(list[i + 1]), whole_number(list[i + 2]), &list, i + 4, n});
    i += 4 + 2 * n;
  }
  return facets;
}

std::string path_of(const DrawnFacet& facet) {
  const auto at = [&](size_t k) { return whole_number((*facet.list)[facet.first + k]); };
  std::string path = fmt::format("M{} {}l", at(0), at(1));
  for (size_t k = 1; k < facet.n; ++k)
    path += fmt::format("{}{} {}", k > 1 ? " " : "", at(2 * k) - at(2 * k - 2), at(2 * k + 1) - at(2 * k - 1));
  return path + "z";
}

std::string shaded(const std::string& color, int light) {
  const double factor = 0.62 + 0.0038 * light;
  std::string result = "#";
  for (int c = 0; c < 3; ++c)
    result += fmt::format(
        "{:02x}", std::clamp(static_cast<int>(std::lround(
                                 std::stoi(color.substr(1 + 2 * static_cast<size_t>(c), 2), nullptr, 16) * factor)),
                             0, 255));
  return result;
}

std::string pale(const std::string& color) {
  std::string result = "#";
  for (int c = 0; c < 3; ++c)
    result +=
        fmt::format("{:02x}", (2 * std::stoi(color.substr(1 + 2 * static_cast<size_t>(c), 2), nullptr, 16) + 225) / 3);
  return result;
}

std::string lines(const Json& edges, const char* style) {
  std::string path;
  for (const Json& e : edges)
    path += fmt::format("M{} {}L{} {}", whole_number(e.at(0)), whole_number(e.at(1)), whole_number(e.at(2)),
                        whole_number(e.at(3)));
  return path.empty() ? "" : fmt::format("<path d=\"{}\" fill=\"none\" {}/>\n", path, style);
}

// Pixels that a facet takes, in tenths of a pixel squared.
double area_of(const DrawnFacet& facet) {
  const auto at = [&](size_t k) { return (*facet.list)[facet.first + k % (2 * facet.n)].get<double>(); };
  double twice = 0.0;
  for (size_t k = 0; k < facet.n; ++k) twice += at(2 * k) * at(2 * k + 3) - at(2 * k + 2) * at(2 * k + 1);
  return 0.5 * std::abs(twice);
}

std::string axes_of(const Json& picture, double height) {
  std::string result;
  const char* names = "xyz";
  for (size_t axis = 0; axis < 3 && axis < picture.at("axes").size(); ++axis) {
    const double x = 0.03 * picture["axes"][axis].at(0).get<double>(),
                 y = 0.03 * picture["axes"][axis].at(1).get<double>();
    const double x_0 = 40.0, y_0 = height - 40.0;
    result += fmt::format(
        "<path d=\"M{} {}l{} {}\" stroke=\"#222222\" stroke-width=\"1.5\"/><text x=\"{}\" y=\"{}\" "
        "text-anchor=\"middle\">{}</text>\n",
        x_0, coordinate(y_0), coordinate(x), coordinate(y), coordinate(x_0 + 1.3 * x), coordinate(y_0 + 1.3 * y + 4.0),
        names[axis]);
  }
  return result;
}

// Facets of one colour that follow each other share a path.
std::string drawn(const std::vector<DrawnFacet>& facets, const std::vector<std::string>& colors) {
  std::string result, color, path;
  const auto flush = [&] {
    if (!path.empty()) result += fmt::format("<path fill=\"{0}\" stroke=\"{0}\" d=\"{1}\"/>\n", color, path);
    path.clear();
  };
  for (size_t i = 0; i < facets.size(); ++i) {
    if (colors[i] != color) flush();
    color = colors[i];
    path += path_of(facets[i]);
  }
  flush();
  return result;
}

// What is seen of a part, px, and where its number goes: the facet nearest to the middle of it.
struct SeenPart {
  size_t part = 0;
  double area = 0.0, n = 0.0, nearest = 1e300;
  std::complex<double> sum = 0.0, place = 0.0;
};

std::vector<SeenPart> seen_of(const std::vector<DrawnFacet>& facets, size_t n_parts) {
  const auto middle = [](const DrawnFacet& facet) {
    std::complex<double> sum{0.0, 0.0};
    for (size_t k = facet.first; k < facet.first + 2 * facet.n; k += 2)
      sum += std::complex((*facet.list)[k].get<double>(), (*facet.list)[k + 1].get<double>());
    return 0.1 / static_cast<double>(facet.n) * sum;
  };
  std::vector<SeenPart> seen(n_parts);
  const auto each = [&](const auto& visit) {
    for (const DrawnFacet& facet : facets)
      if (facet.part >= 0 && facet.part < static_cast<int>(n_parts))
        visit(facet, middle(facet), seen[static_cast<size_t>(facet.part)]);
  };
  each([](const DrawnFacet& facet, const std::complex<double>& at, SeenPart& of) {
    of.part = static_cast<size_t>(facet.part);
    of.area += area_of(facet);
    of.sum += at;
    of.n += 1.0;
  });
  each([](const DrawnFacet&, const std::complex<double>& at, SeenPart& of) {
    const double distance = std::abs(at - of.sum / of.n);
    if (distance >= of.nearest) return;
    of.nearest = distance;
    of.place = at;
  });
  std::erase_if(seen, [](const SeenPart& one) { return one.n == 0.0; });
  return seen;
}

// A number on each part (one for equal ones), the largest first: one that would cover another is left out.
std::string numbers(const std::vector<DrawnFacet>& facets, size_t n_parts) {
  std::vector<SeenPart> seen = seen_of(facets, n_parts), placed;
  std::stable_sort(seen.begin(), seen.end(), [](const SeenPart& a, const SeenPart& b) { return a.area > b.area; });
  std::string result;
  for (const SeenPart& one : seen) {
    const auto covers = [&](const SeenPart& other) {
      return std::abs((one.place - other.place).real()) < 18.0 && std::abs((one.place - other.place).imag()) < 12.0;
    };
    if (std::any_of(placed.begin(), placed.end(), covers)) continue;
    placed.push_back(one);
    result += fmt::format(
        "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\" font-weight=\"bold\" fill=\"#111111\" stroke=\"#ffffff\" "
        "stroke-width=\"3\" paint-order=\"stroke\">{}</text>\n",
        coordinate(one.place.real()), coordinate(one.place.imag() + 4.0), one.part + 1);
  }
  return result;
}

// "screw 1 ×4".
std::string short_name(const PartGroup& group, const Json& parts) {
  return group.n > 1 ? fmt::format("{} ×{}", text(parts[group.first], "name"), group.n) : group.name;
}

// Names of the colours, in three columns from `low` on.
std::string legend_of(const Json& parts, double width, double low, double row) {
  const std::vector<PartGroup> groups = part_groups(parts);
  std::string result;
  for (size_t i = 0; i < groups.size(); ++i) {
    const double x = 20.0 + (width - 20.0) / 3 * static_cast<double>(i % 3), y = low + row * static_cast<double>(i / 3);
    result += fmt::format(
        "<rect x=\"{}\" y=\"{}\" width=\"14\" height=\"14\" fill=\"{}\"/><text x=\"{}\" y=\"{}\">{}</text>\n",
        coordinate(x), coordinate(y), pale(series_color(static_cast<int>(i))), coordinate(x + 20.0),
        coordinate(y + 12.0),
        escaped((groups.size() > 1 ? fmt::format("{} ", i + 1) : "") + short_name(groups[i], parts)));
  }
  return result;
}

std::string by_part(const Json& picture, const Json& parts) {
  std::vector<DrawnFacet> facets = facets_of(picture);
  const std::vector<PartGroup> groups = part_groups(parts);
  const std::vector<int> group_of = group_of_parts(parts);
  for (DrawnFacet& facet : facets)
    if (facet.part >= 0 && facet.part < static_cast<int>(group_of.size()))
      facet.part = group_of[static_cast<size_t>(facet.part)];
  std::vector<std::string> colors;
  for (const DrawnFacet& facet : facets)
    colors.push_back(shaded(pale(series_color(facet.part)), 10 * (facet.light / 10)));
  const double width = number(picture, "width"), height = number(picture, "height");
  // Beside another with the same long list, the cut has none.
  constexpr size_t most_twice = 12;
  const bool has_legend = !picture.value("cut", false) || groups.size() <= most_twice;
  const double row = has_legend ? 20.0 : 0.0;
  std::string result = open_svg(width, height + row * (static_cast<double>(groups.size() + 2) / 3),
                                "The assembly, a colour for each part");
  result += "<g transform=\"scale(0.1)\" stroke-width=\"8\" stroke-linejoin=\"round\">\n" + drawn(facets, colors) +
            lines(picture.at("edges"), "stroke=\"#333333\" stroke-width=\"9\"") + "</g>\n" + axes_of(picture, height);
  if (groups.size() > 1) result += numbers(facets, groups.size());
  if (has_legend) result += legend_of(parts, width, height, row);
  return result + "</svg>\n";
}

// Superelements have no stress.
bool has_no_stress(const Json& parts, size_t part) { return part < parts.size() && parts[part].contains("condensed"); }

// What colours tell.
struct ColourScale {
  const char *name, *unit;
  bool is_of_cells;  // bodies without cells have none
};

// Of a place seen from near (close_up.hpp): the parts around it, under the part that it is on; a ring around it.
std::string around(const Json& picture) {
  return picture.contains("around") ? lines(picture["around"], "stroke=\"#c4c4c4\" stroke-width=\"7\"") : "";
}

std::string mark(const Json& picture) {
  if (!picture.contains("mark")) return "";
  const double x = 0.1 * picture["mark"].at(0).get<double>(), y = 0.1 * picture["mark"].at(1).get<double>();
  std::string rings;
  for (const auto& [color, width] : {std::pair("#ffffff", 5), std::pair("#d00000", 2)})
    rings += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"11\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"/>\n",
                         coordinate(x), coordinate(y), color, width);
  return rings;
}

std::string by_field(const Json& picture, const Json& parts, const std::string& title, const ColourScale& scale) {
  const std::vector<DrawnFacet> facets = facets_of(picture);
  const auto is_grey = [&](const DrawnFacet& facet) {
    return scale.is_of_cells && has_no_stress(parts, static_cast<size_t>(facet.part));
  };
  std::vector<std::pair<double, double>> values;  // with what they cover
  for (const DrawnFacet& facet : facets)
    if (!is_grey(facet)) values.emplace_back(facet.value, area_of(facet));
  const StressScale colours(values, n_picture_levels);
  const auto color_of_level = [](int level) { return scale_color((level + 0.5) / n_picture_levels); };
  std::vector<std::string> colors;
  for (const DrawnFacet& facet : facets)
    colors.push_back(is_grey(facet) ? "#bbbbbb" : color_of_level(colours.color(facet.value)));
  const double width = number(picture, "width"), height = number(picture, "height"),
               largest = number(picture, "largest");
  std::string result = open_svg(width, height + 54.0, title);
  result += "<g transform=\"scale(0.1)\" stroke-width=\"8\" stroke-linejoin=\"round\">\n" + around(picture) +
            drawn(facets, colors) +
            lines(picture.at("edges"), "stroke=\"#222222\" stroke-width=\"6\" stroke-opacity=\"0.7\"") +
            lines(picture.at("outline"), "stroke=\"#777777\" stroke-width=\"8\" stroke-dasharray=\"40 30\"") +
            "</g>\n" + mark(picture) + axes_of(picture, height);
  const double bar = 22.0 * n_picture_levels, bar_left = 0.5 * (width - bar);
  // What is around a part seen from near ends above the colours.
  if (picture.contains("around"))
    result += fmt::format("<rect x=\"0\" y=\"{}\" width=\"{}\" height=\"60\" fill=\"#ffffff\"/>\n",
                          coordinate(height - 4.0), coordinate(width));
  for (int level = 0; level < n_picture_levels; ++level)
    result += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"22.5\" height=\"12\" fill=\"{}\"/>\n",
                          coordinate(bar_left + 22.0 * level), coordinate(height), color_of_level(level));
  // Runs of earlier versions have thousandths.
  const double steps = number(picture, "value_steps"), unit = largest / (std::isfinite(steps) ? steps : 1000.0);
  const int n_between = colours.is_by_quantile() ? 4 : 1;
  for (int i = 0; i <= n_between; ++i) {
    const double value = unit * colours.ends()[static_cast<size_t>(i * n_picture_levels / n_between)];
    result += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}{}</text>\n",
                          coordinate(bar_left + bar * i / n_between), coordinate(height + 28.0),
                          i == n_between && colours.is_exceeded() ? "above " : "",
                          i == 0 ? "0" : escaped(with_unit(value, scale.unit, 2)));
  }
  result += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}{}</text>\n", coordinate(0.5 * width),
                        coordinate(height + 46.0), scale.name,
                        colours.is_by_quantile() ? ", by quantile: each colour covers as much of the picture" : "");
  if (number(picture, "missed") > 0)
    result += fmt::format(
        "<text x=\"{}\" y=\"16\" text-anchor=\"end\" font-weight=\"bold\" fill=\"#d55e00\">NOT CONVERGED"
        "</text>\n",
        coordinate(width - 6.0));
  return result + "</svg>\n";
}

// A part in one colour, shaded.
std::string by_light(const Json& picture, const std::string& title) {
  const std::vector<DrawnFacet> facets = facets_of(picture);
  std::vector<std::string> colors;
  for (const DrawnFacet& facet : facets) colors.push_back(shaded(pale(series_color(0)), 10 * (facet.light / 10)));
  const double height = number(picture, "height");
  return open_svg(number(picture, "width"), height, title) +
         "<g transform=\"scale(0.1)\" stroke-width=\"8\" stroke-linejoin=\"round\">\n" + around(picture) +
         drawn(facets, colors) + lines(picture.at("edges"), "stroke=\"#333333\" stroke-width=\"9\"") + "</g>\n" +
         mark(picture) + axes_of(picture, height) + "</svg>\n";
}

// Runs of earlier versions were cut through the middle only.
std::string cut_of(const Json& picture) {
  const std::string told = text(picture, "cut_text");
  return told.empty() ? "through the middle" : told;
}

std::string caption_of(const Json& picture, const Json& parts) {
  const double moved = number(picture, "largest_displacement"), scale = number(picture, "scale");
  std::string caption = picture.value("static", false)
                            ? "End of step '" + text(picture, "step") + "'"
                            : "The largest strain energy in the motion, step '" + text(picture, "step") + "', " +
                                  with_unit(number(picture, "time"), "s");
  if (!std::isfinite(moved)) return caption + ": displacements are not finite; drawn undeformed.";
  caption += fmt::format(": displacements up to {}, ", with_unit(moved, "m"));
  caption += scale == 0.0   ? (moved > 0.0 ? "beyond the picture; drawn undeformed" : "nothing moves")
             : scale == 1.0 ? "drawn to scale"
                            : "drawn " + plain_number(scale, 6) + " times as large";
  caption += "; von Mises stress up to " + with_unit(number(picture, "largest"), "Pa") + ".";
  if (const double missed = number(picture, "missed"); missed > 0)
    caption += fmt::format(" NOT CONVERGED: {:.0f} increment{} so far.", missed, missed == 1 ? "" : "s");
  if (picture.value("cut", false)) caption += " Cut " + cut_of(picture) + ".";
  for (size_t i = 0; i < parts.size(); ++i)
    if (has_no_stress(parts, i)) {
      caption += " Grey: superelements, which have no stress.";
      break;
    }
  return caption + (scale > 0.0 ? " Dashed: undeformed." : "");
}

std::string caption_of_limit(const Json& limit, const Json& parts) {
  const std::string kind = text(limit, "kind"), name = text(limit, "name");
  const Json place = limit.value("place", Json::array());
  std::string at;
  for (const Json& x : place)
    at += (at.empty() ? "" : ", ") + plain_number(1e3 * without_round_off(x.get<double>()), 4);
  const auto part = static_cast<size_t>(number(limit, "part"));
  const std::string instant =
      fmt::format("in step '{}', {}", text(limit, "step"), with_unit(number(limit, "time"), "s"));
  if (kind == "failure_index")
    return fmt::format("Highest failure index, {:.3g}: '{}', at ({}) mm. Colours: index {}.", number(limit, "value"),
                       name, at, instant);
  if (kind == "stress") {
    const double yield = part < parts.size() ? number(parts[part], "yield") : 0.0, peak = number(limit, "value");
    return fmt::format("Smallest margin against yield, {:.3g} %: '{}', {} of {}, at ({}) mm. Colours: stress {}.",
                       100.0 * (yield / peak - 1.0), name, with_unit(peak, "Pa"), with_unit(yield, "Pa"), at, instant);
  }
  return fmt::format("Largest {}: '{}', {}, at ({}) mm, on '{}'.", kind, name, with_unit(number(limit, "value"), "m"),
                     at, part < parts.size() ? text(parts[part], "name") : "");
}

}  // namespace

std::string limits_section(const RunFolder& run) {
  if (!run.scenes().is_object() || !run.scenes().contains("limits")) return "";
  std::vector<std::string> figures;
  const Json parts = run.record().value("substructures", Json::array());
  for (const Json& limit : run.scenes()["limits"]) {
    const std::string caption = caption_of_limit(limit, parts);
    const std::string kind = text(limit, "kind");
    figures.push_back(
        doubted_figure(run,
                       kind == "stress"          ? by_field(limit, parts, caption, {"von Mises stress", "Pa", true})
                       : kind == "failure_index" ? by_field(limit, parts, caption, {"failure index", "", true})
                                                 : by_light(limit, caption),
                       caption));
  }
  return doubted_section(run, "Closest to its limits", html::row(figures));
}

std::string picture_of_shape(const Json& picture, const Json& parts, const std::string& title) {
  return by_field(picture, parts, title, {"displacement, of the largest", "", false});
}

std::string picture_section(const RunFolder& run) {
  if (!run.scenes().is_object() || !run.scenes().contains("assembly")) return "";
  std::vector<std::string> figures;
  const Json parts = run.record().value("substructures", Json::array());
  for (const Json& picture : run.scenes()["assembly"]) {
    if (text(picture, "colour") == "part")
      figures.push_back(html::figure(by_part(picture, parts), picture.value("cut", false)
                                                                  ? "The same, cut " + cut_of(picture) + "."
                                                                  : "The assembly, undeformed."));
    else
      figures.push_back(
          html::figure(by_field(picture, parts, caption_of(picture, parts), {"von Mises stress", "Pa", true}),
                       caption_of(picture, parts)));
  }
  return html::section("The assembly", html::row(figures));
}

}  // namespace dygita
