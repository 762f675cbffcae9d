#include "watch/rigid_balance.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/union_find.hpp"
#include "exchange/rigid_frame.hpp"
#include "law/law.hpp"
#include "numerics/dense.hpp"
#include "ranks/ranks.hpp"

namespace dygita {

namespace {

using Mat6 = Eigen::Matrix<double, 6, 6>;

// A force that pushes only, as bodies feel it: on one group, and against another (-1: none, the ground).
struct Push {
  int group = -1, against = -1;
  RigidMotion force = RigidMotion::Zero(), back = RigidMotion::Zero();

  double work(const Vec& motion) const {
    double work = 0.0;
    if (group >= 0) work += force.dot(motion.segment<6>(6 * group));
    if (against >= 0) work += back.dot(motion.segment<6>(6 * against));
    return work;
  }
  void add_to(Eigen::Ref<Vec> forces, double amount) const {
    if (group >= 0) forces.segment<6>(6 * group) += amount * force;
    if (against >= 0) forces.segment<6>(6 * against) += amount * back;
  }
};

class RigidBodies {
 public:
  explicit RigidBodies(const Instant& instant)
      : instant_(instant), frame_(extent_of(instant.model.problem->substructures)) {
    find_groups();
    load_ = Vec::Zero(6 * n_groups_);
    for (int part = 0; part < n_parts(); ++part)
      if (group_of_[static_cast<size_t>(part)] >= 0) add_part(part);
    for (size_t i = 0; i < exchange().points.size(); ++i) add_contact(exchange().points[i]);
  }

  int n_groups() const { return n_groups_; }
  const Vec& load() const { return load_; }
  const std::vector<Push>& pushes() const { return pushes_; }
  RigidImbalance describe(const Vec& motion) const;

 private:
  const Problem& problem() const { return *instant_.model.problem; }
  const Exchange& exchange() const { return instant_.model.exchange; }
  int n_parts() const { return static_cast<int>(problem().substructures.size()); }
  bool is_contact(const Point& point) const { return point.law && point.law->shown().gap; }
  bool is_released(const Point& point) const {
    return point.law && instant_.state.released[static_cast<size_t>(point.members.front().surface)] != 0;
  }
  int part_of(int port) const { return exchange().ports[static_cast<size_t>(port)].part; }
  void find_groups();
  void add_part(int part);
  void add_contact(const Point& point);

  const Instant& instant_;
  RigidFrame frame_;           // of the assembly
  std::vector<int> group_of_;  // of each part; -1: it is tied to the ground
  int n_groups_ = 0;
  Vec load_;  // on each group, 6 a group
  std::vector<Push> pushes_;
};

void RigidBodies::find_groups() {
  const int ground = n_parts();
  UnionFind tied(ground + 1);
  for (const Point& point : exchange().points) {
    for (int p = point.first_port + 1; p < point.first_port_2; ++p) tied.join(part_of(p), part_of(point.first_port));
    for (int p = point.first_port_2 + 1; p < point.end_port; ++p) tied.join(part_of(p), part_of(point.first_port_2));
    if (point.law && !is_contact(point) && !is_released(point))
      tied.join(part_of(point.first_port), point.is_wall ? ground : part_of(point.first_port_2));
  }
  std::vector<int> number(static_cast<size_t>(ground) + 1, -1);
  for (int part = 0; part < ground; ++part) {
    const int root = tied.root(part);
    if (root == tied.root(ground)) {
      group_of_.push_back(-1);
      continue;
    }
    int& own = number[static_cast<size_t>(root)];
    if (own < 0) own = n_groups_++;
    group_of_.push_back(own);
  }
}

// Loads, and what supports can answer with either way.
void RigidBodies::add_part(int part) {
  const Substructure& body = *problem().substructures[static_cast<size_t>(part)];
  const int group = group_of_[static_cast<size_t>(part)];
  const Points force = instant_.model.external_force(part, instant_.state);
  for (int node = 0; node < force.cols(); ++node)
    for (int d = 0; d < 3; ++d)
      if (force(d, node) != 0.0) load_.segment<6>(6 * group) += force(d, node) * frame_.row(body, node, Vec3::Unit(d));
  Mat6 held = Mat6::Zero();
  for (const auto& [node, own] : instant_.model.conditions.held[static_cast<size_t>(part)])
    for (int j = 0; j < own.n; ++j)
      if (own.is_held(j) || !body.mesh->has_cells()) {
        const RigidMotion row = frame_.row(body, node, own.directions.col(j));
        held += row * row.transpose();
      }
  const auto resisted = frame_.resisted(body);
  held += resisted * resisted.transpose();
  const EigenPairs axes = symmetric_eigen(held);
  for (int k = 0; k < 6; ++k)
    if (axes.values[k] > 1e-9 * axes.values[5])
      for (const double sign : {1.0, -1.0})
        pushes_.push_back({group, -1, sign * axes.vectors.col(k), RigidMotion::Zero()});
}

// Edges of a pyramid around the cone of friction.
void RigidBodies::add_contact(const Point& point) {
  constexpr int n_edges = 8;
  if (!is_contact(point) || is_released(point)) return;
  const int against = group_of_[static_cast<size_t>(part_of(point.first_port))];
  const int group = point.is_wall ? -1 : group_of_[static_cast<size_t>(part_of(point.first_port_2))];
  if (group == against) return;
  const double mu = friction_of(*point.law) / std::cos(M_PI / n_edges);
  const auto felt = [&](int p, const Vec3& force) {
    const Port& port = exchange().ports[static_cast<size_t>(p)];
    return frame_.row(*problem().substructures[static_cast<size_t>(port.part)], port, force);
  };
  for (int edge = 0; edge < (mu > 0.0 ? n_edges : 1); ++edge) {
    const double angle = 2.0 * M_PI * edge / n_edges;
    const Vec3 push = point.frame * Vec3(1.0, mu * std::cos(angle), mu * std::sin(angle));
    Push own{group, against, RigidMotion::Zero(), felt(point.first_port, -push)};
    if (group >= 0) own.force = felt(point.first_port_2, push);
    pushes_.push_back(own);
  }
}

RigidImbalance RigidBodies::describe(const Vec& motion) const {
  int worst = 0;
  for (int i = 1; i < n_groups_; ++i)
    if (motion.segment<6>(6 * i).norm() > motion.segment<6>(6 * worst).norm()) worst = i;
  RigidImbalance found;
  std::vector<SubstructurePtr> bodies;
  for (int part = 0; part < n_parts(); ++part)
    if (group_of_[static_cast<size_t>(part)] == worst) {
      found.parts.push_back(part);
      bodies.push_back(problem().substructures[static_cast<size_t>(part)]);
    }
  const RigidFrame own(extent_of(bodies));
  const RigidMotion moves = motion.segment<6>(6 * worst);
  const Vec3 middle = frame_.displacement(moves, own.centre), turn = 0.5 * own.size / frame_.size * moves.tail<3>();
  found.turns = turn.norm() > middle.norm();
  found.along = (found.turns ? turn : middle).normalized();
  std::set<std::string> joints;
  for (const Point& point : exchange().points) {
    if (!is_contact(point) || is_released(point)) continue;
    if (group_of_[static_cast<size_t>(part_of(point.first_port))] != worst &&
        (point.is_wall || group_of_[static_cast<size_t>(part_of(point.first_port_2))] != worst))
      continue;
    ++found.n_points;
    for (const Member& member : point.members)
      joints.insert((*instant_.model.surfaces)[static_cast<size_t>(member.surface)].name());
  }
  found.joints.assign(joints.begin(), joints.end());
  return found;
}

// What the pushes cannot balance of a load, in the least squares (C. L. Lawson, R. J. Hanson,
// Solving Least Squares Problems, 1974): by that motion the load works, and every
// push works with it or not at all. Empty where the rounds have not come to that.
std::optional<Vec> unbalanced(const Vec& load, const std::vector<Push>& pushes) {
  constexpr double rounding = 1e-9;
  std::vector<size_t> taken;
  Vec amount, left = load;
  const auto columns = [&] {
    Mat all = Mat::Zero(load.size(), static_cast<Eigen::Index>(taken.size()));
    for (size_t i = 0; i < taken.size(); ++i) pushes[taken[i]].add_to(all.col(static_cast<Eigen::Index>(i)), 1.0);
    return all;
  };
  for (Eigen::Index round = 0; round < 10 * load.size() + 100; ++round) {
    size_t best = pushes.size();
    double most = rounding * load.norm();
    for (size_t j = 0; j < pushes.size(); ++j)
      if (const double gain = -pushes[j].work(left);
          gain > most && std::find(taken.begin(), taken.end(), j) == taken.end()) {
        most = gain;
        best = j;
      }
    if (best == pushes.size()) return left;
    taken.push_back(best);
    amount.conservativeResize(amount.size() + 1);
    amount[amount.size() - 1] = 0.0;
    while (!taken.empty()) {
      const Vec to = solve_least_norm(columns(), -load, 1e-12).x;
      double share = 1.0;
      for (Eigen::Index i = 0; i < to.size(); ++i)
        if (to[i] <= 0.0 && amount[i] > to[i]) share = std::min(share, amount[i] / (amount[i] - to[i]));
      amount += share * (to - amount);
      if (share >= 1.0) break;
      std::vector<size_t> kept;
      std::vector<double> amounts;
      for (size_t i = 0; i < taken.size(); ++i)
        if (const double own = amount[static_cast<Eigen::Index>(i)]; own > 1e-14 * amount.maxCoeff()) {
          kept.push_back(taken[i]);
          amounts.push_back(own);
        }
      if (kept.size() == taken.size()) break;
      taken = kept;
      amount = Eigen::Map<const Vec>(amounts.data(), static_cast<Eigen::Index>(amounts.size()));
    }
    left = load;
    for (size_t i = 0; i < taken.size(); ++i) pushes[taken[i]].add_to(left, amount[static_cast<Eigen::Index>(i)]);
    if (left.norm() <= rounding * load.norm()) return left;
  }
  return std::nullopt;
}

}  // namespace

std::optional<RigidImbalance> rigid_imbalance(const Instant& instant) {
  constexpr int most_groups = 20;
  constexpr double balanced = 1e-6;  // of the load
  if (!ranks::is_alone()) return std::nullopt;
  const RigidBodies bodies(instant);
  if (bodies.n_groups() == 0 || bodies.n_groups() > most_groups || bodies.load().isZero(0.0)) return std::nullopt;
  const std::optional<Vec> left = unbalanced(bodies.load(), bodies.pushes());
  if (!left || left->norm() <= balanced * bodies.load().norm()) return std::nullopt;
  for (const Push& push : bodies.pushes())
    if (push.work(*left) < -balanced * left->norm()) return std::nullopt;
  return bodies.describe(*left);
}

}  // namespace dygita
