#include "report/study_files.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/log.hpp"
#include "drawing/svg_plot.hpp"
#include "drawing/svg_text.hpp"
#include "files/csv.hpp"
#include "files/files.hpp"

namespace dygita {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// Names in the order in which cases first have them.
template <class Of>
std::vector<std::string> names_of(const std::vector<StudyCase>& cases, Of&& of) {
  std::vector<std::string> names;
  for (const StudyCase& c : cases)
    for (const std::string& name : of(c))
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

std::vector<std::string> parameters_of(const std::vector<StudyCase>& cases) {
  return names_of(cases, [](const StudyCase& c) {
    std::vector<std::string> names;
    for (const auto& [name, value] : c.at) names.push_back(name);
    return names;
  });
}

std::vector<std::string> figures_of(const std::vector<StudyCase>& cases) {
  return names_of(cases, [](const StudyCase& c) {
    std::vector<std::string> names;
    for (const CaseFigure& figure : c.figures) names.push_back(figure.name);
    return names;
  });
}

double parameter(const StudyCase& c, const std::string& name) {
  for (const auto& [known, value] : c.at)
    if (known == name) return value;
  return not_a_number;
}

const CaseFigure* figure(const StudyCase& c, const std::string& name) {
  for (const CaseFigure& known : c.figures)
    if (known.name == name) return &known;
  return nullptr;
}

std::string unit_of(const std::vector<StudyCase>& cases, const std::string& name) {
  for (const StudyCase& c : cases)
    if (const CaseFigure* known = figure(c, name)) return known->unit;
  return "";
}

std::string nine_digits(double value) { return fmt::format("{:.9g}", value); }

// The abscissa of the charts: a parameter that varies, or the case's number.
struct Abscissa {
  std::string name;
  std::vector<double> x;
};

Abscissa abscissa_of(const std::vector<StudyCase>& cases) {
  for (const std::string& name : parameters_of(cases)) {
    Abscissa abscissa{name, {}};
    for (const StudyCase& c : cases) abscissa.x.push_back(parameter(c, name));
    const auto [low, high] = std::minmax_element(abscissa.x.begin(), abscissa.x.end());
    if (std::isfinite(*low) && *high > *low) return abscissa;
  }
  Abscissa numbers{"case", {}};
  for (size_t i = 0; i < cases.size(); ++i) numbers.x.push_back(static_cast<double>(i + 1));
  return numbers;
}

// A line that rises along x whatever the order in which the cases ran.
PlotLine line_of(const Abscissa& abscissa, const std::string& name, const std::vector<double>& y) {
  std::vector<size_t> order(y.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return abscissa.x[a] < abscissa.x[b]; });
  PlotLine line{.name = name, .x = {}, .y = {}};
  line.has_markers = true;
  for (const size_t i : order) {
    if (!std::isfinite(y[i])) continue;
    line.x.push_back(abscissa.x[i]);
    line.y.push_back(y[i]);
  }
  return line;
}

bool is_varied(const std::vector<StudyCase>& cases, const std::string& name) {
  return std::any_of(cases.begin(), cases.end(),
                     [&](const StudyCase& c) { return parameter(c, name) != parameter(cases.front(), name); });
}

// What else varies beside the abscissa, of one case: "young = 5e+10".
std::string others_of(const std::vector<StudyCase>& cases, const StudyCase& c, const Abscissa& abscissa) {
  std::string text;
  for (const std::string& name : parameters_of(cases))
    if (name != abscissa.name && is_varied(cases, name))
      text += (text.empty() ? "" : ", ") + fmt::format("{} = {:g}", name, parameter(c, name));
  return text;
}

// One line for each combination of the other parameters; cases that have not converged are left out.
std::vector<PlotLine> lines_of(const std::vector<StudyCase>& cases, const Abscissa& abscissa,
                               const std::vector<double>& y) {
  std::vector<std::string> groups;
  std::vector<std::string> of_case;
  for (const StudyCase& c : cases) {
    of_case.push_back(others_of(cases, c, abscissa));
    if (std::find(groups.begin(), groups.end(), of_case.back()) == groups.end()) groups.push_back(of_case.back());
  }
  std::vector<PlotLine> lines;
  for (const std::string& group : groups) {
    std::vector<double> own(y.size(), not_a_number);
    for (size_t i = 0; i < y.size(); ++i)
      if (of_case[i] == group && cases[i].converged) own[i] = y[i];
    lines.push_back(line_of(abscissa, group, own));
  }
  return lines;
}

// A chart is worth its place where the figure moves by more than rounding.
bool is_worth_a_chart(const std::vector<StudyCase>& cases, const std::string& name) {
  constexpr double rounding = 1e-6;
  const std::string unit = unit_of(cases, name);
  double low = std::numeric_limits<double>::infinity(), high = -low, scale = 0.0;
  for (const StudyCase& c : cases)
    for (const CaseFigure& known : c.figures) {
      if (!c.converged || !std::isfinite(known.value) || known.unit != unit) continue;
      scale = std::max(scale, std::abs(known.value));
      if (known.name != name) continue;
      low = std::min(low, known.value);
      high = std::max(high, known.value);
    }
  return high - low > rounding * scale && high - low > noise_of(unit);
}

}  // namespace

std::string study_csv(const std::vector<StudyCase>& cases) {
  const std::vector<std::string> parameters = parameters_of(cases), figures = figures_of(cases);
  std::string text = "case,started_from";
  for (const std::string& name : parameters) text += "," + quoted(name);
  for (const std::string& name : figures) {
    const std::string unit = unit_of(cases, name);
    text += "," + quoted(unit.empty() ? name : name + " [" + unit + "]");
  }
  text += ",iterations,mean_iterations,cold_iterations,cold_difference,converged,seconds [s]\n";
  for (const StudyCase& c : cases) {
    text += quoted(c.name) + "," + quoted(c.started_from);
    for (const std::string& name : parameters) text += "," + nine_digits(parameter(c, name));
    for (const std::string& name : figures) {
      const CaseFigure* known = figure(c, name);
      text += "," + nine_digits(known ? known->value : not_a_number);
    }
    text += fmt::format(",{},{},{},{},{},{:.3f}\n", c.iterations, nine_digits(c.mean_iterations),
                        c.cold_iterations ? std::to_string(*c.cold_iterations) : "",
                        c.cold_difference ? nine_digits(*c.cold_difference) : "", c.converged ? 1 : 0, c.seconds);
  }
  return text;
}

std::string study_svg(const std::string& title, const std::vector<StudyCase>& cases) {
  constexpr int width = 460, height = 230, heading = 22, margin = 12, columns = 2;
  const Abscissa abscissa = abscissa_of(cases);
  std::vector<std::pair<std::string, std::string>> charts;
  const auto add = [&](const std::string& name, const std::string& unit, std::vector<PlotLine> lines) {
    const size_t space = name.rfind(' ');
    Plot plot{
        .title = name, .x = {abscissa.name}, .y = {space == std::string::npos ? name : name.substr(space + 1), unit}};
    plot.lines = std::move(lines);
    plot.width = width;
    plot.height = height;
    charts.emplace_back(name, svg(plot));
  };
  for (const std::string& name : figures_of(cases)) {
    std::vector<double> y;
    for (const StudyCase& c : cases) y.push_back(figure(c, name) ? figure(c, name)->value : not_a_number);
    if (is_worth_a_chart(cases, name)) add(name, unit_of(cases, name), lines_of(cases, abscissa, y));
  }
  std::vector<double> warm, cold;
  for (const StudyCase& c : cases) {
    warm.push_back(static_cast<double>(c.iterations));
    cold.push_back(c.cold_iterations        ? static_cast<double>(*c.cold_iterations)
                   : c.started_from.empty() ? warm.back()
                                            : not_a_number);
  }
  std::vector<PlotLine> iterations = {line_of(abscissa, "as run", warm), line_of(abscissa, "cold", cold)};
  iterations[1].is_dashed = true;
  add("iterations", "", std::move(iterations));

  const int rows = (static_cast<int>(charts.size()) + columns - 1) / columns;
  const int all_width = columns * (width + margin) + margin, all_height = 40 + rows * (heading + height + margin);
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "font-family=\"sans-serif\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n<text x=\"{2}\" y=\"26\" font-size=\"17\" "
      "font-weight=\"bold\">{3}</text>\n",
      all_width, all_height, margin, escaped(title));
  for (size_t i = 0; i < charts.size(); ++i) {
    const int x = margin + static_cast<int>(i % columns) * (width + margin),
              y = 40 + static_cast<int>(i / columns) * (heading + height + margin);
    text += fmt::format(
        "<g transform=\"translate({} {})\"><text x=\"4\" y=\"15\" font-size=\"13\" font-weight=\"bold\">{}</text>"
        "<g transform=\"translate(0 {})\">\n{}</g></g>\n",
        x, y, escaped(charts[i].first), heading, charts[i].second);
  }
  return text + "</svg>\n";
}

std::string study_summary(const std::string& name, const std::vector<StudyCase>& cases) {
  long all = 0, warm = 0;
  int n_warm = 0;
  std::string checks;
  for (const StudyCase& c : cases) {
    all += c.iterations;
    if (!c.started_from.empty()) {
      warm += c.iterations;
      ++n_warm;
    }
    if (c.cold_iterations)
      checks += fmt::format(
          "\n  case '{}' checked cold: {} iterations instead of {} ({:.0f} % saved); answers differ by at most {:.1e}",
          c.name, *c.cold_iterations, c.iterations,
          100.0 * (1.0 - static_cast<double>(c.iterations) / static_cast<double>(*c.cold_iterations)),
          *c.cold_difference);
  }
  std::string text = fmt::format("study of '{}': {} cases, {} iterations", name, cases.size(), all);
  if (n_warm > 0 && n_warm < static_cast<int>(cases.size()))
    text += fmt::format("; {:.0f} a case from scratch, {:.0f} from another's interface fields",
                        static_cast<double>(all - warm) / (static_cast<double>(cases.size()) - n_warm),
                        static_cast<double>(warm) / n_warm);
  return text + checks;
}

void write_study(const std::filesystem::path& folder, const std::string& name, const std::vector<StudyCase>& cases) {
  make_directory(folder);
  write_text(folder / own_file::study_table, study_csv(cases));
  write_text(folder / own_file::study_figure, study_svg("Study of " + name, cases));
}

}  // namespace dygita
