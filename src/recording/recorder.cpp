#include "recording/recorder.hpp"

namespace dygita {

void TableRecorder::add_row(const Instant& instant, double time, const std::vector<double>& values) {
  CHECK(values.size() + 1 == table_.names.size(), "a row has one value a column");
  table_.whole_or_none([&] {
    table_.columns[0].push_back(time);
    for (size_t i = 0; i < values.size(); ++i) table_.columns[i + 1].push_back(values[i]);
    table_.step.push_back(instant.i_step);
    // A step starts with what the one before has left.
    const bool continues = instant.increment < 0 && !table_.converged.empty();
    table_.converged.push_back(continues ? table_.converged.back() : instant.converged ? 1.0 : 0.0);
  });
}

void TableRecorder::add_values(const std::vector<double>& values) {
  CHECK(values.size() == table_.names.size(), "a row has one value a column");
  table_.whole_or_none([&] {
    for (size_t i = 0; i < values.size(); ++i) table_.columns[i].push_back(values[i]);
  });
}

double TableRecorder::mean_time(const Instant& instant) {
  return instant.is_static() ? instant.time() : instant.time() - 0.5 * instant.interval();
}

}  // namespace dygita
