// Watches the bolts of a run: the interfaces that some step shortens or preloads.
#pragma once

#include "result/result.hpp"
#include "solution/observer.hpp"

namespace dygita {

class BoltRecorder {
 public:
  explicit BoltRecorder(const Problem& problem);
  void begin_step(const Instant& start);
  void accept(const Instant& instant);
  // In the order of the problem's interfaces.
  std::vector<BoltSummary> take() { return std::move(bolts_); }

 private:
  // Force through the interface, N, tension positive; a mean over the time step in a dynamic step.
  static double force(const Instant& instant, int surface);
  void note_tightening(size_t bolt, const Tightening& by, bool is_to_force, int increments);

  std::vector<int> surfaces_;  // of each bolt; interfaces are the first surfaces
  std::vector<const Interface*> interfaces_;
  std::vector<BoltSummary> bolts_;
  bool is_dynamic_ = false;  // some dynamic step has begun
};

}  // namespace dygita
