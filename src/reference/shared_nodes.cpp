#include "reference/shared_nodes.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <map>

#include "base/union_find.hpp"
#include "numerics/dense.hpp"

namespace dygita {

namespace {

double motion_velocity(const Held& held, int j, const std::vector<double>& motions) {
  double velocity = 0.0;
  for (const auto& [motion, factor] : held.motion[j]) velocity += factor * motions[motion];
  return velocity;
}

// Adds direction . v = motions to what is held, orthogonalised; in the span of the others it is theirs.
void add_held(const Vec3& direction, const std::vector<std::pair<int, double>>& motion, const Support* support,
              Held& held) {
  Vec3 rest = direction;
  std::map<int, double> sum(motion.begin(), motion.end());
  for (int j = 0; j < held.n; ++j) {
    const double along = held.directions.col(j).dot(direction);
    rest -= along * held.directions.col(j);
    for (const auto& [m, factor] : held.motion[j]) sum[m] -= along * factor;
  }
  const double length = rest.norm();
  if (length < 1e-6) return;
  held.directions.col(held.n) = rest / length;
  held.support[held.n] = support;
  for (const auto& [m, factor] : sum)
    if (factor != 0.0) held.motion[held.n].emplace_back(m, factor / length);
  ++held.n;
}

}  // namespace

SharedNodes::SharedNodes(const StepModel& model, const std::vector<char>& is_tied, const InternalForce& internal)
    : group_of_node_(internal.n_dofs() / 3, -1), moved_mass_(internal.n_dofs()) {
  for (int part = 0; part < internal.n_parts(); ++part)
    for (int dof = internal.first(part); dof < internal.first(part + 1); ++dof)
      moved_mass_[dof] = model.pieces[part]->node_masses()[(dof - internal.first(part)) / 3];
  collect(model, is_tied, internal);
  for (Group& group : groups_) {
    hold(model, group);
    make_split(model, group);
    for (const Copy& copy : group.copies) moved_mass_.segment<3>(copy.dof).setConstant(group.mass);
  }
}

// Calls back with every tie: surface, its point, and the two nodes counted through all substructures.
template <class Visit>
void SharedNodes::for_each_tie(const StepModel& model, const std::vector<char>& is_tied, const InternalForce& internal,
                               Visit&& visit) {
  for (size_t s = 0; s < model.surfaces->size(); ++s) {
    const Surface& surface = (*model.surfaces)[s];
    for (int i = 0; is_tied[s] && i < surface.n_points(); ++i)
      visit(static_cast<int>(s), i, internal.first(surface.part_1) / 3 + surface.facing.side_1.main_node(i),
            internal.first(surface.part_2) / 3 + surface.facing.side_2.main_node(i));
  }
}

// Groups of nodes tied to each other; those alone count where they are held or absorb.
void SharedNodes::collect(const StepModel& model, const std::vector<char>& is_tied, const InternalForce& internal) {
  const int n_nodes = internal.n_dofs() / 3;
  UnionFind sets(n_nodes);
  std::vector<char> is_shared(static_cast<size_t>(n_nodes), 0);
  for_each_tie(model, is_tied, internal, [&](int, int, int a, int b) {
    is_shared[a] = is_shared[b] = 1;
    sets.join(a, b);
  });
  for (int part = 0; part < internal.n_parts(); ++part) {
    const int first = internal.first(part) / 3;
    for (const auto& [node, held] : model.conditions.held[part])
      if (held.n > 0) is_shared[first + node] = 1;
    for (const auto& [node, impedance] : assembled_piece(model, part).op().absorbing()) is_shared[first + node] = 1;
  }
  std::vector<int> group_of(static_cast<size_t>(n_nodes), -1), copy_of(static_cast<size_t>(n_nodes), -1);
  for (int part = 0; part < internal.n_parts(); ++part) {
    const PieceOperator& piece = assembled_piece(model, part).op();
    auto absorbing = piece.absorbing().begin();  // by node
    for (int global = internal.first(part) / 3; global < internal.first(part + 1) / 3; ++global) {
      if (!is_shared[global]) continue;
      int& group = group_of[sets.root(global)];
      if (group < 0) {
        group = static_cast<int>(groups_.size());
        groups_.emplace_back();
      }
      const int node = global - internal.first(part) / 3;
      Copy copy{part, node, 3 * global, model.pieces[part]->node_masses()[node]};
      if (absorbing != piece.absorbing().end() && absorbing->first == node) copy.impedance = (absorbing++)->second;
      group_of_node_[global] = group;
      copy_of[global] = static_cast<int>(groups_[group].copies.size());
      add_copy(copy, groups_[group]);
    }
  }
  for_each_tie(model, is_tied, internal, [&](int s, int i, int a, int b) {
    const double area = (*model.surfaces)[s].facing.areas[i];
    groups_[group_of[sets.root(a)]].edges.push_back({s, i, copy_of[a], copy_of[b], std::sqrt(area)});
  });
}

void SharedNodes::add_copy(const Copy& copy, Group& group) {
  group.mass += copy.mass;
  group.impedance += copy.impedance;
  group.absorbs |= !copy.impedance.isZero(0.0);
  group.copies.push_back(copy);
}

void SharedNodes::hold(const StepModel& model, Group& group) const {
  for (const Copy& copy : group.copies) {
    const Held* held = model.conditions.at(copy.part, copy.node);
    for (int j = 0; held && j < held->n; ++j)
      add_held(held->directions.col(j), held->motion[j], held->support[j], group.held);
  }
  for (int j = 0; j < group.held.n; ++j) group.is_moved |= !group.held.motion[j].empty();
}

// Tie forces balance every copy in its free directions; where they are not unique the least, weighted with areas.
void SharedNodes::make_split(const StepModel& model, Group& group) {
  int n_rows = 0;
  for (const Copy& copy : group.copies) {
    const Held* held = model.conditions.at(copy.part, copy.node);
    group.free.push_back(held ? Mat(held->free_basis()) : Mat(Mat3::Identity()));
    n_rows += static_cast<int>(group.free.back().cols());
  }
  const int n_edges = static_cast<int>(group.edges.size());
  if (n_edges == 0) return;
  Mat balance = Mat::Zero(n_rows, 3 * n_edges);
  for (int e = 0; e < n_edges; ++e) {
    int row = 0;
    for (size_t c = 0; c < group.copies.size(); ++c) {
      const Edge& edge = group.edges[e];
      const double sign = (edge.copy_1 == static_cast<int>(c)) - (edge.copy_2 == static_cast<int>(c));
      const Mat& free = group.free[c];
      balance.block(row, 3 * e, free.cols(), 3) = sign * edge.root_area * free.transpose();
      row += static_cast<int>(free.cols());
    }
  }
  group.split = pseudo_inverse(balance);
}

void SharedNodes::average(Vec& field) const {
  for (const Group& group : groups_) {
    Vec3 mean = Vec3::Zero();
    for (const Copy& copy : group.copies) mean += copy.mass / group.mass * field.segment<3>(copy.dof);
    for (const Copy& copy : group.copies) field.segment<3>(copy.dof) = mean;
  }
}

Vec3 SharedNodes::force_on(const Group& group, const Kick& kick, const Vec& internal) {
  Vec3 force = Vec3::Zero();
  for (const Copy& copy : group.copies) force += kick.external.segment<3>(copy.dof) - internal.segment<3>(copy.dof);
  return force;
}

// As if nothing held the group.
Vec3 SharedNodes::free_velocity(const Group& group, const Kick& kick, const Vec3& force, const Vec3& before) {
  if (!group.absorbs) return before + kick.tau / group.mass * force;
  const Mat3 inertia = group.mass / kick.tau * Mat3::Identity();
  const Vec3 rest = (inertia - (1 - kick.theta) * group.impedance) * before + force;
  return (inertia + kick.theta * group.impedance).inverse() * rest;
}

Vec3 SharedNodes::as_held(const Group& group, const Kick& kick, const Vec3& free) {
  Vec3 velocity = free;
  for (int j = 0; j < group.held.n; ++j) {
    const Vec3 d = group.held.directions.col(j);
    velocity += (motion_velocity(group.held, j, kick.motions) - d.dot(free)) * d;
  }
  return velocity;
}

Vec3 SharedNodes::velocity_after(int group, const Kick& kick, const Vec& internal, const Vec& velocity) const {
  const Group& g = groups_[group];
  const Vec3 before = velocity.segment<3>(g.copies.front().dof);
  return as_held(g, kick, free_velocity(g, kick, force_on(g, kick, internal), before));
}

Mat3 SharedNodes::mobility(int group, const Kick& kick) const {
  const Group& g = groups_[group];
  const Mat3 inertia = g.mass / kick.tau * Mat3::Identity() + kick.theta * g.impedance;
  const auto held = g.held.directions.leftCols(g.held.n);
  return (Mat3::Identity() - held * held.transpose()) * inertia.inverse();
}

void SharedNodes::kick(const Kick& kick, const Vec& internal, Vec& velocity) {
  for (Group& group : groups_) {
    for (Copy& copy : group.copies)
      copy.impulse += kick.tau * (kick.external.segment<3>(copy.dof) - internal.segment<3>(copy.dof));
    const Vec3 before = velocity.segment<3>(group.copies.front().dof);
    const Vec3 free = free_velocity(group, kick, force_on(group, kick, internal), before),
               after = as_held(group, kick, free);
    if (group.is_moved) motion_work_ += group.mass * (after - free).dot(0.5 * (before + after));
    if (group.absorbs) {
      const Vec3 mean = (1 - kick.theta) * before + kick.theta * after;
      for (Copy& copy : group.copies) copy.drag -= kick.tau * (copy.impedance * mean);
      absorbed_work_ += kick.tau * mean.dot(group.impedance * mean);
    }
    for (const Copy& copy : group.copies) velocity.segment<3>(copy.dof) = after;
  }
}

void SharedNodes::restrict_force(Vec& force) const {
  for (const Group& group : groups_) {
    Vec3 sum = Vec3::Zero();
    for (const Copy& copy : group.copies) sum += force.segment<3>(copy.dof);
    for (int j = 0; j < group.held.n; ++j) sum -= group.held.directions.col(j).dot(sum) * group.held.directions.col(j);
    for (const Copy& copy : group.copies) force.segment<3>(copy.dof) = sum;
  }
}

void SharedNodes::end_increment(const Vec& velocity_old, const Vec& velocity, double dt, State& state) {
  for (Group& group : groups_) split_forces(group, velocity_old, velocity, dt, state);
}

void SharedNodes::split_forces(Group& group, const Vec& velocity_old, const Vec& velocity, double dt, State& state) {
  std::vector<Vec3> felt;  // from ties and supports
  Vec free(group.split.cols());
  int row = 0;
  for (size_t c = 0; c < group.copies.size(); ++c) {
    Copy& copy = group.copies[c];
    const Vec3 gained = copy.mass * (velocity.segment<3>(copy.dof) - velocity_old.segment<3>(copy.dof));
    felt.push_back((gained - copy.impulse - copy.drag) / dt);
    copy.absorbing = copy.drag / dt;
    copy.impulse.setZero();
    copy.drag.setZero();
    if (group.edges.empty()) continue;
    free.segment(row, group.free[c].cols()) = group.free[c].transpose() * felt.back();
    row += static_cast<int>(group.free[c].cols());
  }
  if (!group.edges.empty()) {
    const Vec weighted = group.split * free;
    for (size_t e = 0; e < group.edges.size(); ++e) {
      const Edge& edge = group.edges[e];
      const Vec3 force = edge.root_area * weighted.segment<3>(3 * e);
      felt[edge.copy_1] -= force;
      felt[edge.copy_2] += force;
      LawState& shown = state.surfaces[edge.surface].points[edge.point];
      shown.force = force;
      shown.status = PointState::stick;
    }
  }
  for (size_t c = 0; c < group.copies.size(); ++c) group.copies[c].reaction = felt[c];
}

void SharedNodes::add_reactions(int part, Points& force) const {
  for (const Group& group : groups_)
    for (const Copy& copy : group.copies)
      if (copy.part == part) force.col(copy.node) += copy.reaction;
}

void SharedNodes::add_absorbing(int part, Points& force) const {
  for (const Group& group : groups_)
    for (const Copy& copy : group.copies)
      if (copy.part == part) force.col(copy.node) += copy.absorbing;
}

double SharedNodes::bytes() const {
  double sum = 8.0 * static_cast<double>(moved_mass_.size());
  for (const Group& group : groups_)
    sum += static_cast<double>(sizeof(Group) + group.copies.size() * sizeof(Copy) + group.edges.size() * sizeof(Edge)) +
           8.0 * static_cast<double>(group.split.size());
  return sum;
}

}  // namespace dygita
