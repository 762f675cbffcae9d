#include "watch/scene_recorder.hpp"

#include <algorithm>

#include "base/parallel.hpp"
#include "fem/assembly.hpp"
#include "watch/growth.hpp"
#include "watch/joint_scene_recorder.hpp"

namespace dygita {

namespace {

constexpr int samples_of_assembly = 40;  // a step

}  // namespace

void SceneRecorder::accept(const Instant& instant) {
  missed_ += !instant.converged;
  motion_.accept(instant);
  if (stresses_.is_nearest_to_limit()) keep_assembly(instant, stressed_);
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
  views_.take(instant);
  std::vector<double>& growth = growth_[&scene];
  growth.clear();
  for (size_t i = 0; i < scene.displacement.size(); ++i) {
    scene.displacement[i] = views_.field(static_cast<int>(i));
    growth.push_back(growth_at(instant, static_cast<int>(i)));
  }
}

// Of what this rank has of a part; empty where it has nothing.
Points SceneRecorder::strained(int part, const AssemblyScene& scene) const {
  const auto i = static_cast<size_t>(part);
  return without_growth(scene.displacement[i], growth_.at(&scene)[i], views_.of(part).mesh().nodes);
}

Vec SceneRecorder::stress_of(int part, const AssemblyScene& scene) const {
  if (views_.of(part).is_empty()) return {};
  return von_mises(nodal_stress(views_.of(part).mesh(), problem_.substructures[static_cast<size_t>(part)]->material,
                                strained(part, scene)));
}

Vec SceneRecorder::failure_of(int part, const AssemblyScene& scene) const {
  if (views_.of(part).is_empty()) return {};
  return nodal_failure(views_.of(part).mesh(), problem_.substructures[static_cast<size_t>(part)]->material,
                       strained(part, scene))
      .index;
}

StressedPart SceneRecorder::gather_stressed() {
  StressedPart stressed;
  const int part = stresses_.nearest_to_limit();
  if (part < 0 || stressed_.displacement.empty()) return stressed;
  const auto i = static_cast<size_t>(part);
  const bool is_index = !problem_.substructures[i]->yield;
  stressed = {part, is_index, stressed_.step, stressed_.time,
              is_index ? failure_of(part, stressed_) : stress_of(part, stressed_)};
  gather_part(part, stressed_.displacement[i], stressed.value);
  return stressed;
}

void SceneRecorder::gather(AssemblyScene& scene) const {
  scene.von_mises.resize(scene.displacement.size());
  parallel_for(static_cast<int>(scene.displacement.size()),
               [&](int i) { scene.von_mises[static_cast<size_t>(i)] = stress_of(i, scene); });
  for (size_t i = 0; i < scene.displacement.size(); ++i)
    gather_part(static_cast<int>(i), scene.displacement[i], scene.von_mises[i]);
}

// On rank 0 those of the whole part: of each of its ranks, nodes that it owns and five numbers for each.
void SceneRecorder::gather_part(int part, Points& displacement, Vec& stress) const {
  const PartView& view = views_.of(part);
  const std::vector<int> ranks = ranks_of(views_.cut(), part);
  if (ranks == std::vector<int>{0}) return;
  std::vector<double> own;
  for (Eigen::Index i = 0; i < stress.size(); ++i)
    if (const int node = static_cast<int>(i); view.owner(node) >= 0)
      own.insert(own.end(), {static_cast<double>(view.node(node)), displacement(0, i), displacement(1, i),
                             displacement(2, i), stress[i]});
  Points all(3, problem_.substructures[static_cast<size_t>(part)]->mesh->n_nodes());
  Vec of_all(all.cols());
  for (const int rank : ranks) {
    const std::vector<double> of_rank = ranks::to_first(rank, own);
    for (size_t k = 0; k < of_rank.size() && ranks::is_first(); k += 5) {
      const auto node = static_cast<Eigen::Index>(of_rank[k]);
      all.col(node) = Eigen::Map<const Vec3>(&of_rank[k + 1]);
      of_all[node] = of_rank[k + 4];
    }
  }
  displacement = std::move(all);
  stress = std::move(of_all);
}

void SceneRecorder::finish(std::vector<JointScenes> joints, RunResult& result) {
  auto scenes = std::make_shared<Scenes>();
  for (AssemblyScene* scene : {&tightened_, &shocked_}) {
    if (scene->displacement.empty()) continue;
    motion_.add(*scene, growth_.at(scene));
    gather(*scene);
    scenes->assembly.push_back(std::move(*scene));
  }
  scenes->stressed = gather_stressed();
  scenes->motion = motion_.take();
  scenes->joints = std::move(joints);
  result.scenes = std::move(scenes);
}

}  // namespace dygita
