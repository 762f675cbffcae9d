// Watches a run for the assembly as the report draws it (scenes.hpp). Cheap: it copies displacements a few tens of
// times per run at most.
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
  // Puts the scenes into the result, on rank 0, those of joints with them; stresses are computed here.
  void finish(std::vector<JointScenes> joints, RunResult& result);

 private:
  void keep_assembly(const Instant& instant, AssemblyScene& scene);
  void gather(AssemblyScene& scene) const;

  const Problem& problem_;
  SkinRecorder motion_;
  CutPtr cut_;
  WatchedNodes nodes_;                 // all
  AssemblyScene tightened_, shocked_;  // of the parts that are watched here; without displacements: not met yet
  double strain_energy_ = -1.0;        // J, of shocked_
  int missed_ = 0;                     // increments so far that have not converged
};

}  // namespace dygita
