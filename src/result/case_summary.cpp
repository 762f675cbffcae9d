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

class Summary {
 public:
  Summary(const Output& output, const Table& table, std::vector<CaseFigure>& figures)
      : output_(output), table_(table), figures_(figures) {}

  void add(const std::string& column, const char* what, double (*value)(const std::vector<double>&)) {
    const auto found = std::find(table_.names.begin(), table_.names.end(), column);
    if (found == table_.names.end()) return;
    const auto i = static_cast<size_t>(found - table_.names.begin());
    figures_.push_back({output_.name + "." + column + " " + what, table_.units[i], value(table_.columns[i])});
  }

 private:
  const Output& output_;
  const Table& table_;
  std::vector<CaseFigure>& figures_;
};

std::string name_of(const Output& output) { return output.kind == OutputKind::energy ? "energy" : output.name; }

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
    Summary summary(*output, table, figures);
    switch (output->kind) {
      case OutputKind::joint:
        summary.add("normal", "last", last);
        for (const char* column : {"opening", "slip", "plastic_opening"}) summary.add(column, "largest", largest);
        for (const char* column : {"friction_work", "plastic_work"}) summary.add(column, "last", last);
        break;
      case OutputKind::resultant:
        for (const char* column : {"normal", "shear"}) summary.add(column, "largest", largest);
        break;
      case OutputKind::srs:
        summary.add("maximax", "largest", largest);
        break;
      case OutputKind::srs_field:
        summary.add("highest", "largest", largest);
        break;
      case OutputKind::attenuation:
        for (const char* axis : {"", "_x", "_y", "_z"}) summary.add(std::string("ratio") + axis, "mean", mean);
        break;
      case OutputKind::history:
        for (size_t i = 1; i < table.names.size(); ++i) summary.add(table.names[i], "largest", largest);
        break;
      case OutputKind::loop:
        for (const char* column : {"displacement", "force"}) summary.add(column, "largest", largest);
        break;
      case OutputKind::superelement:
        summary.add("frequency", "lowest",
                    [](const std::vector<double>& values) { return values.empty() ? 0.0 : values.front(); });
        break;
      case OutputKind::energy:
      case OutputKind::vtk:
        break;
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
      meet(std::numeric_limits<double>::infinity(), name_of(*output));
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
      if (size > noise_of(x.units[i])) meet(difference / size, name_of(*output) + "." + x.names[i]);
    }
  }
  return worst;
}

}  // namespace dygita
