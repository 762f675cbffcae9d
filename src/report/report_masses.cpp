// Parts with mass, material and size: where a unit slip shows.
#include <algorithm>
#include <cmath>

#include "base/log.hpp"
#include "drawing/quantities.hpp"
#include "drawing/units.hpp"
#include "report/html.hpp"
#include "report/part_groups.hpp"
#include "report/report_parts.hpp"

namespace dygita {

namespace {

double at(const Json& part, const char* corner, size_t axis) {
  const Json place = part.value(corner, Json::array());
  if (axis >= place.size() || !place[axis].is_number()) return std::nan("");
  return without_round_off(place[axis].get<double>());
}

// Runs of earlier versions have neither masses nor boxes.
bool has_bodies(const Json& parts) {
  return std::any_of(parts.begin(), parts.end(), [](const Json& part) { return std::isfinite(number(part, "mass")); });
}

// "120 × 80 × 45 mm": all of them in one unit.
std::string size_text(const double (&size)[3], const EngineeringUnit& unit) {
  std::string result;
  for (const double length : size) result += (result.empty() ? "" : " × ") + plain_number(length / unit.size);
  return result + "\u00a0" + unit.name;
}

struct Box {
  double low[3] = {1e300, 1e300, 1e300}, high[3] = {-1e300, -1e300, -1e300};
};

void add(const Json& part, Box& box) {
  for (size_t axis = 0; axis < 3; ++axis) {
    box.low[axis] = std::min(box.low[axis], at(part, "low", axis));
    box.high[axis] = std::max(box.high[axis], at(part, "high", axis));
  }
}

std::string size_of(const Box& box, const EngineeringUnit& unit) {
  const double size[3] = {box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]};
  return size_text(size, unit);
}

std::string in_all(const Json& parts, const Box& whole, double mass) {
  double longest = 0.0;
  for (int axis = 0; axis < 3; ++axis) longest = std::max(longest, whole.high[axis] - whole.low[axis]);
  return html::paragraph(fmt::format("{} part{}, {} in all, {}.", parts.size(), parts.size() == 1 ? "" : "s",
                                     with_unit(mass, "kg", 4), size_of(whole, engineering_unit("m", longest))));
}

std::string table_of_parts(const Json& parts, const Box& whole) {
  double longest = 0.0;
  for (int axis = 0; axis < 3; ++axis) longest = std::max(longest, whole.high[axis] - whole.low[axis]);
  const EngineeringUnit unit = engineering_unit("m", longest);
  const bool is_cut = std::any_of(parts.begin(), parts.end(), [](const Json& p) { return number(p, "pieces") > 1.0; });
  const bool has_body = has_bodies(parts);
  std::vector<std::string> header = {"part", "material"};
  if (has_body) header.insert(header.end(), {"mass", "bounding box, x × y × z", "from"});
  header.insert(header.end(), {"nodes", "cells"});
  if (is_cut) header.push_back("pieces");
  Cells rows;
  for (const PartGroup& group : part_groups(parts)) {
    const Json& part = parts[group.first];
    std::vector<TableCell> row = {group.n > 1 ? group.name + ", each" : group.name, text(part, "material")};
    if (has_body) {
      Box box;
      add(part, box);
      row.emplace_back(number(part, "mass"), "kg", 4);
      row.emplace_back(size_of(box, unit));
      std::string from;
      for (const double x : box.low) from += (from.empty() ? "(" : ", ") + plain_number(x / unit.size);
      row.emplace_back(from + ")\u00a0" + unit.name);
    }
    for (const char* key : {"nodes", "cells"}) row.emplace_back(fmt::format("{:.0f}", number(part, key)));
    if (is_cut) row.emplace_back(number(part, "pieces") > 1.0 ? fmt::format("{:.0f}", number(part, "pieces")) : "");
    rows.push_back(std::move(row));
  }
  return html::table(header, in_common_units(rows), true);
}

// "138 / 9 / 9 GPa" of a material with directions, "0.3 / 0.3 / 0.45"; the one number of others.
TableCell of_axes(const Json& part, const char* same, std::initializer_list<const char*> along,
                  const std::string& si_unit) {
  if (!part.contains(*along.begin())) return {number(part, same), si_unit};
  double largest = 0.0;
  for (const char* key : along) largest = std::max(largest, std::abs(number(part, key)));
  const EngineeringUnit unit = engineering_unit(si_unit, largest);
  std::string text;
  for (const char* key : along) text += (text.empty() ? "" : " / ") + plain_number(number(part, key) / unit.size);
  return text + (unit.name.empty() ? "" : "\u00a0" + unit.name);
}

// Each material once, with what it weighs.
std::string table_of_materials(const Json& parts) {
  Cells rows;
  std::vector<Json> seen;
  const bool has_axes = std::any_of(parts.begin(), parts.end(), [](const Json& part) { return part.contains("g12"); });
  for (const Json& part : parts) {
    if (part.contains("condensed")) continue;
    Json key = {text(part, "material")};
    for (const char* value : {"young", "poisson", "e1", "e2", "e3", "nu12", "nu13", "nu23", "g12", "g13", "g23",
                              "density", "yield", "strength", "plies"})
      key.push_back(part.value(value, Json()));
    if (std::find(seen.begin(), seen.end(), key) != seen.end()) continue;
    seen.push_back(key);
    double mass = 0.0;
    for (const Json& other : parts)
      if (text(other, "material") == text(part, "material")) mass += number(other, "mass");
    rows.push_back(
        {text(part, "material"), of_axes(part, "young", {"e1", "e2", "e3"}, "Pa"),
         of_axes(part, "poisson", {"nu12", "nu13", "nu23"}, ""), TableCell(number(part, "density"), "kg/m^3", 4),
         std::isfinite(number(part, "yield")) ? TableCell(number(part, "yield"), "Pa") : TableCell("none given"),
         TableCell(mass, "kg", 4)});
    if (has_axes) rows.back().insert(rows.back().begin() + 3, of_axes(part, "", {"g12", "g13", "g23"}, "Pa"));
  }
  std::vector<std::string> header = {"material", "Young's modulus", "Poisson's ratio",
                                     "density",  "yield",           "mass in all"};
  if (has_axes) header.insert(header.begin() + 3, "shear moduli (12 / 13 / 23)");
  return html::table(header, in_common_units(rows), true);
}

}  // namespace

std::string masses_section(const RunFolder& run) {
  const Json parts = run.record().value("substructures", Json::array());
  if (!parts.is_array() || parts.empty()) return "";
  Box whole;
  double mass = 0.0;
  for (const Json& part : parts) {
    add(part, whole);
    mass += number(part, "mass");
  }
  std::string body;
  if (has_bodies(parts)) body = in_all(parts, whole, mass);
  body += table_of_parts(parts, whole);
  if (has_bodies(parts)) body += table_of_materials(parts);
  return html::section("Parts", body);
}

}  // namespace dygita
