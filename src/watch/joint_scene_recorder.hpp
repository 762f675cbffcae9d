// Watches a run for the joints as the report draws them (scenes.hpp): the state of the points of interfaces that an
// output has mapped.
#pragma once

#include <vector>

#include "result/scenes.hpp"
#include "step/observer.hpp"

namespace dygita {

// Evenly over the step, its last increment always.
bool is_sampled(const Instant& instant, int n_samples);

class JointSceneRecorder : public Observer {
 public:
  explicit JointSceneRecorder(const Problem& problem) : problem_(problem) {}

  void begin_step(const Instant&) override {}
  void accept(const Instant& instant) override;
  // Of all instants sampled those that tell most.
  std::vector<JointScenes> take();

 private:
  void find_joints(const Instant& instant);
  void keep_joints(const Instant& instant);

  const Problem& problem_;
  bool has_joints_ = false;
  int missed_ = 0;                   // increments so far that have not converged
  int samples_of_joints_ = 0;        // a step
  std::vector<int> surfaces_;        // of joints_
  std::vector<JointScenes> joints_;  // with all instants sampled
};

}  // namespace dygita
