// What contacts did, in a table; of each joint that has changed areas by state, forces, loops, works, maps.
#include <algorithm>
#include <cmath>

#include "base/log.hpp"
#include "base/name_list.hpp"
#include "drawing/quantities.hpp"
#include "drawing/units.hpp"
#include "report/contacts.hpp"
#include "report/html.hpp"
#include "report/report_parts.hpp"

namespace dygita {

namespace {

constexpr const char* stick_color = "#0072b2";
constexpr const char* slip_color = "#e69f00";
constexpr const char* open_color = "#c8c8c8";

Plot small_plot(const std::string& title, const PlotAxis& x, const PlotAxis& y) {
  Plot plot{.title = title, .x = x, .y = y};
  plot.width = 530;
  plot.height = 270;
  return plot;
}

double largest(const std::vector<double>& values) {
  double max = 0.0;
  for (const double v : values)
    if (std::isfinite(v)) max = std::max(max, std::abs(v));
  return max;
}

std::pair<double, double> range(const std::vector<double>& values) {
  double low = 0.0, high = 0.0;
  bool is_first = true;
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    low = is_first ? v : std::min(low, v);
    high = is_first ? v : std::max(high, v);
    is_first = false;
  }
  return {low, high};
}

struct JointKind {
  bool yields = false, has_states = true;  // open, stick, slide
};

// Of the interfaces that an output is on; a wall is none of them, and a contact.
JointKind kind_of(const RunFolder& run, const Json& output) {
  JointKind kind;
  for (const Json& interface : run.record().value("interfaces", Json::array()))
    for (const Json& on : output.value("on", Json::array())) {
      if (!on.is_string() || on.get<std::string>() != text(interface, "name")) continue;
      const Json law = interface.value("law", Json::object());
      kind.yields |= law.value("yields", false);
      kind.has_states &= law.value("has_states", true);
    }
  return kind;
}

constexpr double noise = 1e-6;              // of the largest force: not worth a curve
constexpr double smallest_opening = 1e-12;  // m: what closed points are apart is rounding

// Runs of earlier versions have no such column.
std::vector<double> damping_work(const Table& t) {
  const bool has_column = std::find(t.names.begin(), t.names.end(), "damping_work") != t.names.end();
  return has_column ? t.column("damping_work") : std::vector<double>(static_cast<size_t>(t.n_rows()), 0.0);
}

// What a joint did, in a sentence or two.
std::string summary(const Table& t, const JointKind& kind) {
  auto [low, high] = range(t.column("normal"));
  const double most = std::max(std::abs(low), std::abs(high));
  for (double* force : {&low, &high})
    if (std::abs(*force) < noise * most) *force = 0.0;
  const std::string from = with_unit(low, "N"), to = with_unit(high, "N");
  std::string line =
      (from == to ? "Normal force " + from : "Normal force from " + from + " to " + to) + " (pressed is negative)";
  if (const double shear = largest(t.column("shear")); shear > noise * most)
    line += ", shear up to " + with_unit(shear, "N");
  const std::vector<double>&open = t.column("open_area"), &stick = t.column("stick_area"),
        &slip = t.column("slip_area");
  double most_open = 0.0, most_slip = 0.0;
  for (size_t i = 0; i < open.size(); ++i) {
    const double all = open[i] + stick[i] + slip[i];
    if (!(all > 0.0)) continue;
    most_open = std::max(most_open, open[i] / all);
    most_slip = std::max(most_slip, slip[i] / all);
  }
  if (!kind.has_states) {
    line += ". Its sides move by up to " + with_unit(largest(t.column("opening")), "m") + " along the normal";
    if (largest(t.column("slip")) > 0.0) line += ", " + with_unit(largest(t.column("slip")), "m") + " across it";
  } else if (kind.yields) {
    line += most_slip > 0.0 ? fmt::format(". It yields on up to {:.0f} % of its area", 100.0 * most_slip)
                            : ". It never yields";
    if (largest(t.column("plastic_opening")) > 0.0)
      line += ", by up to " + with_unit(largest(t.column("plastic_opening")), "m");
  } else {
    line += most_open > 0.0 ? fmt::format(". It opens on up to {:.0f} % of its area, by up to {}", 100.0 * most_open,
                                          with_unit(largest(t.column("opening")), "m"))
                            : ". It stays closed";
    if (most_slip > 0.0)
      line += fmt::format("; up to {:.0f} % slides, by up to {}", 100.0 * most_slip,
                          with_unit(largest(t.column("slip")), "m"));
  }
  if (const double work = t.column("friction_work").back(); work > 0.0)
    line += ". Friction dissipates " + with_unit(work, "J");
  if (const double work = t.column("plastic_work").back(); work > 0.0)
    line += ". Yielding dissipates " + with_unit(work, "J");
  if (const double work = damping_work(t).back(); work > 0.0) line += ". Damping dissipates " + with_unit(work, "J");
  return line + ".";
}

std::string loop(const RunFolder& run, const Table& t, const std::string& title, const char* x, const char* y) {
  const std::vector<double>&across = t.column(x), &up = t.column(y);
  const auto [low, high] = range(across);
  if (!(high - low > smallest_opening) || across.size() < 3 || largest(up) <= noise * largest(t.column("normal")))
    return "";
  std::string quantity = x;
  std::replace(quantity.begin(), quantity.end(), '_', ' ');
  Plot plot = small_plot(title, {quantity, "m"}, {std::string(y) + " force", "N"});
  plot.lines.push_back({"", across, up, {}, false, false, 1.2});
  plot.marks = {{across.front(), up.front(), "start"}, {across.back(), up.back(), "end"}};
  return doubted_figure(run, svg(plot), title + ".");
}

std::string works(const RunFolder& run, const Table& t, const TimeAxis& time) {
  Plot plot = small_plot("Work of the joint", time.axis(), {"energy dissipated", "J"});
  time.shade(plot);
  const std::vector<double> places = time.places(t);
  for (const char* work : {"friction_work", "plastic_work"})
    if (largest(t.column(work)) > 0.0)
      plot.lines.push_back({work == std::string("friction_work") ? "friction" : "yielding", places, t.column(work)});
  if (const std::vector<double> work = damping_work(t); largest(work) > 0.0) {
    plot.lines.push_back({"damping", places, work});
    return doubted_figure(run, svg(plot), "Energy dissipated by the joint.");
  }
  return plot.lines.empty() ? "" : doubted_figure(run, svg(plot), "Energy dissipated by friction and yielding.");
}

// In the dynamic steps, where there are any: opens, slides or yields; what has no such states always.
bool has_changed(const RunFolder& run, const Table& t, const JointKind& kind) {
  if (!kind.has_states) return true;
  const Json& steps = run.record().at("steps");
  const auto is_dynamic = [&](int step) { return text(steps.at(static_cast<size_t>(step)), "kind") == "dynamic"; };
  const bool moves = std::any_of(t.step.begin(), t.step.end(), is_dynamic);
  const std::vector<double>&open = t.column("open_area"), &stick = t.column("stick_area"),
        &slip = t.column("slip_area");
  double least = 1.0, most = 0.0, most_slip = 0.0;
  for (size_t i = 0; i < open.size(); ++i) {
    const double all = open[i] + stick[i] + slip[i];
    if (!(all > 0.0) || (moves && !is_dynamic(t.step[i]))) continue;
    least = std::min(least, open[i] / all);
    most = std::max(most, open[i] / all);
    most_slip = std::max(most_slip, slip[i] / all);
  }
  constexpr double seen = 0.01;  // of the area
  return most - least > seen || most_slip > seen || largest(t.column("plastic_opening")) > smallest_opening;
}

std::string joint_part(const RunFolder& run, const Json& output, const Table& t, const TimeAxis& time) {
  const JointKind kind = kind_of(run, output);
  const bool yields = kind.yields;
  const std::vector<double> places = time.places(t);
  Plot area = small_plot("Area by state", time.axis(), {"area", "m^2"});
  time.shade(area);
  area.stacked = {{yields ? "elastic" : "sticking", places, t.column("stick_area"), stick_color},
                  {yields ? "yielding" : "sliding", places, t.column("slip_area"), slip_color},
                  {"open", places, t.column("open_area"), open_color}};
  if (yields && largest(t.column("open_area")) == 0.0) area.stacked.pop_back();
  Plot force = small_plot("Force through the joint", time.axis(), {"force", "N"});
  time.shade(force);
  for (const char* name : {"normal", "shear"})
    if (force.lines.empty() || largest(t.column(name)) > noise * largest(t.column("normal")))
      force.lines.push_back({name, places, t.column(name), {}, false, t.n_rows() < 30});

  std::string on;
  for (const Json& place : output.value("on", Json::array()))
    if (place.is_string()) on += (on.empty() ? "" : ", ") + place.get<std::string>();
  std::string body = html::heading(text(output, "name") + " on " + on) + html::paragraph(summary(t, kind));
  body +=
      html::row({doubted_figure(run, svg(force),
                                force.lines.size() > 1 ? "Normal and shear force on side 1 against time."
                                                       : "Normal force on side 1 against time; shear is negligible."),
                 kind.has_states ? doubted_figure(run, svg(area), "Area of the joint in each state.") : "",
                 loop(run, t, "Normal force against opening", yields ? "plastic_opening" : "opening", "normal"),
                 loop(run, t, "Shear force against slip", "slip", "shear"), works(run, t, time)});
  if (!run.scenes().is_object() || !run.scenes().contains("joints")) return body;
  for (const Json& joint : run.scenes()["joints"])
    for (const Json& place : output.value("on", Json::array()))
      if (place.is_string() && place.get<std::string>() == text(joint, "name")) body += maps_of_joint(run, joint);
  return body;
}

std::vector<TableCell> row_of(const Contact& c) {
  const auto share = [](double of_one) { return TableCell(std::isfinite(of_one) ? 100.0 * of_one : of_one, "%", 2); };
  return {c.name + (c.slides() && c.parts() ? " (slides, parts)"
                    : c.slides()            ? " (slides)"
                    : c.parts()             ? " (parts)"
                                            : ""),
          TableCell(c.at_rest, "N"),
          TableCell(c.lowest, "N"),
          TableCell(c.highest, "N"),
          TableCell(c.shear, "N"),
          share(c.closed),
          TableCell(c.opening, "m", 2),
          share(c.sliding),
          TableCell(c.slip, "m", 2),
          share(c.friction_used)};
}

// Every contact, whether an output asks for it or not.
std::string table_of_contacts(const Json& record) {
  const std::vector<Contact> contacts = contacts_of(record);
  if (contacts.empty()) return "";
  constexpr size_t most_open = 15;
  Cells rows;
  double opens = 0.0;
  for (const Contact& contact : contacts) opens = std::fmax(opens, contact.opening);
  for (Contact contact : contacts) {
    if (is_rounding(contact.opening, opens)) contact.opening = 0.0;
    rows.push_back(row_of(contact));
  }
  const std::vector<std::vector<std::string>> all = in_common_units(rows);
  const auto table = [](auto first, auto last) {
    return html::table({"contact", "pressed at rest", "pressed, lowest", "highest", "shear", "closed, least",
                        "opens by", "slides, most", "slips by", "friction used"},
                       {first, last}, true);
  };
  const auto middle = all.begin() + static_cast<long>(std::min(most_open, all.size()));
  std::string body = html::heading(fmt::format("Every contact ({})", contacts.size())) + table(all.begin(), middle);
  if (middle != all.end())
    body += html::folded(fmt::format("The other {} contacts", all.end() - middle), table(middle, all.end()));
  return body +
         html::paragraph(
             "Nearest to sliding first. At rest: at the end of the static steps before the motion; all else during the "
             "motion, or at the end of the last static step where nothing moves. Closed: smallest share of the area; "
             "slides: largest share of the closed area at once; opens by: the largest opening of points that were "
             "closed "
             "when the step began; slips by: the largest since then; friction used: shear over friction times what "
             "presses, or the moment of the shear about the contact's middle over what friction holds of it, where "
             "that is "
             "more, but for instants of less than a thousandth of the largest normal force. A contact slides as a "
             "whole where all "
             "of it slips at some instant and half of its friction or more is used, and parts where none of it "
             "touches.");
}

}  // namespace

std::string joints_section(const RunFolder& run, const TimeAxis& time) {
  std::string parts;
  std::vector<std::string> unchanged;
  for (const Json& output : run.outputs(Display::As::joint)) {
    const Table t =
        run.table(text(output, "file"), {"normal", "shear", "opening", "slip", "plastic_opening", "open_area",
                                         "stick_area", "slip_area", "friction_work", "plastic_work"});
    if (t.n_rows() == 0) continue;
    if (has_changed(run, t, kind_of(run, output)))
      parts += joint_part(run, output, t, time);
    else
      unchanged.push_back(text(output, "name"));
  }
  std::string body = table_of_contacts(run.record());
  if (const std::string table = table_of_joints(run); !table.empty())
    body += html::heading("Joints that outputs are on") + table;
  if (!unchanged.empty())
    body += html::paragraph(
        fmt::format("Without charts, since nothing opens, slides or yields: {}. Forces over time are in the tables.",
                    list_of_names(unchanged)));
  return doubted_section(run, "Joints", body + parts);
}

}  // namespace dygita
