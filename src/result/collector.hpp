// Watches a run and keeps what the problem's outputs ask for; nothing else is computed.
#pragma once

#include <functional>
#include <memory>

#include "result/bolt_recorder.hpp"
#include "result/error_estimator.hpp"
#include "result/frame.hpp"
#include "result/result.hpp"
#include "solution/observer.hpp"

namespace dygita {

// Rows of one output, filled as the run goes.
class Sampler {
 public:
  virtual ~Sampler() = default;
  virtual void begin_step(const Instant&) {}
  virtual void accept(const Instant& instant) = 0;
  Table take() { return std::move(table_); }
  // What it makes of its rows once the run is over, beside the table.
  virtual void summarise(RunResult&) {}

 protected:
  const Table& table() const { return table_; }
  explicit Sampler(Table table) : table_(std::move(table)) { table_.columns.resize(table_.names.size()); }
  void add_values(const std::vector<double>& values);  // a row without a step
  void add_row(const Instant& instant, double time, const std::vector<double>& values);
  // Time of quantities that are means over an increment: its middle; the end in a static step.
  static double mean_time(const Instant& instant);

 private:
  Table table_;
};

std::unique_ptr<Sampler> make_history_sampler(const Problem& problem, const Output& output);
std::unique_ptr<Sampler> make_resultant_sampler(const Problem& problem, const Output& output);
std::unique_ptr<Sampler> make_joint_sampler(const Problem& problem, const Output& output);
std::unique_ptr<Sampler> make_energy_sampler();
std::unique_ptr<Sampler> make_loop_sampler(const Problem& problem, const Output& output);
std::unique_ptr<Sampler> make_superelement_sampler(const Problem& problem, const Output& output);

// Openings and slips (m) that laws do not remember, from the displacements of the two sides: slips of contact without
// friction, which has no tangential unknown, while it is closed; both for laws of rates.
class FollowedMotion {
 public:
  void begin_step(const Instant& instant);
  void accept(const Instant& instant);
  // Of a surface's point, from its law's state where that has them; the slip is a vector.
  double opening(const Instant& instant, int surface, int point) const;
  Vec3 slip(const Instant& instant, int surface, int point) const;

 private:
  Points relative_displacement(const Instant& instant, int surface) const;
  std::vector<Points> before_, moved_;  // moved_: empty where nothing is followed
};

// Largest imbalances and penetrations of the run, in percent of the largest energy and in metres.
struct Extremes {
  double energy = 0.0, imbalance = 0.0, scheme_loss = 0.0, scheme_gain = 0.0, penetration = 0.0;
  double springs = 0.0,
         before_springs = 0.0;  // J, penalty: largest held by its springs, the scheme's energy at the step's start
};

class SpectrumField;

class Collector : public Observer {
 public:
  using FrameSink = std::function<void(const Frame&)>;
  Collector(const Problem& problem, FrameSink sink);
  ~Collector() override;

  void begin_step(const Instant& start) override;
  void accept(const Instant& instant) override;
  // Tables of all outputs, spectra included, convergence and figures.
  void finish(RunResult& result);

 private:
  void maybe_frame(const Instant& instant);
  double label_time(const Instant& instant) const;
  void watch(const Instant& instant);

  const Problem& problem_;
  FrameSink sink_;
  std::map<const Output*, std::unique_ptr<Sampler>> samplers_;
  std::map<const Output*, std::unique_ptr<SpectrumField>> fields_;
  std::shared_ptr<FollowedMotion> motion_;
  Table convergence_;
  Extremes extremes_;
  ErrorEstimator errors_;
  BoltRecorder bolts_;
};

// The frame of an instant with the fields of one vtk output.
Frame make_frame(const Instant& instant, const Output& output, const FollowedMotion& motion);

}  // namespace dygita
