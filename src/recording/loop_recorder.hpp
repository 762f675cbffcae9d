// Watches force and displacement of a joint for output.loop.
#pragma once

#include <map>

#include "recording/recorder.hpp"
#include "watch/moved_side.hpp"
#include "watch/weighted_nodes.hpp"

namespace dygita {

struct LoopRequest {
  std::vector<Target> on;             // interfaces, or supports
  Vec3 direction;                     // unit
  std::vector<FaceOrRegion> between;  // one (against the ground) or two; empty: both sides of what it is on
  StepPtr after;                      // none: from the start
  std::vector<StepPtr> steps;         // none: those of one kind that follow

  // The problem's steps in which cycles are looked for: from the first to before the last.
  std::pair<int, int> range(const Problem& problem) const;

  bool is_of_supports() const { return std::holds_alternative<SupportPtr>(on.front()); }
};

// What a loop needs to know of its rows to be judged.
struct LoopTrace {
  std::vector<char> converged;
  std::vector<double> balance;
  double moved = 0.0;  // m, largest displacement of either side
};

class LoopRecorder : public TableRecorder {
 public:
  LoopRecorder(const Columns& columns, const Problem& problem, const LoopRequest& request);
  void begin_step(const Instant& instant) override;
  void accept(const Instant& instant) override;
  // Leaves a LoopTrace as the findings' model.
  void finish(Table& table, Findings& findings) override;

 private:
  void add(const Instant& instant, double time, const std::vector<double>& values);
  double displacement(const Instant& instant);

  const Problem& problem_;
  const LoopRequest& request_;
  std::vector<WeightedNodes> between_;
  std::map<int, MovedSides> sides_;  // of the surfaces it is on
  LoopTrace trace_;
  double before_ = 0.0;
};

}  // namespace dygita
