#include "watch/overloaded_joints.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <numeric>

#include "law/law.hpp"
#include "numerics/dense.hpp"
#include "watch/rigid_balance.hpp"

namespace dygita {

namespace {

constexpr double balanced = 0.02;  // of the load: a smaller rest is what the iteration has left
constexpr double gripping = 0.01;  // of the normal force: sticking points with less hold nothing

// An interface or a wall at the end of what it can hold.
struct LimitJoint {
  const Surface* surface;
  Vec3 force = Vec3::Zero();   // N, on side 1
  Vec3 normal = Vec3::Zero();  // unit, of a flat joint that is closed
  bool is_open = true;
  bool yields = false;
  bool is_released = false;  // by a load.release
};

// Is every point that carries something at its limit? Then how it stands.
std::optional<LimitJoint> at_limit(const Surface& surface, const SurfaceState& state) {
  const Shown shown = surface.declared_law().shown();
  if (!shown.states) return std::nullopt;
  LimitJoint joint{&surface};
  joint.yields = !shown.gap;
  double all = 0.0, sticking = 0.0;
  for (size_t i = 0; i < state.points.size(); ++i) {
    const LawState& point = state.points[i];
    joint.force += point.force;
    const double normal = std::abs(point.force.dot(surface.facing.normals.col(static_cast<Eigen::Index>(i))));
    all += normal;
    if (point.status == PointState::stick) sticking += normal;
  }
  if (sticking > gripping * all) return std::nullopt;
  if (joint.yields && all == 0.0) return std::nullopt;
  joint.is_open = all == 0.0;
  const Vec3 area = surface.facing.normals * surface.facing.areas;
  if (!joint.is_open && area.norm() > 0.99 * surface.facing.areas.sum()) joint.normal = area.normalized();
  return joint;
}

class Groups {
 public:
  explicit Groups(int n) : leader_(n) { std::iota(leader_.begin(), leader_.end(), 0); }
  int of(int i) const {
    while (leader_[i] != i) i = leader_[i];
    return i;
  }
  void join(int a, int b) { leader_[std::max(of(a), of(b))] = std::min(of(a), of(b)); }

 private:
  std::vector<int> leader_;
};

// A group of parts, and what acts on it from outside.
struct Group {
  std::vector<int> parts;
  Vec3 load = Vec3::Zero();        // N
  Mat3 held = Mat3::Zero();        // sum of d d' over the directions that something holds
  std::vector<LimitJoint> joints;  // forces on the group
  bool is_grounded = false;
};

void add_part(const Instant& instant, int part, Group& group) {
  group.parts.push_back(part);
  const Points force = instant.model.external_force(part, instant.state);
  const Interior& inside = *instant.model.problem->substructures[static_cast<size_t>(part)]->mesh->inside;
  for (int node = 0; node < force.cols(); ++node)
    if (inside.is_place(node)) group.load += force.col(node);
  for (const auto& [node, held] : instant.model.conditions.held[part])
    for (int j = 0; j < held.n; ++j)
      if (held.is_held(j)) group.held += held.directions.col(j) * held.directions.col(j).transpose();
}

// Without what goes along held directions.
Vec3 free_part(const Group& group, Vec3 force) {
  const PrincipalAxes held = principal_axes(group.held);
  for (int d = 0; d < 3; ++d)
    if (held.values[d] > 1e-9) force -= held.vectors.col(d).dot(force) * held.vectors.col(d);
  return force;
}

// What joints on one plane hold across it is what presses them together: an iteration that has failed knows it roughly.
double correction(const Group& group) {
  const Vec3 normal = group.joints.front().normal;
  double pressed = 0.0, all = 0.0;
  for (const LimitJoint& joint : group.joints) {
    if (std::abs(joint.normal.dot(normal)) < 0.99) return 1.0;
    pressed += joint.force.dot(normal);
    all += std::abs(joint.force.dot(normal));
  }
  const double load = group.load.dot(normal);
  return std::abs(load) > 0.1 * all && load * pressed < 0.0 ? -load / pressed : 1.0;
}

std::string names_of(const Instant& instant, const Group& group) {
  std::string names;
  for (size_t i = 0; i < group.parts.size() && i < 4; ++i)
    names += fmt::format("{}'{}'", i ? ", " : "", instant.model.problem->substructures[group.parts[i]]->name);
  return names + (group.parts.size() > 4 ? fmt::format(" and {} more", group.parts.size() - 4) : "");
}

// Without minus zeros.
Vec3 as_told(Vec3 direction) {
  for (int d = 0; d < 3; ++d)
    if (std::abs(direction[d]) < 0.005) direction[d] = 0.0;
  return direction;
}

std::string line_of(const Instant& instant, const Group& group, const Vec3& pull, const Vec3& missing, bool is_proven) {
  const Vec3 along = as_told(missing.normalized());
  const double factor = correction(group);
  std::string joints;
  double hold = 0.0;
  for (const LimitJoint& joint : group.joints) {
    const double own = -factor * joint.force.dot(along);
    hold += own;
    joints += fmt::format("{}'{}' {}", joints.empty() ? "" : ", ", joint.surface->name(),
                          joint.is_released ? "is released"
                          : joint.is_open   ? "is open"
                                            : fmt::format("{} at {:.0f} N", joint.yields ? "yields" : "slides", own));
  }
  const bool is_open =
      std::all_of(group.joints.begin(), group.joints.end(), [](const LimitJoint& joint) { return joint.is_open; });
  return fmt::format(
      "static step '{}', increment {}: {} {} as a whole: {:.0f} N act along ({:.2f}, {:.2f}, {:.2f}), and joints "
      "resist about {:.0f} N of it ({}); {}: less load, more preload or friction, a stop, or a dynamic step",
      instant.model.step->name, instant.increment + 1, names_of(instant, group), is_open ? "comes off" : "slides",
      pull.dot(along), along[0], along[1], along[2], hold, joints,
      is_proven ? "there is no equilibrium"
      : is_open ? "no equilibrium was found; a gap may still close, or the deficit may be larger than it appears"
                : "no equilibrium was found; these figures are from an iteration that has not converged");
}

// What no contact force can balance, where the joints do not show it.
std::string line_of(const Instant& instant, const RigidImbalance& imbalance) {
  std::string parts, joints;
  for (size_t i = 0; i < imbalance.parts.size() && i < 4; ++i)
    parts += fmt::format("{}'{}'", i ? ", " : "", instant.model.problem->substructures[imbalance.parts[i]]->name);
  if (imbalance.parts.size() > 4) parts += fmt::format(" and {} more", imbalance.parts.size() - 4);
  for (const std::string& joint : imbalance.joints) joints += fmt::format("{}'{}'", joints.empty() ? "" : ", ", joint);
  const Vec3 along = as_told(imbalance.along);
  const std::string at =
      joints.empty() ? "no contact resists this"
                     : fmt::format("no forces at the {} points of {} can balance them", imbalance.n_points, joints);
  return fmt::format(
      "static step '{}', increment {}: the loads {} {} {} ({:.2f}, {:.2f}, {:.2f}), and {}: there is no equilibrium{}",
      instant.model.step->name, instant.increment + 1, imbalance.turns ? "tip" : "move", parts,
      imbalance.turns ? "about" : "along", along[0], along[1], along[2], at,
      imbalance.turns
          ? "; add a support or a stop, or use smaller cells if the contact points do not span the touching faces"
          : "; add a support, a stop or friction");
}

}  // namespace

std::vector<std::string> overloaded_joints(const Instant& instant) {
  const Problem& problem = *instant.model.problem;
  const int n = static_cast<int>(problem.substructures.size()), ground = n;
  const auto other = [&](const Surface& surface) {
    return surface.part_2 >= 0 ? surface.part_2 : surface.is_on_ground ? ground : surface.part_1;
  };
  Groups groups(n + 1);
  std::vector<LimitJoint> limits;
  for (size_t s = 0; s < instant.model.surfaces->size(); ++s) {
    const Surface& surface = (*instant.model.surfaces)[s];
    if (!takes_part(problem, *instant.model.step, surface)) continue;
    if (instant.state.released[s])
      limits.push_back({.surface = &surface, .is_released = true});
    else if (const auto joint = at_limit(surface, instant.surface(s)))
      limits.push_back(*joint);
    else
      groups.join(surface.part_1, other(surface));
  }
  std::vector<Group> all(n + 1);
  for (int part = 0; part < n; ++part) add_part(instant, part, all[groups.of(part)]);
  all[groups.of(ground)].is_grounded = true;
  for (const LimitJoint& joint : limits) {
    const int a = groups.of(joint.surface->part_1), b = groups.of(other(*joint.surface));
    if (a == b) continue;
    all[a].joints.push_back(joint);
    all[b].joints.push_back(joint);
    all[b].joints.back().force *= -1.0;
  }
  const std::optional<RigidImbalance> imbalance = rigid_imbalance(instant);
  std::vector<std::string> lines;
  for (Group& group : all) {
    if (group.parts.empty() || group.is_grounded || group.joints.empty()) continue;
    Vec3 joints = Vec3::Zero();
    for (const LimitJoint& joint : group.joints) joints += joint.force;
    for (const LimitJoint& joint : group.joints) group.held += joint.normal * joint.normal.transpose();
    const Vec3 pull = free_part(group, group.load), missing = free_part(group, group.load + joints);
    if (missing.norm() <= balanced * pull.norm() || pull.dot(missing) <= 0.0) continue;
    const bool is_proven =
        imbalance && std::any_of(group.parts.begin(), group.parts.end(), [&](int part) {
          return std::find(imbalance->parts.begin(), imbalance->parts.end(), part) != imbalance->parts.end();
        });
    if (is_proven && imbalance->turns) continue;  // that says more
    lines.push_back(line_of(instant, group, pull, missing, is_proven));
  }
  if (imbalance && (lines.empty() || imbalance->turns)) lines.insert(lines.begin(), line_of(instant, *imbalance));
  return lines;
}

}  // namespace dygita
