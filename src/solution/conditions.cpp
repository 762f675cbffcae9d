#include "solution/conditions.hpp"

#include <spdlog/fmt/fmt.h>

#include "base/log.hpp"
#include "base/overloaded.hpp"
#include "mesh/facing.hpp"

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

std::string load_key(const std::string& value, const FaceOrRegion& on) {
  if (const auto* face = std::get_if<Face>(&on)) return value + " " + face->label();
  const Region& region = std::get<Region>(on);
  std::string key = value + " " + region.part->name;
  for (const int node : region.nodes) key += " " + std::to_string(node);
  return key;
}

namespace {

class ConditionsBuilder {
 public:
  ConditionsBuilder(const Problem& problem, const Step& step, const State& start)
      : problem_(problem), step_(step), start_(start) {
    result_.held.resize(problem.substructures.size());
  }

  Conditions build() {
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
    for (const FaceOrRegion& on : support.on) switch (held) {
        case Directions::none:
          break;
        case Directions::normal:
          hold_normals(support, std::get<Face>(on), moves);
          break;
        case Directions::all:
          for (const int node : nodes_on(on))
            for (int axis = 0; axis < 3; ++axis)
              hold(part_of(on), node, Vec3::Unit(axis), moves, &support, support.name, support.origin);
          break;
      }
  }

  void hold_normals(const Support& support, const Face& face, const std::vector<std::pair<Vec3, int>>& moves) {
    const FaceNodes on_face = face_nodes(*face.part->mesh, face.facets());
    for (size_t i = 0; i < on_face.nodes.size(); ++i)
      hold(part_of(face), on_face.nodes[i], on_face.normals.col(i), moves, &support, support.name, support.origin);
  }

  // Motion of an accelerated support: absolute velocity = what it has + integral of a.
  std::vector<std::pair<Vec3, int>> base_motions(const Support& support) {
    std::vector<std::pair<Vec3, int>> moves;
    if (step_.is_static) return moves;
    if (const auto it = start_.base_velocity.find(&support); it != start_.base_velocity.end()) {
      const double speed = it->second.norm();
      if (speed > 0.0) moves.emplace_back(it->second / speed, add({[speed](int, double) { return speed; }, speed}));
    }
    for (const LoadPtr& load : step_.loads)
      for (const Effect& effect : load->effects())
        std::visit(overloaded{[&](const BaseMotion& base) {
                                if (base.on.get() != &support) return;
                                const History history = base.acceleration;
                                moves.emplace_back(
                                    base.direction,
                                    add({[history](int i, double dt) { return history.integral(0.0, dt * (i + 1)); }}));
                              },
                              Ignored<NodalForces, BodyForce, PrescribedMotion, Shortening, PreloadForce, Release>()},
                   effect);
    return moves;
  }

  void add_motion(const PrescribedMotion& prescribed, const Load& load) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!prescribed.along[axis]) continue;
      const int motion = add(motion_of(prescribed, load, axis));
      for (const int node : nodes_on(prescribed.on))
        hold(part_of(prescribed.on), node, Vec3::Unit(axis), {{Vec3::Unit(axis), motion}}, nullptr, load.path,
             load.origin);
    }
  }

  Motion motion_of(const PrescribedMotion& prescribed, const Load& load, int axis) const {
    const auto reached = start_.reached.find(load_key(prescribed.name_along(axis), prescribed.on));
    const LoadValue value{*prescribed.along[axis], reached == start_.reached.end() ? 0.0 : reached->second};
    const int n = step_.n_increments();
    if (step_.is_static) {
      if (prescribed.is_velocity)
        throw InputError(load.origin, load.path + " has no meaning in static step '" + step_.name +
                                          "': a static step has no time; use load.displacement");
      return {[value, n](int i, double) { return value.at_static(i, n) - value.at_static(i - 1, n); }};
    }
    if (prescribed.is_velocity)
      return {[value](int i, double dt) { return value.history.value(dt * (i + 1)); }, value.history.value(0.0)};
    const double start = value.history.value(0.0);
    if (std::abs(start - value.from) > 1e-9 + 1e-6 * std::abs(start))
      warn(
          fmt::format("{}{} in dynamic step '{}' starts at {:.6g} m where {:.6g} m has been reached: "
                      "only its changes in the "
                      "step move the nodes; start the history from there, or bring it there in a static step",
                      load.origin.prefix(), load.path, step_.name, start, value.from));
    // U is then the two-point mean of the prescribed displacement and nothing alternates (manual, prescribed
    // displacement).
    const auto mean = [value](double i, double dt) {
      return (value.history.value(dt * (i + 0.5)) - value.history.value(dt * (i - 0.5))) / dt;
    };
    return {[mean](int i, double dt) { return mean(i + 1.0, dt); }, mean(0.5, step_.dt)};
  }

  int add(Motion motion) {
    result_.motions.push_back(std::move(motion));
    return static_cast<int>(result_.motions.size()) - 1;
  }

  // Adds direction . u = sum of motions to a node, orthogonalised against what it has.
  void hold(int part, int node, const Vec3& direction, const std::vector<std::pair<Vec3, int>>& moves,
            const Support* support, const std::string& name, const Origin& origin) {
    Held& held = result_.held[part][node];
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
      if (!moves.empty() && !support)
        throw InputError(
            origin, fmt::format("{} moves node {} of substructure '{}', which is already held in that direction", name,
                                node, problem_.substructures[part]->name));
      return;
    }
    for (auto& [index, factor] : motion) factor /= rest.norm();
    held.directions.col(held.n) = rest.normalized();
    held.motion[held.n] = std::move(motion);
    held.support[held.n] = support;
    ++held.n;
  }

  int part_of(const FaceOrRegion& on) const {
    return std::visit([&](const auto& o) { return index_of(problem_.substructures, o.part.get()); }, on);
  }

  static std::vector<int> nodes_on(const FaceOrRegion& on) {
    if (const auto* face = std::get_if<Face>(&on)) return nodes_of(face->facets());
    return std::get<Region>(on).nodes;
  }

  const Problem& problem_;
  const Step& step_;
  const State& start_;
  Conditions result_;
};

}  // namespace

Conditions make_conditions(const Problem& problem, const Step& step, const State& start) {
  return ConditionsBuilder(problem, step, start).build();
}

}  // namespace dygita
