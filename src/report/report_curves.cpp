// Charts of histories.
#include <algorithm>
#include <cmath>
#include <map>

#include "base/log.hpp"
#include "base/name_list.hpp"
#include "drawing/units.hpp"
#include "report/html.hpp"
#include "report/report_parts.hpp"

namespace dygita {

namespace {

// What the columns are of: the output's own, or what the record states.
std::string quantity_of(const Json& output) {
  const OutputEntry* entry = output_entry(text(output, "kind"));
  return entry && !entry->display.quantity.empty() ? entry->display.quantity : text(output, "quantity");
}

// How many are drawn.
size_t n_drawn(const Json& output, const Table& table) {
  const OutputEntry* entry = output_entry(text(output, "kind"));
  const size_t all = table.columns.size() - 1;
  return entry && entry->display.n_columns > 0 ? std::min<size_t>(entry->display.n_columns, all) : all;
}

std::string title_of(const Json& output) { return text(output, "name") + ": " + subject_of(output); }

double largest_of(const Json& output, const Table& table) {
  double largest = 0.0;
  for (size_t c = 1; c <= n_drawn(output, table); ++c)
    for (const double v : table.columns[c])
      if (std::isfinite(v)) largest = std::max(largest, std::abs(v));
  return largest;
}

std::string history_figure(const RunFolder& run, const Json& output, const Table& table, const TimeAxis& time) {
  std::string quantity = quantity_of(output);
  std::replace(quantity.begin(), quantity.end(), '_', ' ');
  Plot plot{.title = title_of(output), .x = time.axis(), .y = {quantity, table.units.at(1)}};
  time.shade(plot);
  plot.width = 530;
  plot.height = 270;
  const std::vector<double> places = time.places(table);
  const size_t n = n_drawn(output, table);
  for (size_t c = 1; c <= n; ++c)
    plot.lines.push_back({n > 1 ? table.names[c] : "", places, table.columns[c], {}, false, table.n_rows() < 30});
  return doubted_figure(run, svg(plot), title_of(output));
}

}  // namespace

std::string subject_of(const Json& output) {
  const Json on = output.value("on", Json::array());
  std::string places;
  for (const Json& place : on)
    if (place.is_string()) places += (places.empty() ? "" : ", ") + place.get<std::string>();
  std::string direction;
  if (output.contains("direction") && output["direction"].size() == 3) {
    const double d[3] = {output["direction"][0].get<double>(), output["direction"][1].get<double>(),
                         output["direction"][2].get<double>()};
    for (int axis = 0; axis < 3; ++axis)
      if (std::abs(std::abs(d[axis]) - 1.0) < 1e-9)
        direction = std::string(" along ") + (d[axis] < 0.0 ? "−" : "") + "xyz"[axis];
    if (direction.empty()) direction = fmt::format(" along ({:.3g}, {:.3g}, {:.3g})", d[0], d[1], d[2]);
  }
  return quantity_of(output) + direction + (places.empty() ? "" : ", on " + places);
}

std::string histories_section(const RunFolder& run, const TimeAxis& time) {
  std::vector<std::string> figures;
  // Quantities that decks choose first, then what other outputs are of.
  std::vector<Json> outputs = run.outputs(Display::As::curves);
  std::stable_partition(outputs.begin(), outputs.end(), [](const Json& output) {
    return output_entry(text(output, "kind"))->display.quantity.empty();
  });
  std::map<std::string, double> largest;  // of each unit
  for (const Json& output : outputs) {
    const Table table = run.table(text(output, "file"));
    if (table.n_rows() == 0 || table.columns.size() < 2) continue;
    double& of_unit = largest[table.units.at(1)];
    of_unit = std::max(of_unit, largest_of(output, table));
  }
  std::vector<std::string> still;
  for (const Json& output : outputs) {
    const Table table = run.table(text(output, "file"));
    if (table.n_rows() == 0 || table.columns.size() < 2) continue;
    const double all = largest[table.units.at(1)];
    if (all > 0.0 && is_rounding(largest_of(output, table), all))
      still.push_back(text(output, "name"));
    else
      figures.push_back(history_figure(run, output, table, time));
  }
  std::string body = html::row(figures);
  if (!still.empty())
    body += html::paragraph(fmt::format("Not drawn, since {} but rounding beside the largest of {} kind: {}.",
                                        still.size() == 1 ? "it holds nothing" : "they hold nothing",
                                        still.size() == 1 ? "its" : "their", list_of_names(still)));
  return doubted_section(run, "Histories", body);
}

}  // namespace dygita
