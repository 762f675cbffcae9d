// What was computed: interfaces, supports, steps with their loads, parameters of the deck.
#include <cmath>
#include <sstream>

#include "base/log.hpp"
#include "drawing/units.hpp"
#include "report/html.hpp"
#include "report/report_parts.hpp"

namespace dygita {

namespace {

std::string joined(const Json& list, const char* separator = ", ") {
  std::string result;
  for (const Json& item : list)
    if (item.is_string()) result += (result.empty() ? "" : separator) + item.get<std::string>();
  return result;
}

std::string count(double n) { return std::isfinite(n) ? fmt::format("{:.0f}", n) : ""; }

std::string in_unit(const std::string& text, const std::string& unit) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return text.empty() || *end != '\0' ? text : with_unit(value, unit);
}

// "yields at 640 MPa, hardens by 50 MPa per mm".
std::string law_of(const Json& object) {
  std::string law;
  for (const Json& remark : object.value("law", Json::object()).value("remarks", Json::array())) {
    std::string words = text(remark, "text");
    if (const size_t at = words.find("{}"); at != std::string::npos)
      words.replace(at, 2, with_unit(number(remark, "value"), text(remark, "unit")));
    law += (law.empty() ? "" : ", ") + words;
  }
  return law;
}

std::string loads_of(const Json& step) {
  std::string result;
  if (!step.contains("loads")) return "none";
  for (const Json& load : step["loads"]) {
    const std::string kind = text(load, "kind"), on = joined(load.value("on", Json::array()));
    result += (result.empty() ? "" : "; ") + kind + (on.empty() ? "" : " on " + on);
    const Json values = load.value("value", Json::array()), axes = load.value("axes", Json::array());
    for (size_t i = 0; i < values.size(); ++i)
      if (values[i].is_string())
        result += (i < axes.size() ? ", " + axes[i].get<std::string>() + ": " : ", ") +
                  history_text(values[i].get<std::string>(), text(load, "unit"));
    const Json settings = load.value("settings", Json::object());
    for (const auto& [name, numbers] : settings.items()) {
      result += ", " + name;
      for (const Json& one : numbers) result += " " + plain_number(one.get<double>());
    }
  }
  return result.empty() ? "none" : result;
}

std::string vector_of(const Json& three, const char* unit) {
  std::string all;
  for (const Json& one : three) all += (all.empty() ? "" : ", ") + plain_number(one.get<double>());
  return "(" + all + ") " + unit;
}

// "; free in space, accelerated by (0, 0, 12) m/s^2 at its centre of mass and (0, 3, 0) rad/s^2".
std::string free_of(const Json& step) {
  const std::string is_free = step.value("is_free", false) ? "; free in space" : "";
  if (!step.contains("inertia_relief")) return is_free;
  const Json& relief = step["inertia_relief"];
  return (is_free.empty() ? "; inertia relief: " : is_free + ", ") + "accelerated by " +
         vector_of(relief.at("acceleration"), "m/s^2") + " at its centre of mass and " +
         vector_of(relief.at("angular_acceleration"), "rad/s^2");
}

std::string length_of(const Json& step) {
  const double n = number(step, "increments"), asked = number(step, "asked_increments"), dt = number(step, "dt");
  std::string result = count(n) + (asked > n ? " of " + count(asked) : "") + (n == 1.0 ? " increment" : " increments");
  if (std::isfinite(dt)) result += " of " + with_unit(dt, "s") + ": " + with_unit(n * dt, "s");
  return result;
}

// The header; the last column is taken off where it holds nothing.
std::vector<std::string> without_last(std::vector<std::vector<std::string>>& rows, std::vector<std::string> header) {
  for (const std::vector<std::string>& row : rows)
    if (!row.back().empty()) return header;
  for (std::vector<std::string>& row : rows) row.pop_back();
  header.pop_back();
  return header;
}

}  // namespace

std::string history_text(const std::string& description, const std::string& unit) {
  const size_t open = description.find('(');
  if (open == std::string::npos || description.back() != ')') return description;
  const std::string name = description.substr(0, open),
                    inside = description.substr(open + 1, description.size() - open - 2);
  if (name == "constant") return in_unit(inside, unit);
  if (name == "file" || name == "piecewise") return name + ", " + inside;
  if (name == "step") {
    const size_t at = inside.find(" at ");
    if (at == std::string::npos) return description;
    return "step to " + in_unit(inside.substr(0, at), unit) + " at " + in_unit(inside.substr(at + 4), "s");
  }
  std::string result = name == "half_sine" ? "half-sine" : name;
  std::istringstream words(inside);
  for (std::string part; std::getline(words, part, ',');) {
    if (!part.empty() && part.front() == ' ') part.erase(0, 1);
    const size_t space = part.find(' ');
    if (space == std::string::npos) return description;
    const std::string key = part.substr(0, space);
    const bool is_value = key == "peak" || key == "from" || key == "to";
    result += ", " + key + " " + in_unit(part.substr(space + 1), is_value ? unit : "s");
  }
  return result;
}

std::string computed_section(const RunFolder& run) {
  const Json& record = run.record();
  std::string body;
  std::vector<std::vector<std::string>> rows;
  const auto flush = [&](const std::string& title, std::vector<std::string> header) {
    const std::vector<std::string> kept = without_last(rows, header);
    if (!rows.empty()) body += html::table_under(title, html::table(kept, rows), rows.size());
    rows.clear();
  };
  for (const Json& step : record.at("steps"))
    rows.push_back({text(step, "name"), text(step, "kind"), length_of(step), loads_of(step) + free_of(step)});
  flush("Steps", {"step", "kind", "length", "loads"});
  for (const Json& interface : record.value("interfaces", Json::array()))
    rows.push_back({text(interface, "name"), text(interface, "kind"),
                    joined(interface.value("between", Json::array()), " — "), law_of(interface)});
  flush("Interfaces", {"interface", "kind", "between", "law"});
  for (const Json& support : record.value("supports", Json::array()))
    rows.push_back(
        {text(support, "name"), text(support, "kind"), joined(support.value("on", Json::array())), law_of(support)});
  flush("Supports", {"support", "kind", "on", "law"});
  const Json parameters = record.value("parameters", Json::object());
  for (const auto& [name, value] : parameters.items())
    rows.push_back({name, value.is_number() ? plain_number(value.get<double>(), 6) : "not a number"});
  flush("Parameters of the deck (SI)", {"parameter", "value"});
  return html::section("What was computed", body);
}

}  // namespace dygita
