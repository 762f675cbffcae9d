#include "result/result.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/names.hpp"
#include "model/model.hpp"

namespace dygita {

double BoltSummary::largest() const {
  double most = std::max({std::abs(lowest), std::abs(highest), std::abs(last)});
  for (const double force : after_static) most = std::max(most, std::abs(force));
  return most;
}

std::optional<double> BoltSummary::loss() const {
  if (!(tightened > 0.1 * largest())) return std::nullopt;
  return 1.0 - last / tightened;
}

bool contacts_change(const Problem& problem, const std::vector<ContactSummary>& contacts) {
  constexpr double rounding = 1e-12;  // m
  for (const ContactSummary& contact : contacts)
    for (const ContactStep& of : contact.steps)
      if (!problem.steps[static_cast<size_t>(of.step)]->is_static &&
          (of.opening > rounding || of.sliding.value_or(0.0) > 0.0 || (of.lowest <= 0.0 && of.highest > 0.0)))
        return true;
  return false;
}

double BoltMargins::against_proof(double tightened) const {
  return proof_load / (largest + (safety - 1.0) * std::max(0.0, largest - tightened)) - 1.0;
}

std::optional<double> BoltMargins::against_separation() const {
  if (!clamp || !(*clamp - *least_clamp > 0.0)) return std::nullopt;
  return *clamp / (safety * (*clamp - *least_clamp)) - 1.0;
}

bool Table::has_column(const std::string& name) const {
  return std::find(names.begin(), names.end(), name) != names.end() || (name == "converged" && !converged.empty());
}

void Table::cut_to(size_t n_rows) {
  for (std::vector<double>& column : columns) column.resize(std::min(column.size(), n_rows));
  step.resize(std::min(step.size(), n_rows));
  converged.resize(std::min(converged.size(), n_rows));
}

void Table::mark(bool has_converged) {
  if (!has_column("converged")) converged.assign(static_cast<size_t>(n_rows()), has_converged ? 1.0 : 0.0);
}

const std::vector<double>& Table::column(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end() && has_column(name)) return converged;
  CHECK(found != names.end(), "no column '" + name + "': " + did_you_mean(name, names));
  return columns.at(static_cast<size_t>(found - names.begin()));
}

Table empty_table(const Columns& columns) {
  Table table;
  for (const Column& column : columns) {
    table.names.push_back(column.name);
    table.units.push_back(column.unit);
  }
  table.columns.resize(columns.size());
  return table;
}

const Findings& RunResult::findings_of(const Output& output) const {
  static const Findings none;
  const auto found = findings.find(&output);
  return found == findings.end() ? none : found->second;
}

}  // namespace dygita
