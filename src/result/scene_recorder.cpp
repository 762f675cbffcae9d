#include "result/scene_recorder.hpp"

#include <algorithm>

#include "base/parallel.hpp"
#include "fem/assembly.hpp"
#include "result/joint_scene_recorder.hpp"

namespace dygita {

namespace {

constexpr int samples_of_assembly = 40;  // a step

}  // namespace

void SceneRecorder::accept(const Instant& instant) {
  missed_ += !instant.converged;
  if (!cut_) {
    cut_ = instant.model.cut;
    nodes_ = WatchedNodes(*cut_, all_nodes(problem_));
  }
  motion_.accept(instant);
  const bool is_last = instant.increment + 1 == instant.model.step->n_increments();
  if (instant.is_static()) {
    if (is_last && shocked_.displacement.empty()) keep_assembly(instant, tightened_);
  } else if (is_sampled(instant, samples_of_assembly) && instant.state.energies.strain > strain_energy_) {
    strain_energy_ = instant.state.energies.strain;
    keep_assembly(instant, shocked_);
  }
}

void SceneRecorder::keep_assembly(const Instant& instant, AssemblyScene& scene) {
  scene.step = instant.model.step->name;
  scene.is_static = instant.is_static();
  scene.missed = missed_;
  scene.time = instant.time();
  scene.displacement.resize(problem_.substructures.size());
  nodes_.take(instant);
  for (size_t i = 0; i < scene.displacement.size(); ++i)
    scene.displacement[i] = nodes_.displacement(static_cast<int>(i));
}

void SceneRecorder::gather(AssemblyScene& scene) const {
  scene.von_mises.resize(scene.displacement.size());
  parallel_for(static_cast<int>(scene.displacement.size()), [&](int i) {
    const Substructure& part = *problem_.substructures[static_cast<size_t>(i)];
    if (is_watched_here(*cut_, i))
      scene.von_mises[static_cast<size_t>(i)] =
          von_mises(nodal_stress(*part.mesh, part.material, scene.displacement[static_cast<size_t>(i)]));
  });
  for (size_t i = 0; i < scene.displacement.size(); ++i) {
    const int watcher = watcher_of(*cut_, static_cast<int>(i));
    if (watcher == 0) continue;
    Points& u = scene.displacement[i];
    Vec& stress = scene.von_mises[i];
    const std::vector<double> moved = ranks::to_first(watcher, {u.data(), u.data() + u.size()}),
                              loaded = ranks::to_first(watcher, {stress.begin(), stress.end()});
    u = Eigen::Map<const Points>(moved.data(), 3, static_cast<Eigen::Index>(moved.size() / 3));
    stress = Eigen::Map<const Vec>(loaded.data(), static_cast<Eigen::Index>(loaded.size()));
  }
}

void SceneRecorder::finish(std::vector<JointScenes> joints, RunResult& result) {
  auto scenes = std::make_shared<Scenes>();
  for (AssemblyScene* scene : {&tightened_, &shocked_}) {
    if (scene->displacement.empty()) continue;
    motion_.add(*scene);
    gather(*scene);
    scenes->assembly.push_back(std::move(*scene));
  }
  scenes->motion = motion_.take();
  scenes->joints = std::move(joints);
  result.scenes = std::move(scenes);
}

}  // namespace dygita
