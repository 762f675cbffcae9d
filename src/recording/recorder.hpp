// Watches a run for one output.
#pragma once

#include "estimates/error_estimator.hpp"
#include "model/output.hpp"
#include "result/result.hpp"
#include "step/observer.hpp"

namespace dygita {

class Recorder {
 public:
  virtual ~Recorder() = default;
  virtual void begin_step(const Instant&) {}
  virtual void accept(const Instant& instant) = 0;
  // Once, when the run has ended: hands over what it has.
  virtual void finish(Table& table, Findings& findings) = 0;
};

// One whose table grows by a row now and then.
class TableRecorder : public Recorder {
 public:
  void finish(Table& table, Findings&) override { table = std::move(table_); }

 protected:
  explicit TableRecorder(const Columns& columns) : table_(empty_table(columns)) {}
  void add_values(const std::vector<double>& values);  // a row without a step
  void add_row(const Instant& instant, double time, const std::vector<double>& values);
  // Time of quantities that are means over an increment: its middle; the end in a static step.
  static double mean_time(const Instant& instant);

 private:
  Table table_;
};

// What outputs that are made of others' have at hand.
struct RunEnd {
  const Problem& problem;
  const RunResult& result;          // with all tables that were recorded
  ErrorEstimator::Estimate errors;  // of the dynamic steps
  ErrorEstimator::Estimate static_errors{};
};

}  // namespace dygita
