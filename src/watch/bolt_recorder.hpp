// Watches the bolts of a run: the interfaces that some step shortens or preloads.
#pragma once

#include "model/bolt_rating.hpp"
#include "result/result.hpp"
#include "step/observer.hpp"

namespace dygita {

class BoltRecorder {
 public:
  explicit BoltRecorder(const Problem& problem);
  void begin_step(const Instant& start);
  void accept(const Instant& instant);
  // In the order of the problem's interfaces.
  std::vector<BoltSummary> take() { return std::move(bolts_); }

 private:
  // What a bolt is at one instant. Force: through the interface, N, tension positive, a mean over the time step in a
  // dynamic step; opening: plastic, mean over the area, m.
  struct Held {
    double force = 0.0, opening = 0.0, shortening = 0.0;
  };
  static Held held(const Instant& instant, int surface);
  void note_tightening(size_t bolt, const Tightening& by, bool is_to_force, int increments);
  // A contact that a bolt clamps, and the points of it that are nearest to the bolt's axis.
  struct Clamped {
    size_t bolt;
    int surface;
    double friction, safety;
    std::vector<char> has_point;
    double pressed = 0.0, least = 0.0;  // N, when all bolts were tight, and since
  };
  void find_clamped(const Instant& start);
  void follow_clamped(const Instant& instant);
  void follow_motion(const Instant& instant, size_t bolt, double force);

  std::vector<int> surfaces_;  // of each bolt; interfaces are the first surfaces
  std::vector<const Interface*> interfaces_;
  std::vector<BoltSummary> bolts_;
  std::vector<Held> now_, before_, tightened_;    // of each bolt; `before_`: an increment earlier
  std::vector<std::pair<double, double>> swing_;  // N, lowest and highest in the last tenth of the step
  std::vector<std::optional<BoltRating>> ratings_;
  std::vector<char> is_whole_;  // is all of the bolt in the model?
  std::vector<Clamped> clamped_;
  int last_tightening_ = -1;  // the last step that tightens some bolt
  bool is_dynamic_ = false;   // some dynamic step has begun
};

}  // namespace dygita
