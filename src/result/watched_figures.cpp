#include "result/watched_figures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/names.hpp"

namespace dygita {

namespace {

const std::vector<std::string> words = {"max", "min", "last", "mean"};

// Of each row, how long it stands for: half of the time to its neighbours on both sides. Where time does not pass, all
// rows for as long.
std::vector<double> durations(const Table& table) {
  const auto n = static_cast<size_t>(table.n_rows());
  std::vector<double> lasts(n, 0.0);
  if (table.names.empty() || table.names.front() != "time") return std::vector(n, 1.0);
  const std::vector<double>& time = table.columns.front();
  for (size_t i = 0; i + 1 < n; ++i)
    for (const size_t end : {i, i + 1}) lasts[end] += 0.5 * (time[i + 1] - time[i]);
  const bool has_motion = std::any_of(lasts.begin(), lasts.end(), [](double t) { return t > 0.0; });
  return has_motion ? lasts : std::vector(n, 1.0);
}

double reduced(const Table& table, const std::vector<double>& values, const std::string& word) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  if (word == "last") return values.back();
  if (word == "min") return *std::min_element(values.begin(), values.end());
  if (word == "mean") {
    const std::vector<double> lasts = durations(table);
    double sum = 0.0, all = 0.0;
    for (size_t i = 0; i < values.size(); ++i) {
      sum += lasts[i] * values[i];
      all += lasts[i];
    }
    return sum / all;
  }
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

bool is_spectrum(const Output& output) {
  const Columns columns = output.columns();
  return columns.size() > 1 && columns.front().unit == "Hz" && !columns[1].unit.empty() && columns[1].unit != "dB";
}

std::vector<std::string> columns_of(const Output& output) {
  std::vector<std::string> names;
  for (const auto& [name, unit] : output.columns()) names.push_back(name);
  return names;
}

std::string word_of(StudyFigure::Of of) {
  switch (of) {
    case StudyFigure::Of::largest:
      return "max";
    case StudyFigure::Of::last:
      return "last";
    case StudyFigure::Of::mean:
      return "mean";
    case StudyFigure::Of::lowest:
      return "min";
  }
  CHECK(false, "unknown figure of a study");
  return "";
}

}  // namespace

WatchedName::WatchedName(const Problem& problem, const std::string& text, const std::string& what) : text_(text) {
  std::vector<std::string> known;
  for (const OutputPtr& output : problem.outputs) {
    if (!output->columns().empty()) known.push_back(output->name);
    // The longest name that fits: names may have dots.
    const bool fits = text == output->name || text.rfind(output->name + ".", 0) == 0;
    if (fits && (!output_ || output->name.size() > output_->name.size())) output_ = output.get();
  }
  const std::string who = what + " " + text + ": ";
  if (!output_)
    throw InputError(who + "problem '" + problem.name + "' has no output '" + text.substr(0, text.find('.')) +
                     "'\n    " + did_you_mean(text.substr(0, text.find('.')), known));
  is_spectrum_ = text == output_->name && is_spectrum(*output_);
  if (is_spectrum_) return;
  const std::vector<std::string> columns = columns_of(*output_);
  if (text == output_->name)
    throw InputError(who + output_->known_as() + " is no spectrum: name a column of it too, as " + text + "." +
                     (columns.size() > 1 ? columns[1] : "x") + ".max");
  column_ = text.substr(output_->name.size() + 1);
  if (const size_t dot = column_.rfind('.');
      dot != std::string::npos && std::find(columns.begin(), columns.end(), column_) == columns.end()) {
    word_ = column_.substr(dot + 1);
    column_.erase(dot);
  }
  if (std::find(columns.begin(), columns.end(), column_) == columns.end())
    throw InputError(who + output_->known_as() + " has no column '" + column_ + "'\n    " +
                     did_you_mean(column_, columns));
  if (std::find(words.begin(), words.end(), word_) == words.end())
    throw InputError(who + "'" + word_ + "' is no figure of a column\n    " + did_you_mean(word_, words));
}

std::optional<WatchedFigure> WatchedName::of(const RunResult& result) const {
  const auto found = result.tables.find(output_);
  if (found == result.tables.end()) return std::nullopt;
  const Table& table = found->second;
  if (!is_spectrum_) {
    const std::vector<double>& values = table.column(column_);
    const auto i = std::find(table.names.begin(), table.names.end(), column_) - table.names.begin();
    return WatchedFigure{text_, table.units[static_cast<size_t>(i)], {reduced(table, values, word_)}};
  }
  WatchedFigure figure{text_, "dB", {}};
  for (const double level : table.columns[1]) figure.values.push_back(20.0 * std::log10(std::max(level, 1e-300)));
  return figure;
}

std::vector<std::string> watched_by_default(const Problem& problem) {
  std::vector<std::string> names;
  for (const OutputPtr& output : problem.outputs) {
    if (is_spectrum(*output)) {
      names.push_back(output->name);
      continue;
    }
    for (const StudyFigure& figure : output->study_figures())
      names.push_back(output->name + "." + figure.column + "." + word_of(figure.of));
  }
  return names;
}

}  // namespace dygita
