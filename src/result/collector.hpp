// Watches a run and keeps what the problem's outputs ask for; nothing else is computed.
#pragma once

#include <memory>

#include "model/output.hpp"
#include "result/bolt_recorder.hpp"
#include "result/part_watch.hpp"
#include "result/result.hpp"
#include "solution/observer.hpp"

namespace dygita {

// Largest imbalances and penetrations of the run, in percent of the largest energy and in metres.
struct Extremes {
  double energy = 0.0, imbalance = 0.0, scheme_loss = 0.0, scheme_gain = 0.0;
  double springs = 0.0,
         before_springs = 0.0;  // J, penalty: largest held by its springs, the scheme's energy at the step's start
};

class Collector : public Observer {
 public:
  // Frames of the run go to the sink, which may be empty. parts: watches the same run, each increment before it is told
  // here, and has settled before this finishes.
  Collector(const Problem& problem, PartWatch& parts, const FrameSink& sink);
  ~Collector() override;

  void begin_step(const Instant& start) override;
  void accept(const Instant& instant) override;
  // Tables and findings of all outputs, convergence and figures.
  void finish(RunResult& result);

 private:
  void watch(const Instant& instant);
  void note_overload(const Instant& instant);
  bool is_overloaded(int i_step) const;
  void finish_outputs(RunResult& result);

  const Problem& problem_;
  std::vector<std::pair<const Output*, std::unique_ptr<Recorder>>> recorders_;
  Table convergence_;
  int missed_ = 0, missed_in_motion_ = 0;  // increments that have not converged, of all; up to the end of the motion
  std::vector<std::string> warnings_;
  std::vector<int> overloaded_;  // steps
  Extremes extremes_;
  PartWatch& parts_;
  BoltRecorder bolts_;
};

}  // namespace dygita
