// Signals, specifications and tables: the CSV files that decks name and reports read back.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "files/csv.hpp"
#include "fuzz/target.hpp"
#include "signal/history.hpp"
#include "signal/signal_file.hpp"
#include "signal/specification.hpp"
#include "signal/srs.hpp"

namespace dygita::fuzz {

namespace {

bool are_finite(const std::vector<double>& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
}

void read_as_signal(const std::string& path) {
  SampledSignal signal;
  if (!attempt([&] { signal = read_signal(path); })) return;
  demand(!signal.times.empty() && signal.times.size() == signal.values.size(), "a value for each time");
  demand(are_finite(signal.times) && are_finite(signal.values), "a signal that is read is finite");
  demand(std::is_sorted(signal.times.begin(), signal.times.end(), std::less_equal<>()), "times increase");
  attempt([&] {
    const double end = signal.times.back(), middle = 0.5 * (signal.times.front() + end);
    const History history = History::record(std::move(signal), path);
    for (const double t : {0.0, middle, end, 2 * end}) demand(!std::isnan(history.value(t)), "a record has a value");
    history.profile();
    history.description();
  });
}

void read_as_specification(const std::string& path) {
  Specification specification;
  if (!attempt([&] { specification = read_specification(path); })) return;
  demand(specification.frequency.size() >= 2, "two points");
  demand(are_finite(specification.frequency) && are_finite(specification.level), "a specification is finite");
  for (const double f : specification.frequency) demand(specification.level_at(f) >= 0.0, "a level at each frequency");
}

void read_as_table(const std::string& text) {
  const std::vector<std::string> steps = {"shock", "preload"};
  Table table;
  std::istringstream stream(text);
  if (!attempt([&] { table = parse_csv(stream, steps); })) return;
  if (table.has_column("step")) return;  // beside that of the rows' steps: no table of ours
  std::istringstream again(csv_text(table, steps));
  const Table same = parse_csv(again, steps);
  demand(same.columns.size() == table.columns.size() && same.n_rows() == table.n_rows() && same.step == table.step,
         "a table that is written reads back");
}

}  // namespace

}  // namespace dygita::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  using namespace dygita::fuzz;
  const std::string text = text_of(data, size);
  const MemoryFile file(text);
  read_as_signal(file.path());
  read_as_specification(file.path());
  read_as_table(text);
  return 0;
}
