#include "interfaces/conditions.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/fnv1a.hpp"
#include "base/log.hpp"
#include "base/overloaded.hpp"
#include "meeting/facing.hpp"

namespace dygita {

Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> Held::free_basis() const {
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> basis(3, 3 - n);
  int found = 0;
  Mat3 all = directions;
  // Complete with the axes that stand out most from what is there.
  for (int i = n; i < 3; ++i) {
    Vec3 best = Vec3::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 e = Vec3::Unit(axis);
      for (int j = 0; j < i; ++j) e -= all.col(j).dot(e) * all.col(j);
      if (e.norm() > best.norm() + 1e-9) best = e;
    }
    all.col(i) = best.normalized();
    basis.col(found++) = all.col(i);
  }
  return basis;
}

const Held* Conditions::at(int part, int node) const {
  const auto it = held[part].find(node);
  return it == held[part].end() ? nullptr : &it->second;
}

double LoadValue::at_static(int i, int n) const {
  if (i < 0) return from;
  const double s = static_cast<double>(i + 1) / n;
  return is_number ? from + s * (history.value(1.0) - from) : history.value(s);
}

namespace {

std::vector<int> nodes_on(const FaceOrRegion& on) {
  if (const auto* face = std::get_if<Face>(&on)) return nodes_of(face->facets());
  return std::get<Region>(on).nodes;
}

int part_on(const Problem& problem, const FaceOrRegion& on) {
  return std::visit([&](const auto& o) { return index_of(problem.substructures, o.part.get()); }, on);
}

}  // namespace

std::string motion_key(const std::string& value, const FaceOrRegion& on) {
  std::vector<int> nodes = nodes_on(on);
  std::sort(nodes.begin(), nodes.end());
  Fnv1a digest;
  digest.add(nodes.size());
  for (const int node : nodes) digest.add(node);
  return value + " " + std::visit([](const auto& o) { return o.part->name; }, on) + " " + digest.hexadecimal();
}

std::string force_key(const std::string& value, const FaceOrRegion& on) {
  return motion_key(value, on) + (std::holds_alternative<Face>(on) ? " face" : " region");
}

std::vector<std::vector<int>> prescribed_nodes(const Problem& problem, const Step& step) {
  std::vector<std::vector<int>> all(problem.substructures.size());
  for (const LoadPtr& load : step.loads)
    for (const Effect& effect : load->effects()) {
      const auto* motion = std::get_if<PrescribedMotion>(&effect);
      if (!motion || motion->is_velocity || !step.is_static) continue;
      const std::vector<int> nodes = nodes_on(motion->on);
      std::vector<int>& of_part = all[static_cast<size_t>(part_on(problem, motion->on))];
      of_part.insert(of_part.end(), nodes.begin(), nodes.end());
    }
  for (std::vector<int>& nodes : all) {
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }
  return all;
}

namespace {

class ConditionsBuilder {
 public:
  ConditionsBuilder(const Problem& problem, const Step& step, const State& start, const NodeMotions& moved)
      : problem_(problem), step_(step), start_(start), moved_(moved) {
    result_.held.resize(problem.substructures.size());
  }

  Conditions build() {
    for (size_t part = 0; part < problem_.substructures.size(); ++part)
      for (const auto& [node, direction] : problem_.substructures[part]->mesh->inside->held)
        hold(static_cast<int>(part), node, direction, {}, nullptr, "", {});
    for (const SupportPtr& support : supports_of(problem_, step_)) add_support(*support);
    for (const LoadPtr& load : step_.loads)
      for (const Effect& effect : load->effects())
        std::visit(overloaded{[&](const PrescribedMotion& motion) { add_motion(motion, *load); },
                              Ignored<NodalForces, BodyForce, BaseMotion, Shortening, PreloadForce, Release>()},
                   effect);
    return std::move(result_);
  }

 private:
  void add_support(const Support& support) {
    const Directions held = support.kind->holds(step_.is_static);
    if (held == Directions::none) return;
    const std::vector<std::pair<Vec3, int>> moves = base_motions(support);
    for (const FaceOrRegion& on : support.on) {
      if (held.along_normals) hold_normals(support, std::get<Face>(on), moves);
      if (held.axes != Directions::none.axes) hold_axes(support, on, held.axes, moves);
    }
  }

  void hold_axes(const Support& support, const FaceOrRegion& on, const std::array<bool, 3>& axes,
                 const std::vector<std::pair<Vec3, int>>& moves) {
    for (const int node : nodes_on(on)) {
      const int moving = hold_turn(part_of(on), node, &support);
      if (moving != node && axes != Directions::all.axes) refuse_rigid_face(support, "along some axes");
      for (int axis = 0; axis < 3; ++axis)
        if (axes[static_cast<size_t>(axis)])
          hold(part_of(on), moving, Vec3::Unit(axis), moves, &support, support.name, support.origin);
    }
  }

  [[noreturn]] static void refuse_rigid_face(const Support& support, const std::string& how) {
    throw InputError(support.origin,
                     "support." + support.kind->word() + " '" + support.name + "' holds " + how +
                         ", but a superelement moves this face as a whole\n    take support.fixed, or condense the "
                         "body with motion = \"nodes\"");
  }

  // A node of a rigid face is held at the face's point, and the face then does not turn. Answers the node that moves.
  int hold_turn(int part, int node, const Support* support) {
    const Interior::Follower* own = problem_.substructures[static_cast<size_t>(part)]->mesh->inside->follower(node);
    if (!own) return node;
    for (int axis = 0; axis < 3 && own->turn >= 0; ++axis) hold(part, own->turn, Vec3::Unit(axis), {}, support, "", {});
    return own->point;
  }

  static void check_whole(const PrescribedMotion& prescribed, const Load& load) {
    if (std::all_of(prescribed.along.begin(), prescribed.along.end(), [](const auto& own) { return own.has_value(); }))
      return;
    throw InputError(load.origin, load.path +
                                      " on a face that a superelement has as a whole must give all three components x, "
                                      "y and z, 0 for no motion\n    or condense the body with motion = \"nodes\"");
  }

  // Where planes of one face meet at an edge, along the normal of each.
  void hold_normals(const Support& support, const Face& face, const std::vector<std::pair<Vec3, int>>& moves) {
    const Mesh& mesh = *face.part->mesh;
    for (const PlacedFace& part : smooth_parts({&mesh, face.facets(), Vec3::Zero(), ""})) {
      const FaceNodes on_patch = face_nodes(mesh, part.facets);
      if (mesh.inside->follower(on_patch.nodes.front())) refuse_rigid_face(support, "along normals");
      for (size_t i = 0; i < on_patch.nodes.size(); ++i)
        hold(part_of(face), on_patch.nodes[i], on_patch.normals.col(i), moves, &support, support.name, support.origin);
    }
  }

  // Motion of an accelerated support: absolute velocity = what it has + integral of a.
  std::vector<std::pair<Vec3, int>> base_motions(const Support& support) {
    std::vector<std::pair<Vec3, int>> moves;
    if (step_.is_static) return moves;
    if (const auto it = start_.base_velocity.find(&support); it != start_.base_velocity.end()) {
      const double speed = it->second.norm();
      if (speed > 0.0)
        moves.emplace_back(it->second / speed,
                           add({[speed](int, double) { return speed; }, [speed](double) { return speed; }}));
    }
    for (const LoadPtr& load : step_.loads)
      for (const Effect& effect : load->effects())
        std::visit(overloaded{[&](const BaseMotion& base) {
                                if (base.on.get() != &support) return;
                                const auto gained = std::make_shared<RunningIntegral>(base.acceleration);
                                moves.emplace_back(
                                    base.direction,
                                    add({[gained](int i, double dt) { return gained->over(i + 1, dt); }}));
                              },
                              Ignored<NodalForces, BodyForce, PrescribedMotion, Shortening, PreloadForce, Release>()},
                   effect);
    return moves;
  }

  void add_motion(const PrescribedMotion& prescribed, const Load& load) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!prescribed.along[axis]) continue;
      const double from = reached(prescribed, axis);
      const int motion = add(motion_of(prescribed, load, axis, from));
      int ramp = -1;
      std::set<int> moving;  // nodes of a rigid face move as one
      for (const int node : nodes_on(prescribed.on)) {
        const int own = hold_turn(part_of(prescribed.on), node, nullptr);
        if (own != node) check_whole(prescribed, load);
        if (!moving.insert(own).second) continue;
        std::vector<std::pair<Vec3, int>> moves = {{Vec3::Unit(axis), motion}};
        if (const double away = from - moved(part_of(prescribed.on), node)[axis];
            std::abs(away) > 1e-9 * std::abs(from) && step_.is_static && !prescribed.is_velocity) {
          if (ramp < 0) ramp = add({[n = step_.n_increments()](int, double) { return 1.0 / n; }});
          moves.emplace_back(away * Vec3::Unit(axis), ramp);
        }
        hold(part_of(prescribed.on), own, Vec3::Unit(axis), moves, nullptr, load.path, load.origin);
      }
    }
  }

  // What the same load has brought these nodes to, m.
  double reached(const PrescribedMotion& prescribed, int axis) const {
    const auto found = start_.reached.find(motion_key(prescribed.name_along(axis), prescribed.on));
    return found == start_.reached.end() ? 0.0 : found->second;
  }

  // Where a node is when a static step begins that prescribes its displacement, m: not where the same load would have
  // it where another has moved it.
  Vec3 moved(int part, int node) const {
    if (moved_.empty()) return Vec3::Zero();
    const auto found = moved_[static_cast<size_t>(part)].find(node);
    return found == moved_[static_cast<size_t>(part)].end() ? Vec3(Vec3::Zero()) : found->second;
  }

  Motion motion_of(const PrescribedMotion& prescribed, const Load& load, int axis, double from) const {
    const LoadValue value{*prescribed.along[axis], from};
    const int n = step_.n_increments();
    if (step_.is_static) {
      if (prescribed.is_velocity)
        throw InputError(load.origin, load.path + " is not allowed in static step '" + step_.name +
                                          "': a static step has no time; use load.displacement");
      return {[value, n](int i, double) { return value.at_static(i, n) - value.at_static(i - 1, n); }};
    }
    if (prescribed.is_velocity)
      return {[value](int i, double dt) { return value.history.value(dt * (i + 1)); },
              [value](double) { return value.history.value(0.0); }, true};
    const double start = value.history.value(0.0);
    if (std::abs(start - value.from) > 1e-9 + 1e-6 * std::abs(start))
      warn(
          fmt::format("{}{} in dynamic step '{}' starts at {:.6g} m but {:.6g} m has been reached: only its changes in "
                      "the step are applied; start the history there, or move it there in a static step",
                      load.origin.prefix(), load.path, step_.name, start, value.from));
    // U is then the two-point mean of the prescribed displacement and nothing alternates (manual, eq. S5a).
    return {[value](int i, double dt) {
              return (value.history.value(dt * (i + 1.5)) - value.history.value(dt * (i + 0.5))) / dt;
            },
            [value](double dt) { return (value.history.value(0.5 * dt) - value.history.value(0.0)) / (0.5 * dt); },
            true};
  }

  int add(Motion motion) {
    result_.motions.push_back(std::move(motion));
    return static_cast<int>(result_.motions.size()) - 1;
  }

  // Adds direction . u = sum of motions to a node, orthogonalised against what it has.
  void hold(int part, int node, const Vec3& direction, const std::vector<std::pair<Vec3, int>>& moves,
            const Support* support, const std::string& name, const Origin& origin) {
    Held& held = result_.held[part][node];
    if (support && support->kind->absorbs()) held.is_absorbed = true;
    Vec3 rest = direction;
    std::vector<std::pair<int, double>> motion;
    for (const auto& [along, index] : moves)
      if (const double factor = along.dot(direction); std::abs(factor) > 1e-12) motion.emplace_back(index, factor);
    for (int j = 0; j < held.n; ++j) {
      const double projection = held.directions.col(j).dot(direction);
      rest -= projection * held.directions.col(j);
      for (const auto& [index, factor] : held.motion[j]) motion.emplace_back(index, -projection * factor);
    }
    if (held.n == 3 || rest.norm() < 1e-6) {
      if (support && !motion.empty()) moves_alike(std::move(motion), held, *support, part, node, direction);
      if (!moves.empty() && !support) refuse_second_motion(held, part, node, direction, name, origin);
      return;
    }
    for (auto& [index, factor] : motion) factor /= rest.norm();
    held.directions.col(held.n) = rest.normalized();
    // Nearly along those before, it would share a reaction with them in large forces that cancel.
    held.given.col(held.n) = rest.norm() > 0.1 ? direction : Vec3(rest.normalized());
    held.motion[held.n] = std::move(motion);
    held.support[held.n] = support;
    ++held.n;
  }

  [[noreturn]] void refuse_second_motion(const Held& held, int part, int node, const Vec3& direction,
                                         const std::string& name, const Origin& origin) const {
    std::string by = "another load of step '" + step_.name + "'";
    for (int j = held.n - 1; j >= 0; --j)
      if (held.support[j] && std::abs(held.directions.col(j).dot(direction)) > 1e-6)
        by = "support '" + held.support[j]->name + "'";
    const Substructure& body = *problem_.substructures[static_cast<size_t>(part)];
    const Vec3 at = 1e3 * (body.mesh->nodes.col(node) + body.place);
    throw InputError(
        origin,
        fmt::format("{} moves a node of substructure '{}' at ({:.4g}, {:.4g}, {:.4g}) mm along ({:.3g}, {:.3g}, "
                    "{:.3g}), which {} already holds in that direction\n    leave these nodes out of one of them",
                    name, body.name, at[0], at[1], at[2], direction[0], direction[1], direction[2], by));
  }

  // Throws unless the node has the velocity along a direction that a support asks for, others having given it one.
  void moves_alike(std::vector<std::pair<int, double>> difference, const Held& held, const Support& support, int part,
                   int node, const Vec3& direction) {
    std::sort(difference.begin(), difference.end());
    const auto [known, is_new] = agreed_.try_emplace(difference, true);
    for (int i = 0; i < step_.n_increments() && is_new; ++i) {
      // A normal is known to rounding, and better than the nodes of a mesh file are.
      constexpr double alike = 1e-6;
      double sum = 0.0, size = 0.0;
      for (const auto& [index, factor] : difference) {
        const double v = result_.motions[static_cast<size_t>(index)].velocity(i, step_.dt);
        sum += factor * v;
        size = std::max(size, std::abs(v));
      }
      if (std::abs(sum) > alike * size) known->second = false;
    }
    if (known->second) return;
    std::string other;
    for (int j = 0; j < held.n && other.empty(); ++j)
      if (held.support[j] && std::abs(held.directions.col(j).dot(direction)) > 1e-6) other = held.support[j]->name;
    throw InputError(
        support.origin,
        fmt::format("step '{}': supports '{}' and '{}' both hold node {} of substructure '{}' along ({:.3g}, "
                    "{:.3g}, {:.3g}), and load.base_acceleration prescribes two different motions\n    use one load on "
                    "both, or remove one support from the shared nodes",
                    step_.name, other, support.name, node, problem_.substructures[part]->name, direction[0],
                    direction[1], direction[2]));
  }

  int part_of(const FaceOrRegion& on) const { return part_on(problem_, on); }

  const Problem& problem_;
  const Step& step_;
  const State& start_;
  const NodeMotions& moved_;
  Conditions result_;
  std::map<std::vector<std::pair<int, double>>, bool> agreed_;  // differences of two supports' motions: are they zero?
};

}  // namespace

Conditions make_conditions(const Problem& problem, const Step& step, const State& start, const NodeMotions& moved) {
  return ConditionsBuilder(problem, step, start, moved).build();
}

}  // namespace dygita
