// What cannot act as it is told: forces on nodes whose motion is prescribed, preloads in series that differ.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "base/names.hpp"
#include "checks/parts.hpp"
#include "checks/prescribed.hpp"
#include "mesh/face_nodes.hpp"
#include "model/load.hpp"

namespace dygita::check {

namespace {

// The nodes of a place as loads see them; `nodes` are their numbers.
LoadedNodes loaded_nodes(const FaceOrRegion& place, std::vector<int>& nodes) {
  const Mesh& mesh = *part_of(place).mesh;
  LoadedNodes loaded;
  if (const Face* face = std::get_if<Face>(&place)) {
    FaceNodes at = face_nodes(mesh, face->facets());
    nodes = std::move(at.nodes);
    loaded.weights = at.weights;
    loaded.vectors = at.vectors;
    loaded.moments = at.moments;
  } else {
    nodes = nodes_at(place);
    loaded.weights = Vec::Ones(static_cast<Eigen::Index>(nodes.size()));
    loaded.vectors = Points::Zero(3, static_cast<Eigen::Index>(nodes.size()));
  }
  loaded.positions = mesh.nodes(Eigen::all, nodes);
  if (loaded.moments.cols() == 0) loaded.moments = loaded.positions;
  return loaded;
}

// Axes along which a step prescribes the motion of each node of a part: 3 x nodes.
using Axes = Eigen::Array<bool, 3, Eigen::Dynamic>;

void hold_by_supports(const Problem& problem, const Step& step, const Substructure& part, Axes& held) {
  for (const SupportPtr& support : supports_of(problem, step)) {
    const Directions directions = support->kind->holds(step.is_static);
    for (const FaceOrRegion& place : support->on) {
      if (directions == Directions::none || &part_of(place) != &part) continue;
      std::vector<int> nodes;
      const Points vectors = loaded_nodes(place, nodes).vectors;
      for (size_t i = 0; i < nodes.size(); ++i)
        for (int axis = 0; axis < 3; ++axis) {
          const auto vector = vectors.col(static_cast<Eigen::Index>(i));
          held(axis, nodes[i]) |= directions.axes[static_cast<size_t>(axis)] ||
                                  (directions.along_normals && std::abs(vector[axis]) > (1 - 1e-9) * vector.norm());
        }
    }
  }
}

Axes held_axes(const Problem& problem, const Step& step, const std::vector<Prescribed>& prescribed,
               const Substructure& part) {
  Axes held = Axes::Constant(3, part.mesh->nodes.cols(), false);
  hold_by_supports(problem, step, part, held);
  for (const auto& [load, motion] : prescribed) {
    if (&part_of(motion.on) != &part) continue;
    for (const int node : nodes_at(motion.on))
      for (int axis = 0; axis < 3; ++axis) held(axis, node) |= motion.along[axis].has_value();
  }
  return held;
}

bool acts_on_held_nodes_only(const NodalForces& force, const Axes& held) {
  std::vector<int> nodes;
  const Points forces = force.unit(loaded_nodes(force.on, nodes));
  const double all = forces.cwiseAbs().sum();
  double free = 0.0;
  for (size_t i = 0; i < nodes.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      if (!held(axis, nodes[i])) free += std::abs(forces(axis, static_cast<Eigen::Index>(i)));
  return all > 0.0 && free <= 1e-9 * all;
}

void doubt_idle_forces(const Problem& problem, const Step& step) {
  std::map<const Substructure*, Axes> held;
  const std::vector<Prescribed> prescribed = prescribed_in(step);
  for (const LoadPtr& load : step.loads)
    for (const Effect& effect : load->effects()) {
      const auto* force = std::get_if<NodalForces>(&effect);
      if (!force) continue;
      const Substructure& part = part_of(force->on);
      if (!held.contains(&part)) held[&part] = held_axes(problem, step, prescribed, part);
      if (!acts_on_held_nodes_only(*force, held[&part])) continue;
      doubt(problem, load->origin,
            fmt::format(
                "step '{}': {} on {} has no effect: a support or another load prescribes the motion of all its nodes",
                step.name, force->name, describe(target_of(force->on))));
    }
}

struct Preload {
  PreloadForce effect;
  Origin origin;  // of its load
};
using Preloads = std::vector<Preload>;

// Substructures joined by the interfaces that a step does not tighten: the group of each.
class Groups {
 public:
  Groups(const Problem& problem, const Preloads& preloads) : problem_(problem) {
    group_.resize(problem.substructures.size());
    std::iota(group_.begin(), group_.end(), 0);
    for (const InterfacePtr& interface : problem.interfaces) {
      const bool is_tightened = std::any_of(preloads.begin(), preloads.end(),
                                            [&](const Preload& preload) { return preload.effect.on == interface; });
      if (!is_tightened) join(of(interface->side_1), of(interface->side_2));
    }
  }

  int of(const Face& face) const { return of(*face.part); }
  int of(const Substructure& part) const { return group_[index_of(problem_.substructures, &part)]; }

 private:
  void join(int a, int b) { std::replace(group_.begin(), group_.end(), a, b); }

  const Problem& problem_;
  std::vector<int> group_;
};

// Groups that something else than a preload may push: supports, forces, prescribed motion.
std::vector<char> are_pushed(const Problem& problem, const Step& step, const Groups& groups) {
  std::vector<char> pushed(problem.substructures.size(), 0);
  const auto push = [&](const FaceOrRegion& place) { pushed[groups.of(part_of(place))] = 1; };
  for (const SupportPtr& support : supports_of(problem, step))
    std::for_each(support->on.begin(), support->on.end(), push);
  for (const LoadPtr& load : step.loads)
    for (const Effect& effect : load->effects()) {
      if (std::holds_alternative<BodyForce>(effect)) std::fill(pushed.begin(), pushed.end(), 1);
      if (const auto* force = std::get_if<NodalForces>(&effect)) push(force->on);
      if (const auto* motion = std::get_if<PrescribedMotion>(&effect)) push(motion->on);
    }
  return pushed;
}

struct Pull {
  std::string name;  // "'shank' (8 kN)"
  Vec3 force;        // N
  Origin origin;
};

// The preloads that pull a group outwards.
std::vector<Pull> pulls_on(int group, const Groups& groups, const Preloads& preloads) {
  std::vector<Pull> pulls;
  for (const auto& [preload, origin] : preloads) {
    const Interface& bolt = *preload.on;
    const bool first = groups.of(bolt.side_1) == group, second = groups.of(bolt.side_2) == group;
    if (first == second) continue;
    const Face& side = first ? bolt.side_1 : bolt.side_2;
    Vec3 area = Vec3::Zero();
    for (const Facet& facet : side.facets()) area += facet_area_vector(side.part->mesh->nodes, facet);
    const double force = preload.value.history.value(1.0);
    pulls.push_back({fmt::format("'{}' ({:.4g} kN)", bolt.name, 1e-3 * force), force * area.normalized(), origin});
  }
  return pulls;
}

// What a bolt clamps must be held against it: by another interface, a support or a load.
void refuse_alone(const Problem& problem, const Step& step, const std::string& part, const Pull& pull) {
  if (pull.force.norm() == 0.0) return;
  fail(problem, pull.origin,
       fmt::format("step '{}': load.preload of {} has no reaction path through '{}': no other interface, support or "
                   "load holds it",
                   step.name, pull.name, part),
       "add an interface with what it clamps, or hold it by a support");
}

// A group that only preloads along one line pull at is in equilibrium where their sum is zero, and nowhere else.
void refuse_unbalanced(const Problem& problem, const Step& step, const std::string& part,
                       const std::vector<Pull>& pulls) {
  Vec3 sum = Vec3::Zero();
  double largest = 0.0;
  std::string names;
  for (const Pull& pull : pulls) {
    if (std::abs(pull.force.normalized().dot(pulls.front().force.normalized())) < 0.999) return;
    sum += pull.force;
    largest = std::max(largest, pull.force.norm());
    names += (names.empty() ? "" : ", ") + pull.name;
  }
  if (sum.norm() <= 1e-3 * largest) return;
  fail(problem, pulls.back().origin,
       fmt::format("step '{}': only the preload of {} acts along its axis on '{}', and {:.4g} kN is unbalanced: there "
                   "is no equilibrium",
                   step.name, names, part, 1e-3 * sum.norm()),
       "bolts in series carry the same force: give them equal forces, or preload one of them");
}

void check_preloads(const Problem& problem, const Step& step) {
  Preloads preloads;
  for (const LoadPtr& load : step.loads)
    for (const Effect& effect : load->effects())
      if (const auto* preload = std::get_if<PreloadForce>(&effect)) preloads.push_back({*preload, load->origin});
  if (preloads.empty()) return;
  const Groups groups(problem, preloads);
  const std::vector<char> pushed = are_pushed(problem, step, groups);
  std::vector<char> seen(problem.substructures.size(), 0);
  for (const SubstructurePtr& part : problem.substructures) {
    const int group = groups.of(*part);
    if (pushed[group] || std::exchange(seen[group], 1)) continue;
    const std::vector<Pull> pulls = pulls_on(group, groups, preloads);
    if (pulls.size() == 1) refuse_alone(problem, step, part->name, pulls.front());
    if (pulls.size() > 1) refuse_unbalanced(problem, step, part->name, pulls);
  }
}

}  // namespace

void balance(const Problem& problem) {
  for (const StepPtr& step : problem.steps) {
    doubt_idle_forces(problem, *step);
    if (step->is_static) check_preloads(problem, *step);
  }
}

}  // namespace dygita::check
