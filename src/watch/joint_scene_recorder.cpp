#include "watch/joint_scene_recorder.hpp"

#include <algorithm>
#include <cmath>

#include "law/law.hpp"
#include "watch/surface_sums.hpp"

namespace dygita {

namespace {

constexpr int most_samples_of_joints = 80, kept_of_joints = 6;  // a step, of all
constexpr double points_kept = 2e6;                             // of all joints and samples of a step: some 30 MB

// How much changes from one instant to the next: the share of points whose state does, and of the largest pressure.
double change(const JointScene& a, const JointScene& b, double largest_pressure) {
  double n_changed = 0.0, pressure = 0.0;
  for (size_t i = 0; i < a.status.size(); ++i) {
    n_changed += a.status[i] != b.status[i];
    pressure += std::abs(static_cast<double>(a.pressure[i]) - b.pressure[i]);
  }
  const double n = std::max<double>(1.0, static_cast<double>(a.status.size()));
  return n_changed / n + (largest_pressure > 0.0 ? pressure / (n * largest_pressure) : 0.0);
}

// The last static instant before the motion, the last of all, and between them instants at even time steps and
// change together: where much changes there are more.
std::vector<JointScene> choose(std::vector<JointScene> sampled) {
  const int n = static_cast<int>(sampled.size());
  int first_dynamic = 0;
  while (first_dynamic < n && sampled[first_dynamic].is_static) ++first_dynamic;
  const int start = first_dynamic == n ? 0 : std::max(first_dynamic - 1, 0);
  if (n - start <= kept_of_joints) {
    sampled.erase(sampled.begin(), sampled.begin() + start);
    return sampled;
  }
  double largest_pressure = 0.0;
  for (const JointScene& scene : sampled)
    for (const float p : scene.pressure)
      if (std::isfinite(p)) largest_pressure = std::max(largest_pressure, std::abs(static_cast<double>(p)));
  std::vector<double> way(n, 0.0);
  for (int i = start + 1; i < n; ++i) {
    const double changed = change(sampled[i - 1], sampled[i], largest_pressure);
    way[i] = way[i - 1] + (std::isfinite(changed) ? changed : 0.0);
  }
  // Half of the places follow the change, half the time.
  const double unit = way[n - 1] > 0.0 ? 1.0 / way[n - 1] : 0.0;
  for (int i = start; i < n; ++i) way[i] = unit * way[i] + static_cast<double>(i - start) / (n - 1 - start);
  std::vector<JointScene> chosen;
  int last = start - 1;
  for (int k = 0; k < kept_of_joints; ++k) {
    int i = last + 1;
    while (i < n - (kept_of_joints - k) && way[i] < way[n - 1] * k / (kept_of_joints - 1)) ++i;
    if (k == kept_of_joints - 1) i = n - 1;
    chosen.push_back(std::move(sampled[i]));
    last = i;
  }
  return chosen;
}

}  // namespace

bool is_sampled(const Instant& instant, int n_samples) {
  const int n = instant.model.step->n_increments(), i = instant.increment + 1;
  const long samples = std::min(n, n_samples);
  return (i * samples) / n != ((i - 1) * samples) / n;
}

void JointSceneRecorder::accept(const Instant& instant) {
  missed_ += !instant.converged;
  if (!has_joints_) find_joints(instant);
  if (!joints_.empty() && is_sampled(instant, samples_of_joints_)) keep_joints(instant);
}

void JointSceneRecorder::find_joints(const Instant& instant) {
  has_joints_ = true;
  for (const OutputPtr& output : problem_.outputs) {
    for (const int s : surfaces_of(instant, output->mapped())) {
      const Surface& surface = (*instant.model.surfaces)[s];
      const Shown shown = surface.declared_law().shown();
      if ((!shown.plastic_opening && !shown.gap) || std::find(surfaces_.begin(), surfaces_.end(), s) != surfaces_.end())
        continue;
      surfaces_.push_back(s);
      JointScenes& joint = joints_.emplace_back();
      joint.name = surface.name();
      joint.is_contact = shown.gap;
      joint.has_slip = shown.slip;
      joint.points = surface.facing.places;
      joint.facets = surface.facing.facets;
    }
  }
  double n_points = 1.0;
  for (const JointScenes& joint : joints_) n_points += static_cast<double>(joint.points.cols());
  samples_of_joints_ =
      static_cast<int>(std::clamp(points_kept / n_points, 12.0, static_cast<double>(most_samples_of_joints)));
}

void JointSceneRecorder::keep_joints(const Instant& instant) {
  for (size_t j = 0; j < joints_.size(); ++j) {
    const Surface& surface = (*instant.model.surfaces)[surfaces_[j]];
    const std::vector<LawState>& points = instant.surface(surfaces_[j]).points;
    JointScene& scene = joints_[j].instants.emplace_back();
    scene.step = instant.model.step->name;
    scene.is_static = instant.is_static();
    scene.missed = missed_;
    scene.time = instant.time();
    for (int i = 0; i < surface.n_points(); ++i) {
      const LawState& p = points[i];
      scene.status.push_back(static_cast<unsigned char>(p.status));
      scene.pressure.push_back(
          static_cast<float>(-p.force.dot(surface.facing.normals.col(i)) / surface.facing.areas[i]));
      if (joints_[j].has_slip) scene.slip.push_back(static_cast<float>(p.slip.norm()));
      if (!joints_[j].is_contact) scene.plastic_opening.push_back(static_cast<float>(p.plastic_opening));
    }
  }
}

std::vector<JointScenes> JointSceneRecorder::take() {
  for (JointScenes& joint : joints_) joint.instants = choose(std::move(joint.instants));
  return std::move(joints_);
}

}  // namespace dygita
