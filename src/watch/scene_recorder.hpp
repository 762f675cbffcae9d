// Watches a run for the assembly as the report draws it (scenes.hpp). Cheap: it copies displacements a few tens of
// times per run at most.
#pragma once

#include <map>
#include <vector>

#include "result/result.hpp"
#include "result/scenes.hpp"
#include "step/observer.hpp"
#include "watch/skin_recorder.hpp"
#include "watch/stress_recorder.hpp"

namespace dygita {

class SceneRecorder : public Observer {
 public:
  // `stresses` looks at each instant before this does.
  SceneRecorder(const Problem& problem, PartViews& views, const StressRecorder& stresses)
      : problem_(problem), views_(views), stresses_(stresses), motion_(problem, views) {}

  void begin_step(const Instant&) override {}
  // Both are collective: each rank keeps what it has of the parts.
  void accept(const Instant& instant) override;
  // Puts the scenes into the result, on rank 0, those of joints with them; stresses are computed here. The stresses
  // have settled.
  void finish(std::vector<JointScenes> joints, RunResult& result);

 private:
  void keep_assembly(const Instant& instant, AssemblyScene& scene);
  void gather(AssemblyScene& scene) const;
  StressedPart gather_stressed();
  Points strained(int part, const AssemblyScene& scene) const;  // where there is something of the part
  Vec stress_of(int part, const AssemblyScene& scene) const;
  Vec failure_of(int part, const AssemblyScene& scene) const;
  void gather_part(int part, Points& displacement, Vec& stress) const;

  const Problem& problem_;
  PartViews& views_;
  const StressRecorder& stresses_;
  SkinRecorder motion_;
  AssemblyScene tightened_, shocked_, stressed_;  // of the views (part_views.hpp); without displacements: not met yet
  std::map<const AssemblyScene*, std::vector<double>> growth_;  // of each part, strain that does not stress it
  double strain_energy_ = -1.0;                                 // J, of shocked_
  int missed_ = 0;                                              // increments so far that have not converged
};

}  // namespace dygita
