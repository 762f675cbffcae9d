// Natural modes: frequencies, damping and effective masses, what moves; how they go with amplitude.
#include <algorithm>
#include <cmath>

#include "base/log.hpp"
#include "drawing/svg_plot.hpp"
#include "drawing/turning_file.hpp"
#include "drawing/units.hpp"
#include "report/html.hpp"
#include "report/report_parts.hpp"

namespace dygita {

namespace {

constexpr const char* of_direction[] = {"x", "y", "z", "about_x", "about_y", "about_z"};

std::string percent_text(double share) { return std::isfinite(share) ? fmt::format("{:.2f}", 100.0 * share) : ""; }

double at_place(const Json& list, size_t i) {
  return i < list.size() && list[i].is_number() ? list[i].get<double>() : std::nan("");
}

std::string table_of_modes(const Json& output, const Table& modes) {
  constexpr int most = 100;
  const Json moments = output.value("inertia", Json::array()), shares = output.value("shares", Json::array());
  std::vector<std::vector<std::string>> rows;
  for (int m = 0; m < std::min(most, modes.n_rows()); ++m) {
    const auto at = [&](const std::string& column) { return modes.column(column)[static_cast<size_t>(m)]; };
    const double damping = at("damping"), frequency = at("frequency");
    std::vector<std::string> row = {std::to_string(m + 1), frequency == 0.0 ? "0 Hz" : with_unit(frequency, "Hz", 5),
                                    std::isfinite(damping) ? plain_number(100.0 * damping) + " %" : "",
                                    with_unit(at("generalised_mass"), "kg", 4)};
    for (size_t d = 0; d < 6; ++d)
      row.push_back(percent_text(at(std::string("effective_") + of_direction[d]) /
                                 (d < 3 ? number(output, "mass") : at_place(moments, d - 3))));
    rows.push_back(std::move(row));
  }
  if (rows.empty()) return "";
  if (modes.n_rows() > most)
    rows.push_back({fmt::format("{} more in {}", modes.n_rows() - most, text(output, "file")), "", "", "", "", "", "",
                    "", "", ""});
  std::vector<std::string> sums = {"sum", "", "", ""};
  for (size_t d = 0; d < 6; ++d) sums.push_back(percent_text(at_place(shares, d)));
  rows.push_back(std::move(sums));
  return html::table({"mode", "frequency", "damping ratio", "generalised mass", "effective mass x, %", "y", "z",
                      "about x", "about y", "about z"},
                     rows, true);
}

std::string modes_text(const Json& output) {
  std::string line = text(output, "after").empty()
                         ? "About the unloaded assembly: ties are closed, contacts as they are at first."
                         : "About the end of step '" + text(output, "after") + "', held by its supports.";
  const Json points = output.value("contact_points", Json::object());
  if (number(points, "tied") + number(points, "normal") + number(points, "open") > 0)
    line += fmt::format(" Contact points: {:.0f} tied, {:.0f} along their normal alone, {:.0f} open.",
                        number(points, "tied"), number(points, "normal"), number(points, "open"));
  if (const double n = number(output, "free_motions"); n > 0)
    line += fmt::format(" Nothing resists {:.0f} motion{}: 0 Hz.", n, n == 1 ? "" : "s");
  return line + " Effective masses are shares of " + with_unit(number(output, "mass"), "kg", 4) +
         " and of the moments of inertia about the axes through the centre of mass. Damping is that of materials and "
         "laws for small motions; prestress adds no stiffness.";
}

std::string pictures_of_shapes(const RunFolder& run, const std::string& name) {
  if (!run.scenes().is_object() || !run.scenes().contains("shapes")) return "";
  const Json parts = run.record().value("substructures", Json::array());
  std::vector<std::string> figures;
  for (const Json& picture : run.scenes()["shapes"]) {
    if (text(picture, "output") != name) continue;
    const std::string caption =
        fmt::format("Mode {:.0f}, {}.", number(picture, "mode"), with_unit(number(picture, "frequency"), "Hz", 5));
    figures.push_back(html::figure(picture_of_shape(picture, parts, caption), caption + " Dashed: undeformed."));
  }
  return html::row(figures);
}

// Frequency and damping against amplitude, side by side.
std::string amplitude_part(const RunFolder& run, const Json& output) {
  const Table table = run.table(text(output, "file"), {"frequency", "damping"});
  if (table.n_rows() < 2) return "";
  const std::string name = text(output, "name"), by = table.has_column("amplitude") ? "amplitude" : "acceleration";
  const size_t column =
      static_cast<size_t>(std::find(table.names.begin(), table.names.end(), by) - table.names.begin());
  if (!table.has_column(by)) return "";
  Plot frequency{.title = name + ": frequency", .x = {by, table.units[column], true}, .y = {"frequency", "Hz"}};
  frequency.width = 530, frequency.height = 270;
  Plot damping = frequency;
  damping.title = name + ": damping";
  damping.y = {"fraction of critical damping", "%"};
  std::vector<double> percent = table.column("damping");
  for (double& share : percent) share *= 100.0;
  frequency.lines.push_back({"", table.column(by), table.column("frequency"), {}, false, table.n_rows() < 60});
  damping.lines.push_back({"", table.column(by), percent, {}, false, table.n_rows() < 60});
  const char* made = by == "amplitude"
                         ? "A vibration that decays, period by period."
                         : "Static steps in the shape of the mode; the acceleration is where it is largest.";
  return html::heading(name) + html::paragraph(made) +
         html::row({doubted_figure(run, svg(frequency)), doubted_figure(run, svg(damping))});
}

std::string modes_part(const RunFolder& run, const Json& output) {
  std::vector<std::string> columns = {"frequency", "damping", "generalised_mass"};
  for (const char* direction : of_direction) columns.push_back(std::string("effective_") + direction);
  const Table modes = run.table(text(output, "file"), columns);
  if (modes.n_rows() == 0) return "";
  const std::string name = text(output, "name"), file = text(output, "file");
  std::string body = html::heading(name) + html::paragraph(modes_text(output)) + table_of_modes(output, modes) +
                     pictures_of_shapes(run, name);
  const std::string shapes = run.file_text(shapes_file(file.substr(0, file.size() - 4)));
  if (!shapes.empty() && Json::accept(shapes))
    body += turning_figure(shapes, "The modes of " + name,
                           "Press play to see a mode swing; the slider chooses which. Drag to turn, with Shift to "
                           "move, Ctrl and the wheel (or + and −) to zoom.");
  return body;
}

}  // namespace

std::string modes_section(const RunFolder& run) {
  std::string body;
  for (const Json& output : run.outputs(Display::As::modes)) body += modes_part(run, output);
  std::string amplitudes;
  for (const Json& output : run.outputs(Display::As::amplitude)) amplitudes += amplitude_part(run, output);
  return doubted_section(run, "Natural modes", body) +
         doubted_section(run, "Frequency and damping against amplitude", amplitudes);
}

}  // namespace dygita
