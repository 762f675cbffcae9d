// Condensed models: loops of joints and superelements of assemblies.
#include <algorithm>
#include <cmath>

#include "base/log.hpp"
#include "drawing/quantities.hpp"
#include "drawing/svg_plot.hpp"
#include "drawing/units.hpp"
#include "report/html.hpp"
#include "report/report_parts.hpp"

namespace dygita {

namespace {

std::string stem(const Json& output) {
  const std::string file = text(output, "file");
  return file.substr(0, file.size() - 4);  // .csv
}

std::string loop_part(const RunFolder& run, const Json& output) {
  const Table loop = run.table(text(output, "file"), {"displacement", "force"});
  if (loop.n_rows() == 0) return "";
  Plot plot{.title = "Force against displacement of " + text(output, "name"),
            .x = {"displacement", "m"},
            .y = {"force", "N"}};
  plot.lines.push_back({"as computed", loop.column("displacement"), loop.column("force")});
  const Table backbone = run.table(stem(output) + "_backbone.csv", {"displacement", "force"});
  if (backbone.n_rows() > 0)
    plot.lines.push_back({"first loading, from the last cycle",
                          backbone.column("displacement"),
                          backbone.column("force"),
                          {},
                          true,
                          true});
  std::string body = html::heading(text(output, "name")) +
                     doubted_figure(run, svg(plot),
                                    "Springs and sliders with the same curve of first loading are in " + stem(output) +
                                        "_backbone.csv.");
  const Table cycles = run.table(stem(output) + "_cycles.csv",
                                 {"amplitude", "force_amplitude", "secant", "loss", "loss_factor", "exponent"});
  Cells rows;
  for (int i = 0; i < cycles.n_rows(); ++i) {
    const auto at = [&](const char* column) { return cycles.column(column)[static_cast<size_t>(i)]; };
    rows.push_back({std::to_string(i + 1), TableCell(at("force_amplitude"), "N"), TableCell(at("amplitude"), "m"),
                    plain_number(at("secant")) + " N/m", TableCell(at("loss"), "J"), plain_number(at("loss_factor")),
                    std::isfinite(at("exponent")) ? plain_number(at("exponent")) : ""});
  }
  if (rows.empty()) return body + html::paragraph("No cycle was closed.");
  return body + html::table({"cycle", "force amplitude", "displacement amplitude", "secant stiffness", "loss",
                             "loss factor", "exponent of loss over force"},
                            in_common_units(rows), true);
}

std::string superelement_part(const RunFolder& run, const Json& output) {
  constexpr int most = 20;
  const Table frequencies = run.table(text(output, "file"), {"frequency"});
  std::vector<std::vector<std::string>> rows;
  for (int i = 0; i < std::min(frequencies.n_rows(), most); ++i)
    rows.push_back(
        {std::to_string(i + 1), with_unit(frequencies.column("frequency")[static_cast<size_t>(i)], "Hz", 4)});
  if (rows.empty()) return "";
  return html::heading(text(output, "name")) +
         html::paragraph("Mass and stiffness about the tightened state, on faces and modes: " + stem(output) +
                         ".md says what each row is. Its lowest natural frequencies:") +
         html::table({"mode", "frequency"}, rows, true);
}

}  // namespace

std::string condensed_section(const RunFolder& run) {
  std::string body;
  for (const Json& output : run.outputs(Display::As::loop)) body += loop_part(run, output);
  for (const Json& output : run.outputs(Display::As::frequencies)) body += superelement_part(run, output);
  return doubted_section(run, "Condensed models", body);
}

}  // namespace dygita
