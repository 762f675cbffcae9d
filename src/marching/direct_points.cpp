#include "marching/direct_points.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "law/law.hpp"
#include "marching/force_leap.hpp"
#include "step/distant_points.hpp"

namespace dygita {

namespace {

constexpr int most_rounds = 20000;
constexpr int rounds_before_leaps = 200, rounds_between_leaps = 3;
constexpr int leaps_of_a_point = 150000;  // in an increment, shared by those of a set: some seconds at most
constexpr int few_points = 32;            // are solved before threads have met

// Of what a point would change, in a round: laws with friction that share a node may go round in circles otherwise.
double share_of(int round) { return round < 400 ? 1.0 : round < 3000 ? 0.5 : 0.2; }

// Rounds that no longer bring the forces closer. Ties in a loop whose jumps do not quite add up to zero have forces
// that drift without bound, by as little in each round as the jumps are off, while the velocities stay.
class RoundsInVain {
 public:
  bool are_too_many(double change, double small) {
    constexpr int rounds_where_small = 50, rounds_anywhere = 2000;
    ++n_;
    if (change < 0.5 * least_) {
      least_ = change;
      n_ = 0;
    }
    return n_ >= (change <= small ? rounds_where_small : rounds_anywhere);
  }

 private:
  double least_ = std::numeric_limits<double>::infinity();
  int n_ = 0;
};

}  // namespace

DirectPoints::DirectPoints(const StepModel& model, const State& start)
    : model_(&model),
      increment_{model.scheme, model.problem->solver.push_out},
      close_enough_(std::clamp(0.1 * model.problem->solver.tolerance, 1e-13, 1e-10)) {
  const NearDirect near = ranks::is_alone() ? NearDirect() : near_direct(*model.cut, model.exchange);
  if (model.has_explicit() && !ranks::is_alone()) find_motions(model, near);
  const std::vector<PortMotion> motions = port_motions(model, start);
  std::vector<int> kept;
  size_t n_ports = 0;
  for (size_t i = 0; i < model.exchange.points.size(); ++i) {
    const Point& point = model.exchange.points[i];
    if (!point.is_direct || !(ranks::is_alone() || near.points[i])) continue;
    kept.push_back(static_cast<int>(i));
    n_ports += static_cast<size_t>(point.end_port - point.first_port);
  }
  points_.resize(kept.size());
  ports_.resize(n_ports);
  bool is_spread = false;
  int first = 0;
  for (size_t k = 0; k < kept.size(); ++k) {
    const Point& point = model.exchange.points[kept[k]];
    points_[k].side_1.first = first;
    points_[k].side_1.end = points_[k].side_2.first = first + point.first_port_2 - point.first_port;
    points_[k].side_2.end = first += point.end_port - point.first_port;
    for (int i = point.first_port; i < point.end_port; ++i) is_spread |= model.exchange.ports[i].trace != nullptr;
  }
  // Nodes that a port moves with are listed in the order of the points.
  parallel_for(
      static_cast<int>(kept.size()), [&](int k) { set_point(model, points_[k], kept[k], start, motions); },
      Schedule::evenly, is_spread ? 1 : 0);
  find_released();
  find_books();
  find_clusters();
  has_clusters_ = ranks::any(!clusters_.empty());
  split_points();
}

void DirectPoints::set_point(const StepModel& model, OwnPoint& p, int index, const State& start,
                             const std::vector<PortMotion>& motions) {
  const Point& point = model.exchange.points[index];
  p.point = &point;
  p.index = index;
  p.is_booked_here = DistantPoints::booking(model, point) == ranks::me();
  p.record = start_point(model, point, start, motions);
  p.record.trial.shortening = p.record.shortening_old;
  for (int i = p.side_1.first; i < p.side_2.end; ++i) {
    ports_[i] = make_port(model, point, point.first_port + i - p.side_1.first);
    ports_[i].v_old = velocity(p, ports_[i]);
  }
  const bool has_group = point.first_port_2 - point.first_port > 1 || point.end_port - point.first_port_2 > 1;
  p.keeps_gap = point.law && point.law->shown().gap;
  p.needs_place = has_group || (point.law && !p.keeps_gap);
}

// Points that share a node, or whose nodes answer along several axes at once, take turns until they agree.
void DirectPoints::find_clusters() {
  std::vector<int> root(points_.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  std::map<std::pair<const ExplicitNodes*, int>, int> first_at;
  std::vector<char> is_shared(points_.size(), 0);
  for (int i = 0; i < static_cast<int>(points_.size()); ++i)
    for (int p = points_[i].side_1.first; p < points_[i].side_2.end; ++p) {
      if (!ports_[p].is_plain) is_shared[i] = 1;
      for_each_node(ports_[p], [&](int node) {
        const auto [it, is_new] = first_at.emplace(std::pair<const ExplicitNodes*, int>(ports_[p].nodes, node), i);
        if (is_new || it->second == i) return;
        is_shared[i] = is_shared[it->second] = 1;
        root[find(i)] = find(it->second);
      });
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
      port.offset = start_displacement(p, port);
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
  if (interval_ == 0.0) begin_interval_of(p);
  for (int i = p.side_1.first; i < p.side_2.end; ++i) {
    OwnPort& port = ports_[i];
    port.last = port.force;
    port.force.setZero();
    if (!port.is_moved || port.is_spread()) continue;
    const Port& of = model_->exchange.ports[port.index];
    for (int d = 0; d < 3; ++d)
      if (of.is_held[d]) port.held_velocity[d] = model_->held_velocity(of, p.point->frame.col(d), motions);
  }
  if (p.needs_place) begin_places(p);
  if (p.record.trial.is_given != std::array<bool, 3>{}) give_rates(*model_, *p.point, motions, 0.0, p.record);
}

void DirectPoints::find_force(OwnPoint& p) {
  gather(p, p.side_1);
  gather(p, p.side_2);
  p.record.force.setZero();
  if (p.point->law) {
    Trial& trial = p.record.trial;
    for (int d = 0; d < 3; ++d) {
      const bool acts = p.point->is_active[d] && p.point->has_law[d] && !trial.is_given[d];
      trial.s[d] = acts ? p.side_2.r[d] - p.side_1.r[d] : p.record.given_rate[d];
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
std::pair<double, double> DirectPoints::take_turns(const std::vector<int>& members, double share) {
  double change = 0.0, size = 0.0;
  std::vector<Vec3> before;
  for (const int i : members) {
    OwnPoint& p = points_[i];
    before.clear();
    for (int j = p.side_1.first; j < p.side_2.end; ++j) before.push_back(ports_[j].force);
    find_force(p);
    for (int j = p.side_1.first; j < p.side_2.end; ++j) {
      const Vec3 own = ports_[j].force - before[static_cast<size_t>(j - p.side_1.first)];
      change = std::max(change, own.cwiseAbs().maxCoeff());
      size = std::max(size, ports_[j].force.cwiseAbs().maxCoeff());
      if (share < 1.0) push(p, ports_[j], ports_[j].force - (1.0 - share) * own);
    }
  }
  return {change, size};
}

void DirectPoints::take_forces(const std::vector<int>& members, Vec& forces) const {
  Eigen::Index at = 0;
  for (const int i : members)
    for (int j = points_[i].side_1.first; j < points_[i].side_2.end; ++j, at += 3)
      forces.segment<3>(at) = ports_[j].force;
}

void DirectPoints::give_forces(const std::vector<int>& members, const Vec& forces) {
  Eigen::Index at = 0;
  for (const int i : members)
    for (int j = points_[i].side_1.first; j < points_[i].side_2.end; ++j, at += 3)
      push(points_[i], ports_[j], forces.segment<3>(at));
}

// Squares of forces count as the power that they change.
Vec DirectPoints::weights_of(const std::vector<int>& members) const {
  std::vector<double> weights;
  for (const int i : members)
    for (int j = points_[i].side_1.first; j < points_[i].side_2.end; ++j)
      for (const double inverse : ports_[j].inverse) weights.push_back(inverse);
  return Eigen::Map<const Vec>(weights.data(), static_cast<Eigen::Index>(weights.size()));
}

// A tie takes any force.
bool DirectPoints::have_bounded_forces(const std::vector<int>& members) const {
  return std::none_of(members.begin(), members.end(), [&](int i) {
    const Law* const law = points_[i].point->law;
    return !law || law->is_tie();
  });
}

void DirectPoints::leap_from(const std::vector<int>& members, const Vec& weight) {
  const auto forces_now = [&] {
    Vec forces(weight.size());
    take_forces(members, forces);
    return forces;
  };
  const auto round = [&](const Vec& forces) {
    give_forces(members, forces);
    take_turns(members, 1.0);
    return forces_now();
  };
  give_forces(members, leap(forces_now(), weight, round));
}

// Between meshes that do not match forces are as many as the points, and change little from one increment to the next.
// Where laws with friction share a node they are not, and zero is where all can stick.
void DirectPoints::start_from_last(OwnPoint& p) {
  for (int i = p.side_1.first; i < p.side_2.end; ++i) push(p, ports_[i], ports_[i].last);
}

// Rounding of what would stop the nodes, or bring them back to where the step began, in one increment: where all move
// alike forces are nothing but that, and change by their own size in each round.
double DirectPoints::least_force(const std::vector<int>& members) const {
  constexpr double share = 1e-4;  // of which `close_enough_` is some fifty times rounding
  double least = 0.0;
  for (const int i : members) {
    const OwnPoint& p = points_[i];
    for (int j = p.side_1.first; j < p.side_2.end; ++j) {
      const OwnPort& port = ports_[j];
      const double v = velocity(p, port).norm() + start_displacement(p, port).norm() / increment_.dt;
      for (int d = 0; d < 3; ++d)
        if (port.inverse[d] > 0.0) least = std::max(least, share * v / port.inverse[d]);
    }
  }
  return least;
}

// Block Gauss-Seidel.
void DirectPoints::solve_cluster(const std::vector<int>& members, const std::vector<double>& motions) {
  for (const int i : members) begin_point(points_[i], motions);
  const auto is_spread = [&](int i) { return ports_[points_[i].side_1.first].is_spread(); };
  if (std::any_of(members.begin(), members.end(), is_spread))
    for (const int i : members) start_from_last(points_[i]);
  Swept& swept = swept_[&members - clusters_.data()];
  const double least = least_force(members);
  const bool mixes = !model_->problem->solver.plain;
  const double tolerance = model_->problem->solver.tolerance;
  if (swept.weight.size() == 0) swept.weight = weights_of(members);
  Vec before(swept.weight.size()), after(before.size());
  swept.mixing.begin();
  RoundsInVain in_vain;
  int n_leaps = 0;
  const int most_leaps =
      mixes && have_bounded_forces(members) ? leaps_of_a_point / static_cast<int>(members.size()) : 0;
  take_forces(members, before);
  for (swept.sweeps = 1; swept.sweeps <= most_rounds; ++swept.sweeps) {
    const double share = share_of(swept.sweeps);
    const auto [change, size] = take_turns(members, share);
    swept.change = size > 0.0 ? change / std::max({size, 1e-6 * largest_force_, least}) : 0.0;
    if (swept.change <= close_enough_ || (mixes && in_vain.are_too_many(swept.change, 0.1 * tolerance))) break;
    if (swept.sweeps >= rounds_before_leaps && n_leaps < most_leaps) {
      if (swept.sweeps % rounds_between_leaps == 0) {
        leap_from(members, swept.weight);
        ++n_leaps;
      }
      continue;
    }
    if (!mixes || share < 1.0) continue;
    take_forces(members, after);
    before = swept.mixing.next(before, after, swept.weight);
    give_forces(members, before);
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

void DirectPoints::solve_some(int turn, const std::vector<double>& motions, int most_threads) {
  const std::vector<int>& alone = points_in_turn_[turn];
  const int n = static_cast<int>(alone.size());
  solved_shares_[turn].run(n, n > few_points ? most_threads : 1,
                           [&](int i) { solve_alone(points_[alone[i]], motions); });
}

void DirectPoints::solve_some_clusters(const std::vector<int>& clusters, const std::vector<double>& motions,
                                       int most_threads) {
  const auto n_shared = static_cast<int>(points_.size() - alone_.size());
  parallel_for(
      static_cast<int>(clusters.size()),
      [&](int i) { solve_cluster(clusters_[clusters[static_cast<size_t>(i)]], motions); }, Schedule::as_free,
      n_shared > few_points ? most_threads : 1);
}

void DirectPoints::solve(const std::vector<double>& motions, int most_threads) {
  solve_some(0, motions, most_threads);
  if (largest_of_all_.is_begun()) largest_force_ = largest_of_all_.end();
  solve_some_clusters(clusters_in_turn_[0], motions, most_threads);
  receive_motions();
  solve_some(1, motions, most_threads);
  solve_some_clusters(clusters_in_turn_[1], motions, most_threads);
  for (size_t c = 0; c < clusters_.size(); ++c) {
    largest_change_ = std::max(largest_change_, swept_[c].change);
    for (const int i : clusters_[c])
      largest_force_ = std::max(largest_force_, points_[i].record.force.cwiseAbs().maxCoeff());
  }
  // Rounds over points that share nodes end by it, everywhere: in the next increment.
  if (has_clusters_) largest_of_all_.begin(largest_force_);
  interval_ += increment_.dt;
}

double DirectPoints::take_change() {
  if (largest_of_all_.is_begun()) largest_force_ = largest_of_all_.end();
  return ranks::largest(std::exchange(largest_change_, 0.0));
}

// Those that wait for other ranks come last.
void DirectPoints::split_points() {
  const auto waits = [&](int i) {
    for (int p = points_[i].side_1.first; p < points_[i].side_2.end; ++p)
      if (!ports_[p].piece) return true;
    return false;
  };
  for (const int i : alone_) points_in_turn_[waits(i)].push_back(i);
  for (size_t c = 0; c < clusters_.size(); ++c)
    clusters_in_turn_[std::any_of(clusters_[c].begin(), clusters_[c].end(), waits)].push_back(static_cast<int>(c));
}

}  // namespace dygita
