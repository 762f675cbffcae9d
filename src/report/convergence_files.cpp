#include "report/convergence_files.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "drawing/svg_plot.hpp"
#include "drawing/units.hpp"
#include "files/csv.hpp"
#include "files/files.hpp"

namespace dygita {

namespace {

const WatchedFigure* figure_of(const ConvergenceRun& run, const std::string& name) {
  const auto found = std::find_if(run.figures.begin(), run.figures.end(),
                                  [&](const WatchedFigure& figure) { return figure.name == name; });
  return found == run.figures.end() ? nullptr : &*found;
}

// Largest distance of a run's figure from the limit.
double distance(const std::vector<double>& values, const std::vector<double>& limit) {
  double largest = 0.0;
  for (size_t i = 0; i < limit.size(); ++i) largest = std::max(largest, std::abs(values[i] - limit[i]));
  return largest;
}

std::string parameter_text(const Variation& variation, int level) {
  return fmt::format("{} = {:g}", variation.parameter, variation.value(level));
}

std::string certainty(const FigureConvergence& figure, double uncertainty) {
  if (!std::isfinite(uncertainty)) return "unknown";
  return figure.unit == "dB" ? fmt::format("{:.2g} dB", uncertainty) : fmt::format("{:.2g} %", 100.0 * uncertainty);
}

// "size = 0.004, 0.002, 0.001: 31.1, 30.6, 30.4 kN; order 1.3; the last within 0.6 %: asymptotic".
std::string line_of(const ConvergenceStudy& study, const FigureConvergence& figure, size_t i) {
  const Variation& variation = study.variations()[i];
  const bool is_spectrum = figure.limit.size() > 1;
  const EngineeringUnit unit = engineering_unit(figure.unit, figure.limit[0]);
  std::string sizes, values;
  for (int level = 0; level <= study.deepest(i); ++level) {
    const ConvergenceRun& run = study.runs().at(study.along(i, level));
    const WatchedFigure* found = figure_of(run, figure.name);
    sizes += fmt::format("{}{:g}", level ? ", " : "", variation.value(level));
    if (is_spectrum && level == 0) continue;
    const double value =
        is_spectrum
            ? distance(found->values, figure_of(study.runs().at(study.along(i, level - 1)), figure.name)->values)
            : found->values[0] / unit.size;
    values += fmt::format("{}{:.5g}", values.empty() ? "" : ", ", value);
  }
  const GridConvergence& by = figure.by[i];
  std::string text = fmt::format("    {} = {}: {}{} {}", variation.parameter, sizes, is_spectrum ? "moves by " : "",
                                 values, is_spectrum ? "dB" : unit.name);
  if (std::isfinite(by.order)) text += fmt::format("; order {:.2f}", by.order);
  return text + fmt::format("; the last within {}: {}\n", certainty(figure, by.uncertainty / figure.scale),
                            meaning(by.tendency));
}

std::vector<std::string> scalar_names(const ConvergenceStudy& study) {
  std::vector<std::string> names;
  for (const WatchedFigure& figure : study.runs().begin()->second.figures)
    if (figure.values.size() == 1) names.push_back(figure.name);
  return names;
}

}  // namespace

std::string setting_text(const ConvergenceStudy& study, const Levels& levels) {
  std::string text;
  for (size_t i = 0; i < levels.size(); ++i) text += (i ? ", " : "") + parameter_text(study.variations()[i], levels[i]);
  return text;
}

std::string convergence_text(const ConvergenceStudy& study, const std::vector<FigureConvergence>& figures) {
  const bool is_tested = study.variations().size() < 2 || study.runs().contains(study.finest());
  std::string text;
  for (const FigureConvergence& figure : figures) {
    text += "  " + figure.name;
    if (figure.limit.size() == 1) text += ": in the limit " + with_unit(figure.limit[0], figure.unit, 5);
    text += fmt::format(", the finest of each together within {}{}\n",
                        certainty(figure, figure.at(study.variations(), study.finest())),
                        is_tested ? "" : " (their errors added: no run has tested that)");
    for (size_t i = 0; i < study.variations().size(); ++i) text += line_of(study, figure, i);
  }
  return text;
}

std::string convergence_csv(const ConvergenceStudy& study) {
  const std::vector<std::string> names = scalar_names(study);
  std::string text;
  for (const Variation& variation : study.variations()) text += quoted(variation.parameter) + ",";
  for (const std::string& name : names) {
    const WatchedFigure* figure = figure_of(study.runs().begin()->second, name);
    text += quoted(figure->unit.empty() ? name : name + " [" + figure->unit + "]") + ",";
  }
  text += "converged,seconds [s]\n";
  for (const auto& [levels, run] : study.runs()) {
    for (size_t i = 0; i < levels.size(); ++i) text += fmt::format("{:.9g},", study.variations()[i].value(levels[i]));
    for (const std::string& name : names) {
      const WatchedFigure* figure = figure_of(run, name);
      text += figure ? fmt::format("{:.9g},", figure->values[0]) : "nan,";
    }
    text += fmt::format("{},{:.3f}\n", run.converged ? 1 : 0, run.seconds);
  }
  return text;
}

std::string convergence_svg(const std::string& title, const ConvergenceStudy& study,
                            const std::vector<FigureConvergence>& figures) {
  Plot plot{.title = title,
            .description = "Distance of each run from the extrapolated limit of its parameter",
            .x = {"size relative to the coarsest", "", true},
            .y = {"distance from the limit (%; spectra: dB)", "", true}};
  for (const FigureConvergence& figure : figures)
    for (size_t i = 0; i < study.variations().size(); ++i) {
      PlotLine line{.name = figure.name + ", " + study.variations()[i].parameter, .x = {}, .y = {}};
      line.has_markers = true;
      for (int level = study.deepest(i); level >= 0; --level) {
        const WatchedFigure* found = figure_of(study.runs().at(study.along(i, level)), figure.name);
        line.x.push_back(study.variations()[i].size(level));
        line.y.push_back((figure.unit == "dB" ? 1.0 : 100.0) * distance(found->values, figure.by[i].limit) /
                         figure.scale);
      }
      plot.lines.push_back(std::move(line));
    }
  plot.height = 420;
  return svg(plot);
}

void write_convergence(const std::filesystem::path& folder, const std::string& title, const ConvergenceStudy& study,
                       const std::vector<FigureConvergence>& figures) {
  std::filesystem::create_directories(folder);
  write_text(folder / own_file::converge_table, convergence_csv(study));
  write_text(folder / own_file::converge_figure, convergence_svg(title, study, figures));
}

}  // namespace dygita
