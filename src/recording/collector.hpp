// Watches a run and keeps what the problem's outputs ask for; nothing else is computed.
#pragma once

#include <algorithm>
#include <memory>

#include "model/output.hpp"
#include "recording/part_watch.hpp"
#include "result/result.hpp"
#include "step/observer.hpp"
#include "watch/bolt_recorder.hpp"

namespace dygita {

// Of static or of dynamic steps, one after the other, each kind by itself: what a preload has stored, and what has been
// lost while gaps closed, says nothing of the motion that follows.
struct EnergyBooks {
  double energy = 0.0;                             // J, that the rest is held against
  double imbalance = 0.0, loss = 0.0, gain = 0.0;  // J, largest so far, of the balance and of the scheme
  double springs = 0.0;                            // J, largest that the springs of a penalty hold
  double worst_imbalance = 0.0, most_lost = 0.0, most_gained = 0.0, most_in_springs = 0.0;  // %, of what has ended
  double largest = 0.0;  // J, of `energy`, of what has ended
  void end(double at_rest);
  double imbalance_so_far(double at_rest) const {  // relative
    return std::max(0.01 * worst_imbalance, energy > at_rest ? imbalance / energy : 0.0);
  }
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
  double energy_of(const Instant& instant) const;
  EnergyBooks& books(bool is_static) { return is_static ? of_statics_ : of_motion_; }
  void finish_books(RunResult& result);
  void note_overload(const Instant& instant);
  bool is_overloaded(int i_step) const;
  void finish_outputs(RunResult& result);

  const Problem& problem_;
  std::vector<std::pair<const Output*, std::unique_ptr<Recorder>>> recorders_;
  Table convergence_;
  int missed_ = 0, missed_in_motion_ = 0;  // increments that have not converged, of all; up to the end of the motion
  std::vector<std::string> warnings_;
  std::vector<int> overloaded_;  // steps
  EnergyBooks of_statics_, of_motion_;
  Energies before_, last_;       // when steps of this kind, static or dynamic, began; of the last increment
  std::optional<bool> kind_;     // are they static?
  double before_springs_ = 0.0;  // J, the scheme's energy when the step began
  double largest_energy_ = 0.0;  // J
  bool joints_give_ = false;     // in motion: they dissipate
  PartWatch& parts_;
  BoltRecorder bolts_;
};

}  // namespace dygita
