#include "latin/direct_points.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "law/law.hpp"

namespace dygita {

namespace {

constexpr int most_rounds = 20000;
constexpr int chunk = 256;  // points a thread takes at a time

}  // namespace

DirectPoints::DirectPoints(const StepModel& model, const State& start)
    : model_(&model),
      increment_(increment_of(model.scheme, model.problem->solver.push_out)),
      close_enough_(std::clamp(0.1 * model.problem->solver.tolerance, 1e-13, 1e-10)) {
  for (size_t i = 0; i < model.exchange.points.size(); ++i)
    if (model.exchange.points[i].is_direct) add_point(model, static_cast<int>(i), start);
  find_clusters();
}

void DirectPoints::add_point(const StepModel& model, int index, const State& start) {
  const Point& point = model.exchange.points[index];
  OwnPoint p;
  p.point = &point;
  p.index = index;
  p.record = start_point(model, point, start);
  p.record.trial.shortening = p.record.shortening_old;
  const int first = static_cast<int>(ports_.size()) - point.first_port;
  p.side_1.first = first + point.first_port;
  p.side_1.end = p.side_2.first = first + point.first_port_2;
  p.side_2.end = first + point.end_port;
  for (int i = point.first_port; i < point.end_port; ++i) {
    const Port& port = model.exchange.ports[i];
    OwnPort own;
    own.piece = dynamic_cast<ExplicitPiece*>(model.pieces[port.piece].get());
    CHECK(own.piece, "a direct point has explicit pieces alone");
    own.node = port.piece_node;
    own.index = i;
    own.v_old = own.piece->velocity_of(own.node);
    const Mat3 answer = point.frame.transpose() * own.piece->node_compliance(own.node) * point.frame;
    const double size = answer.diagonal().maxCoeff();
    const Vec3 across = (answer - Mat3(answer.diagonal().asDiagonal())).cwiseAbs().rowwise().sum();
    own.is_plain = across.maxCoeff() <= 1e-9 * size;
    for (int d = 0; d < 3; ++d) {
      if (port.is_held[d]) continue;
      // Where directions answer together, what bounds the answer: any positive value has the same solution.
      own.inverse[d] = answer(d, d) + (own.is_plain ? 0.0 : across[d]);
    }
    own.has_held = port.is_held[0] || port.is_held[1] || port.is_held[2];
    own.is_moved = own.has_held && own.piece->has_motions();
    ports_.push_back(own);
  }
  const bool has_group = point.first_port_2 - point.first_port > 1 || point.end_port - point.first_port_2 > 1;
  p.keeps_gap = point.law && point.law->shown().gap;
  if (p.keeps_gap) p.first_gap = point.law->initial().gap;
  p.needs_place = has_group || (point.law && !p.keeps_gap);
  points_.push_back(std::move(p));
}

// Points that share a node, or whose nodes answer along several axes at once, take turns until they agree.
void DirectPoints::find_clusters() {
  std::vector<int> root(points_.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  std::map<std::pair<const ExplicitPiece*, int>, int> first_at;
  std::vector<char> is_shared(points_.size(), 0);
  for (int i = 0; i < static_cast<int>(points_.size()); ++i)
    for (int p = points_[i].side_1.first; p < points_[i].side_2.end; ++p) {
      const auto [it, is_new] = first_at.emplace(std::pair{ports_[p].piece, ports_[p].node}, i);
      if (!ports_[p].is_plain) is_shared[i] = 1;
      if (is_new) continue;
      is_shared[i] = is_shared[it->second] = 1;
      root[find(i)] = find(it->second);
    }
  std::map<int, std::vector<int>> members;
  for (int i = 0; i < static_cast<int>(points_.size()); ++i)
    if (is_shared[i])
      members[find(i)].push_back(i);
    else
      alone_.push_back(i);
  for (auto& [first, of_cluster] : members) clusters_.push_back(std::move(of_cluster));
  swept_.resize(clusters_.size());
}

// Jump at the increment's start, and what closes it inside a group.
void DirectPoints::begin_places(OwnPoint& p) {
  std::array<Vec3, 2> mean{Vec3::Zero(), Vec3::Zero()};
  for (const int which : {0, 1}) {
    const Side& side = which == 0 ? p.side_1 : p.side_2;
    if (side.end == side.first) continue;
    std::array<const OwnPort*, 3> held{};
    for (int i = side.first; i < side.end; ++i) {
      OwnPort& port = ports_[i];
      port.offset = p.point->frame.transpose() * port.piece->start_displacement_of(port.node, port.v_old);
      mean[which] += port.offset / (side.end - side.first);
      for (int d = 0; d < 3; ++d)
        if (port.has_held && model_->exchange.ports[port.index].is_held[d]) held[d] = &port;
    }
    for (int d = 0; d < 3; ++d)
      if (held[d]) mean[which][d] = held[d]->offset[d];
    for (int i = side.first; i < side.end; ++i)
      ports_[i].offset =
          side.end - side.first > 1 ? Vec3((ports_[i].offset - mean[which]) / increment_.dt) : Vec3(Vec3::Zero());
  }
  p.record.trial.jump = (p.point->is_wall ? Vec3(Vec3::Zero()) : mean[1]) - mean[0];
}

void DirectPoints::begin_point(OwnPoint& p, const std::vector<double>& motions) {
  for (int i = p.side_1.first; i < p.side_2.end; ++i) {
    OwnPort& port = ports_[i];
    port.force.setZero();
    if (!port.is_moved) continue;
    const Port& of = model_->exchange.ports[port.index];
    for (int d = 0; d < 3; ++d)
      if (of.is_held[d]) port.held_velocity[d] = model_->held_velocity(of, p.point->frame.col(d), motions);
  }
  if (p.needs_place) begin_places(p);
}

// r and 1/k of one side (manual, eq. G1), with k the nodes' own: r is the velocity without this law's force.
void DirectPoints::gather(const OwnPoint& p, Side& side) {
  if (side.end - side.first == 1) {
    OwnPort& port = ports_[side.first];
    port.free = p.point->frame.transpose() * port.piece->velocity_of(port.node) - port.inverse.cwiseProduct(port.force);
    side.r = port.free;
    side.inverse_k = port.inverse;
    for (int d = 0; d < 3 && port.has_held; ++d)
      if (port.inverse[d] == 0.0) side.r[d] = port.held_velocity[d];
    return;
  }
  side.r.setZero();
  side.inverse_k.setZero();
  Vec3 k_sum = Vec3::Zero(), kr_sum = Vec3::Zero();
  std::array<bool, 3> is_held{};
  for (int i = side.first; i < side.end; ++i) {
    OwnPort& port = ports_[i];
    port.free = p.point->frame.transpose() * port.piece->velocity_of(port.node) - port.inverse.cwiseProduct(port.force);
    for (int d = 0; d < 3; ++d) {
      if (!p.point->is_active[d]) continue;
      if (port.inverse[d] == 0.0) {
        is_held[d] = true;
        side.r[d] = port.held_velocity[d];
      } else if (!is_held[d]) {
        k_sum[d] += 1.0 / port.inverse[d];
        kr_sum[d] += (port.free[d] + port.offset[d]) / port.inverse[d];
      }
    }
  }
  for (int d = 0; d < 3; ++d) {
    if (is_held[d] || k_sum[d] == 0.0) continue;
    side.r[d] = kr_sum[d] / k_sum[d];
    side.inverse_k[d] = 1.0 / k_sum[d];
  }
}

// A node's velocity with another force of this law on it.
void DirectPoints::push(const OwnPoint& p, OwnPort& port, const Vec3& force) {
  const Vec3 change = force - port.force;
  port.force = force;
  if (change.isZero(0.0)) return;
  const Vec3 moved = port.is_plain ? Vec3(p.point->frame * port.inverse.cwiseProduct(change))
                                   : Vec3(port.piece->node_compliance(port.node) * (p.point->frame * change));
  port.piece->set_velocity(port.node, port.piece->velocity_of(port.node) + moved);
}

// Velocities and forces of a side's nodes (manual, eq. G2-G3).
void DirectPoints::scatter(const OwnPoint& p, const Side& side, const Vec3& force) {
  if (side.end - side.first == 1) return push(p, ports_[side.first], force);
  Vec3 balance = force;
  std::array<int, 3> held_port{-1, -1, -1};
  for (int i = side.first; i < side.end; ++i) {
    OwnPort& port = ports_[i];
    Vec3 f = Vec3::Zero();
    for (int d = 0; d < 3; ++d) {
      if (!p.point->is_active[d]) continue;
      if (port.inverse[d] == 0.0) {
        held_port[d] = i;
        continue;
      }
      const double w = side.r[d] + side.inverse_k[d] * force[d] - port.offset[d];
      f[d] = (w - port.free[d]) / port.inverse[d];
      balance[d] -= f[d];
    }
    push(p, port, f);
  }
  for (int d = 0; d < 3; ++d)
    if (held_port[d] >= 0) ports_[held_port[d]].force[d] = balance[d];
}

void DirectPoints::find_force(OwnPoint& p) {
  gather(p, p.side_1);
  gather(p, p.side_2);
  p.record.force.setZero();
  if (p.point->law) {
    Trial& trial = p.record.trial;
    for (int d = 0; d < 3; ++d) {
      const bool acts = p.point->is_active[d] && p.point->has_law[d];
      trial.s[d] = acts ? p.side_2.r[d] - p.side_1.r[d] : 0.0;
      trial.y[d] = acts ? p.side_1.inverse_k[d] + p.side_2.inverse_k[d] : 0.0;
    }
    if (!p.record.is_released) p.record.force = p.point->law->force(trial, increment_, p.record.law);
  }
  scatter(p, p.side_1, p.record.force);
  scatter(p, p.side_2, -p.record.force);
}

void DirectPoints::solve_alone(OwnPoint& p, const std::vector<double>& motions) {
  begin_point(p, motions);
  find_force(p);
  end_point(p);
}

// One round: each point against the velocities that the others have left. The largest change of a force, and the
// largest force.
std::pair<double, double> DirectPoints::take_turns(const std::vector<int>& members, Turns& turns) {
  double change = 0.0, size = 0.0;
  size_t at = 0;
  for (const int i : members) {
    OwnPoint& p = points_[i];
    at = turns.change.size();
    for (int j = p.side_1.first; j < p.side_2.end; ++j) turns.change.push_back(ports_[j].force);
    find_force(p);
    for (int j = p.side_1.first; j < p.side_2.end; ++j, ++at) {
      turns.change[at] = ports_[j].force - turns.change[at];
      change = std::max(change, turns.change[at].cwiseAbs().maxCoeff());
      size = std::max(size, ports_[j].force.cwiseAbs().maxCoeff());
    }
  }
  return {change, size};
}

// Rounds that creep are shortened: what they go on to change is the sum of a geometric series.
void DirectPoints::leap(const std::vector<int>& members, const Turns& turns, const Turns& before) {
  double together = 0.0, own = 0.0;
  for (size_t i = 0; i < turns.change.size(); ++i) {
    together += turns.change[i].dot(before.change[i]);
    own += before.change[i].squaredNorm();
  }
  const double ratio = own > 0.0 ? together / own : 0.0;
  if (ratio < 0.3 || ratio > 0.9999) return;
  size_t at = 0;
  for (const int i : members)
    for (int j = points_[i].side_1.first; j < points_[i].side_2.end; ++j, ++at)
      push(points_[i], ports_[j], ports_[j].force + ratio / (1.0 - ratio) * turns.change[at]);
}

// Block Gauss-Seidel.
void DirectPoints::solve_cluster(const std::vector<int>& members, const std::vector<double>& motions) {
  constexpr int rounds_between_leaps = 6;
  for (const int i : members) begin_point(points_[i], motions);
  Swept& swept = swept_[&members - clusters_.data()];
  Turns &turns = swept.turns, &before = swept.before;
  for (swept.sweeps = 1; swept.sweeps <= most_rounds; ++swept.sweeps) {
    std::swap(turns, before);
    turns.change.clear();
    const auto [change, size] = take_turns(members, turns);
    swept.change = size > 0.0 ? change / std::max(size, 1e-6 * largest_force_) : 0.0;
    if (swept.change <= close_enough_) break;
    if (swept.sweeps % rounds_between_leaps == 0) leap(members, turns, before);
  }
  // Rates are those of the velocities found.
  for (const int i : members) {
    OwnPoint& p = points_[i];
    gather(p, p.side_1);
    gather(p, p.side_2);
    for (int d = 0; d < 3; ++d)
      if (p.record.trial.y[d] > 0.0) p.record.trial.s[d] = p.side_2.r[d] - p.side_1.r[d];
    end_point(p);
  }
}

void DirectPoints::solve(const std::vector<double>& motions) {
  const int n = static_cast<int>(alone_.size()), n_chunks = (n + chunk - 1) / chunk;
  parallel_for(
      n_chunks,
      [&](int c) {
        for (int i = c * chunk; i < std::min(n, (c + 1) * chunk); ++i) solve_alone(points_[alone_[i]], motions);
      },
      Schedule::evenly, n_chunks > 4 ? 0 : 1);
  const int n_clusters = static_cast<int>(clusters_.size());
  parallel_for(
      n_clusters, [&](int c) { solve_cluster(clusters_[c], motions); }, Schedule::evenly, n_clusters > 32 ? 0 : 1);
  for (size_t c = 0; c < clusters_.size(); ++c) {
    n_sweeps_ += swept_[c].sweeps;
    most_sweeps_ = std::max(most_sweeps_, swept_[c].sweeps);
    largest_change_ = std::max(largest_change_, swept_[c].change);
    for (const int i : clusters_[c])
      largest_force_ = std::max(largest_force_, points_[i].record.force.cwiseAbs().maxCoeff());
  }
  interval_ += increment_.dt;
}

}  // namespace dygita
