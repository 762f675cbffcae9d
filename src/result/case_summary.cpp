#include "result/case_summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace dygita {

namespace {

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double v : values) most = std::max(most, std::abs(v));
  return values.empty() ? std::numeric_limits<double>::quiet_NaN() : most;
}

double last(const std::vector<double>& values) {
  return values.empty() ? std::numeric_limits<double>::quiet_NaN() : values.back();
}

double mean(const std::vector<double>& values) {
  double sum = 0.0, n = 0.0;
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    sum += v;
    n += 1.0;
  }
  return n > 0.0 ? sum / n : std::numeric_limits<double>::quiet_NaN();
}

double lowest(const std::vector<double>& values) {
  return values.empty() ? std::numeric_limits<double>::quiet_NaN() : *std::min_element(values.begin(), values.end());
}

struct Reduction {
  const char* name;
  double (*of)(const std::vector<double>&);
};

Reduction reduction(StudyFigure::Of of) {
  switch (of) {
    case StudyFigure::Of::largest:
      return {"largest", largest};
    case StudyFigure::Of::last:
      return {"last", last};
    case StudyFigure::Of::mean:
      return {"mean", mean};
    case StudyFigure::Of::lowest:
      return {"lowest", lowest};
  }
  CHECK(false, "unknown figure of a study");
  return {};
}

}  // namespace

double noise_of(const std::string& unit) {
  static const std::map<std::string, double> noise = {{"m", 1e-15}, {"m/s", 1e-12}, {"m/s^2", 1e-6}, {"m^2", 1e-15},
                                                      {"N", 1e-9},  {"J", 1e-15},   {"Pa", 1e-3},    {"dB", 1e-9}};
  const auto found = noise.find(unit);
  return found == noise.end() ? 0.0 : found->second;
}

std::vector<CaseFigure> case_summary(const Problem& problem, const RunResult& result) {
  std::vector<CaseFigure> figures;
  for (const OutputPtr& output : problem.outputs) {
    const auto found = result.tables.find(output.get());
    if (found == result.tables.end()) continue;
    const Table& table = found->second;
    for (const StudyFigure& figure : output->study_figures()) {
      const auto column = std::find(table.names.begin(), table.names.end(), figure.column);
      if (column == table.names.end()) continue;
      const auto i = static_cast<size_t>(column - table.names.begin());
      const Reduction reduce = reduction(figure.of);
      figures.push_back(
          {output->name + "." + figure.column + " " + reduce.name, table.units[i], reduce.of(table.columns[i])});
    }
  }
  return figures;
}

Difference largest_difference(const Problem& problem, const RunResult& a, const RunResult& b) {
  Difference worst;
  const auto meet = [&](double value, const std::string& where) {
    if (!(value > worst.value)) return;
    worst = {value, where};
  };
  for (const OutputPtr& output : problem.outputs) {
    const auto in_a = a.tables.find(output.get()), in_b = b.tables.find(output.get());
    if (in_a == a.tables.end() || in_b == b.tables.end()) continue;
    const Table &x = in_a->second, &y = in_b->second;
    if (x.n_rows() != y.n_rows()) {
      meet(std::numeric_limits<double>::infinity(), output->name);
      continue;
    }
    for (size_t i = 1; i < x.names.size(); ++i) {
      if (x.units[i] == "m^2") continue;
      double size = 0.0, difference = 0.0;
      for (size_t j = 1; j < x.names.size(); ++j)
        if (x.units[j] == x.units[i] && x.n_rows() > 0) size = std::max(size, largest(x.columns[j]));
      for (int row = 0; row < x.n_rows(); ++row) {
        const double d = std::abs(x.columns[i][static_cast<size_t>(row)] - y.columns[i][static_cast<size_t>(row)]);
        if (d > difference) difference = d;
      }
      if (size > noise_of(x.units[i])) meet(difference / size, output->name + "." + x.names[i]);
    }
  }
  return worst;
}

}  // namespace dygita
