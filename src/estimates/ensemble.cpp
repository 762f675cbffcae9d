#include "estimates/ensemble.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "model/output.hpp"
#include "result/case_summary.hpp"

namespace dygita {

namespace {

// Members declare their outputs once for all, or each its own of the same name.
const Table* table_of(const EnsembleMember& member, const std::string& name) {
  for (const OutputPtr& output : member.problem->outputs)
    if (output->name == name) {
      const auto found = member.result->tables.find(output.get());
      return found == member.result->tables.end() ? nullptr : &found->second;
    }
  return nullptr;
}

// As tables have them, which keep nine digits; of decks that are only checked nothing is known.
bool are_equal(const std::vector<double>& a, const std::vector<double>& b) {
  constexpr double same = 2e-8;
  if (a.size() != b.size()) return false;
  for (size_t i = 0; i < a.size(); ++i)
    if (!(std::abs(a[i] - b[i]) <= same * std::abs(a[i])) && !(std::isnan(a[i]) && std::isnan(b[i]))) return false;
  return true;
}

std::vector<double> numbered(int n) {
  std::vector<double> numbers;
  for (int i = 1; i <= n; ++i) numbers.push_back(i);
  return numbers;
}

void add_columns(const std::vector<const Table*>& tables, std::optional<double> factor, OutputScatter& scatter) {
  const Table& first = *tables.front();
  bool have_same_rows = true, have_same_abscissa = true;
  for (const Table* table : tables) {
    have_same_rows &= table->n_rows() == first.n_rows();
    have_same_abscissa &= have_same_rows && are_equal(first.columns[0], table->columns[0]);
  }
  if (!have_same_rows || first.n_rows() == 0) return;
  // Of amplitudes: modes count theirs, and an attenuation is in dB already.
  const std::string unit = first.units.size() > 1 ? first.units[1] : "";
  const bool is_spectrum = scatter.is_spectrum =
      have_same_abscissa && first.names[0] == "frequency" && !unit.empty() && unit != "dB";
  const Column abscissa = have_same_abscissa ? Column{first.names[0], first.units[0]} : Column{"row", ""};
  const std::vector<double> at = have_same_abscissa ? first.columns[0] : numbered(first.n_rows());
  for (size_t i = have_same_abscissa ? 1 : 0; i < first.names.size(); ++i) {
    std::vector<const std::vector<double>*> values;
    for (const Table* table : tables) values.push_back(&table->columns[i]);
    scatter.columns.emplace_back(first.names[i], scatter_of(abscissa, at, first.step, values,
                                                            {first.names[i], first.units[i]}, is_spectrum, factor));
  }
}

// Parameters whose correlation says something: those that vary among the members counted.
std::vector<double> values_of(const std::vector<const EnsembleMember*>& members, size_t parameter) {
  std::vector<double> values;
  for (const EnsembleMember* member : members) values.push_back(member->values[parameter]);
  return values;
}

void add_drives_at(const Ensemble& ensemble, const std::vector<const EnsembleMember*>& members,
                   const std::vector<const Table*>& tables, OutputScatter& scatter) {
  Columns columns = {{tables[0]->names[0], tables[0]->units[0]}};
  for (const std::string& parameter : ensemble.parameters) columns.push_back({parameter, ""});
  scatter.drives_at = empty_table(columns);
  scatter.drives_at.columns[0] = tables[0]->columns[0];
  for (size_t j = 0; j < ensemble.parameters.size(); ++j) {
    const std::vector<double> x = values_of(members, j);
    for (int row = 0; row < tables[0]->n_rows(); ++row) {
      std::vector<double> y;
      for (const Table* table : tables) y.push_back(table->columns[1][static_cast<size_t>(row)]);
      scatter.drives_at.columns[j + 1].push_back(rank_correlation(x, y).value);
    }
  }
}

// A figure of an output, and its value in each member.
struct FigureOfMembers {
  std::string name, unit;
  std::vector<double> values;

  bool is_of(const Output& output) const { return name.rfind(output.name + ".", 0) == 0; }
  double size() const {
    double size = 0.0;
    for (const double v : values) size = std::max(size, std::abs(v));
    return size;
  }
};
using FiguresOfMembers = std::vector<FigureOfMembers>;

FiguresOfMembers figures_of(const std::vector<const EnsembleMember*>& members) {
  FiguresOfMembers figures;
  for (size_t m = 0; m < members.size(); ++m) {
    const std::vector<CaseFigure> own = case_summary(*members[m]->problem, *members[m]->result);
    for (size_t i = 0; i < own.size(); ++i) {
      if (m == 0) figures.push_back({own[i].name, own[i].unit, {}});
      CHECK(i < figures.size() && figures[i].name == own[i].name, "members have the same figures");
      figures[i].values.push_back(own[i].value);
    }
  }
  return figures;
}

// A component along which the output does not move is rounding of the others: of stiffnesses in single precision, whose
// entries break a symmetry by some 1e-7.
bool is_noise(const FigureOfMembers& figure, const FiguresOfMembers& figures, const Output& output) {
  constexpr double rounding = 1e-6;
  double size = 0.0;
  for (const FigureOfMembers& other : figures)
    if (other.unit == figure.unit && other.is_of(output)) size = std::max(size, other.size());
  return figure.size() <= std::max(rounding * size, noise_of(figure.unit));
}

void add_drives(const Ensemble& ensemble, const std::vector<const EnsembleMember*>& members,
                const FiguresOfMembers& figures, OutputScatter& scatter) {
  for (const FigureOfMembers& figure : figures) {
    const auto& [name, unit, values] = figure;
    if (!figure.is_of(*scatter.output) || is_noise(figure, figures, *scatter.output)) continue;
    const size_t before = scatter.drives.size();
    for (size_t j = 0; j < ensemble.parameters.size(); ++j)
      if (const RankCorrelation found = rank_correlation(values_of(members, j), values); std::isfinite(found.value))
        scatter.drives.push_back({name, ensemble.parameters[j], found});
    std::stable_sort(scatter.drives.begin() + static_cast<std::ptrdiff_t>(before), scatter.drives.end(),
                     [](const Drive& a, const Drive& b) { return a.share() > b.share(); });
  }
}

}  // namespace

std::vector<const EnsembleMember*> Ensemble::counted() const {
  std::vector<const EnsembleMember*> all;
  for (const EnsembleMember& member : members)
    if (member.result->converged) all.push_back(&member);
  return all;
}

std::vector<OutputScatter> scatter_of(const Ensemble& ensemble) {
  const std::vector<const EnsembleMember*> members = ensemble.counted();
  std::vector<OutputScatter> all;
  if (members.empty()) return all;
  const FiguresOfMembers figures = figures_of(members);
  std::optional<double> factor;
  if (ensemble.is_sample() && members.size() > 1) factor = tolerance_factor(static_cast<int>(members.size()));
  for (const OutputPtr& output : members.front()->problem->outputs) {
    std::vector<const Table*> tables;
    for (const EnsembleMember* member : members)
      if (const Table* table = table_of(*member, output->name)) tables.push_back(table);
    if (tables.size() < members.size()) continue;
    OutputScatter scatter{output, {}, {}, {}};
    add_columns(tables, factor, scatter);
    add_drives(ensemble, members, figures, scatter);
    if (scatter.is_spectrum) add_drives_at(ensemble, members, tables, scatter);
    all.push_back(std::move(scatter));
  }
  return all;
}

std::vector<double> sample_of(const Ensemble& ensemble, const std::string& output, const std::string& column,
                              const std::string& reduction) {
  std::vector<double> sample;
  for (const EnsembleMember* member : ensemble.counted()) {
    const Table* table = table_of(*member, output);
    CHECK(table, "members have the same outputs");
    const std::vector<double>& values = table->column(column);
    if (values.empty())
      throw InputError(fmt::format("member '{}' has no row of '{}.{}'", member->name, output, column));
    sample.push_back(reduction == "first"  ? values.front()
                     : reduction == "last" ? values.back()
                     : reduction == "max"  ? *std::max_element(values.begin(), values.end())
                                           : *std::min_element(values.begin(), values.end()));
  }
  return sample;
}

std::vector<double> values_at(const Ensemble& ensemble, const std::string& output, const std::string& column,
                              size_t row) {
  std::vector<double> values;
  for (const EnsembleMember* member : ensemble.counted()) {
    const Table* table = table_of(*member, output);
    CHECK(table, "members have the same outputs");
    values.push_back(table->column(column).at(row));
  }
  return values;
}

std::string drive_text(const std::vector<Drive>& drives, const std::string& figure) {
  const auto first = std::find_if(drives.begin(), drives.end(), [&](const Drive& d) { return d.figure == figure; });
  if (first == drives.end() || !first->correlation.is_clear()) return "";
  return fmt::format("{:.0f} % of the spread is {} (rank correlation {:.2f}, {:.2f} to {:.2f})", 100.0 * first->share(),
                     first->parameter, first->correlation.value, first->correlation.low, first->correlation.high);
}

}  // namespace dygita
