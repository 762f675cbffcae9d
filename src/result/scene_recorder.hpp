// Watches a run for what the report draws (scenes.hpp). Cheap: it copies displacements a few tens of times per run at
// most, and the state of the points of interfaces that an output has mapped.
#pragma once

#include <vector>

#include "result/result.hpp"
#include "result/scenes.hpp"
#include "result/skin_recorder.hpp"
#include "solution/observer.hpp"

namespace dygita {

class SceneRecorder : public Observer {
 public:
  explicit SceneRecorder(const Problem& problem) : problem_(problem), motion_(problem) {}

  void begin_step(const Instant&) override {}
  // Both are collective: of each part by the rank that watches it (watched_nodes.hpp).
  void accept(const Instant& instant) override;
  // Puts the scenes into the result, on rank 0; stresses are computed here.
  void finish(RunResult& result);

 private:
  void find_joints(const Instant& instant);
  void keep_assembly(const Instant& instant, AssemblyScene& scene);
  void gather(AssemblyScene& scene) const;
  void keep_joints(const Instant& instant);

  const Problem& problem_;
  SkinRecorder motion_;
  CutPtr cut_;
  WatchedNodes nodes_;                 // all
  AssemblyScene tightened_, shocked_;  // of the parts that are watched here; without displacements: not met yet
  double strain_energy_ = -1.0;        // J, of shocked_
  bool has_joints_ = false;
  int missed_ = 0;                   // increments so far that have not converged
  int samples_of_joints_ = 0;        // a step
  std::vector<int> surfaces_;        // of joints_
  std::vector<JointScenes> joints_;  // with all instants sampled
};

}  // namespace dygita
