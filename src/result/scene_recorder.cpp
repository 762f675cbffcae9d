#include "result/scene_recorder.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "fem/assembly.hpp"
#include "result/surface_sums.hpp"

namespace dygita {

namespace {

constexpr int samples_of_assembly = 40, samples_of_joints = 24, kept_of_joints = 6;  // a step, a step, of all

// Evenly over the step, its last increment always.
bool is_sampled(const Instant& instant, int n_samples) {
  const int n = instant.model.step->n_increments(), i = instant.increment + 1;
  const long samples = std::min(n, n_samples);
  return (i * samples) / n != ((i - 1) * samples) / n;
}

// How much of a joint is not as it was assembled: points that are open, slip or yield, and how far.
double event(const JointScene& scene) {
  double sum = 0.0;
  for (size_t i = 0; i < scene.status.size(); ++i)
    sum += scene.status[i] == 0 ? 2.0 : scene.status[i] == 2 ? 1.0 : 0.0;
  return sum;
}

// The last static instant before the motion, the last instant of all, the most eventful one, and others evenly between.
std::vector<JointScene> choose(std::vector<JointScene> sampled) {
  const int n = static_cast<int>(sampled.size());
  if (n <= kept_of_joints) return sampled;
  int first_dynamic = 0, worst = 0;
  while (first_dynamic < n && sampled[first_dynamic].is_static) ++first_dynamic;
  const bool is_all_static = first_dynamic == n;
  const int start = is_all_static ? 0 : std::max(first_dynamic - 1, 0);
  for (int i = start; i < n; ++i)
    if (event(sampled[i]) > event(sampled[worst])) worst = i;
  std::set<int> kept = {start, n - 1, std::max(worst, start)};
  for (int m = kept_of_joints; static_cast<int>(kept.size()) < kept_of_joints && m < 4 * kept_of_joints; ++m)
    for (int k = 1; k < m && static_cast<int>(kept.size()) < kept_of_joints; ++k) {
      const int i = start + static_cast<int>(std::lround(static_cast<double>(k) * (n - 1 - start) / m));
      const bool is_close = std::any_of(kept.begin(), kept.end(), [&](int other) { return 2 * std::abs(other - i) * m < n - 1 - start; });
      if (!is_close) kept.insert(i);
    }
  std::vector<JointScene> chosen;
  for (const int i : kept) chosen.push_back(std::move(sampled[i]));
  return chosen;
}

}  // namespace

void SceneRecorder::accept(const Instant& instant) {
  if (!has_joints_) find_joints(instant);
  const bool is_last = instant.increment + 1 == instant.model.step->n_increments();
  if (instant.is_static()) {
    if (is_last && shocked_.displacement.empty()) keep_assembly(instant, tightened_);
  } else if (is_sampled(instant, samples_of_assembly) && instant.state.energies.strain > strain_energy_) {
    strain_energy_ = instant.state.energies.strain;
    keep_assembly(instant, shocked_);
  }
  if (!joints_.empty() && is_sampled(instant, samples_of_joints)) keep_joints(instant);
}

void SceneRecorder::keep_assembly(const Instant& instant, AssemblyScene& scene) const {
  scene.step = instant.model.step->name;
  scene.is_static = instant.is_static();
  scene.time = instant.time();
  scene.displacement.resize(problem_.substructures.size());
  for (size_t i = 0; i < scene.displacement.size(); ++i) scene.displacement[i] = instant.displacement(static_cast<int>(i));
}

void SceneRecorder::find_joints(const Instant& instant) {
  has_joints_ = true;
  for (const OutputPtr& output : problem_.outputs) {
    if (output->kind != OutputKind::joint) continue;
    for (const int s : surfaces_of(instant, output->on)) {
      const Surface& surface = (*instant.model.surfaces)[s];
      const bool is_plastic = surface.interface && surface.interface->kind == InterfaceKind::plastic;
      const bool is_contact = surface.law && surface.law->rubs();
      if ((!is_plastic && !is_contact) || std::find(surfaces_.begin(), surfaces_.end(), s) != surfaces_.end()) continue;
      surfaces_.push_back(s);
      JointScenes& joint = joints_.emplace_back();
      joint.name = surface.name();
      joint.is_contact = is_contact;
      joint.has_slip = is_contact && surface.law->acts_on(1);
      const Substructure& body = *problem_.substructures[surface.part_1];
      joint.points.resize(3, surface.n_points());
      std::map<int, int> point_of;
      for (int i = 0; i < surface.n_points(); ++i) {
        point_of[surface.facing.nodes_1[i]] = i;
        joint.points.col(i) = body.mesh->nodes.col(surface.facing.nodes_1[i]) + body.place;
      }
      for (Facet facet : surface.facing.facets) {
        for (int i = 0; i < facet.n_nodes; ++i) facet.nodes[i] = point_of.at(facet.nodes[i]);
        joint.facets.push_back(facet);
      }
    }
  }
}

void SceneRecorder::keep_joints(const Instant& instant) {
  for (size_t j = 0; j < joints_.size(); ++j) {
    const Surface& surface = (*instant.model.surfaces)[surfaces_[j]];
    const std::vector<LawState>& points = instant.state.surfaces[surfaces_[j]].points;
    JointScene& scene = joints_[j].instants.emplace_back();
    scene.step = instant.model.step->name;
    scene.is_static = instant.is_static();
    scene.time = instant.time();
    for (int i = 0; i < surface.n_points(); ++i) {
      const LawState& p = points[i];
      scene.status.push_back(static_cast<unsigned char>(p.status));
      scene.pressure.push_back(static_cast<float>(-p.force.dot(surface.facing.normals.col(i)) / surface.facing.areas[i]));
      if (joints_[j].has_slip) scene.slip.push_back(static_cast<float>(p.slip.norm()));
      if (!joints_[j].is_contact) scene.plastic_opening.push_back(static_cast<float>(p.plastic_opening));
    }
  }
}

void SceneRecorder::finish(RunResult& result) {
  auto scenes = std::make_shared<Scenes>();
  for (AssemblyScene* scene : {&tightened_, &shocked_}) {
    if (scene->displacement.empty()) continue;
    for (size_t i = 0; i < problem_.substructures.size(); ++i) {
      const Substructure& part = *problem_.substructures[i];
      scene->von_mises.push_back(von_mises(nodal_stress(*part.mesh, part.material, scene->displacement[i])));
    }
    scenes->assembly.push_back(std::move(*scene));
  }
  for (JointScenes& joint : joints_) {
    joint.instants = choose(std::move(joint.instants));
    scenes->joints.push_back(std::move(joint));
  }
  result.scenes = std::move(scenes);
}

}  // namespace dygita
