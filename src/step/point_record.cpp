#include "step/point_record.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "exchange/near_points.hpp"
#include "law/law.hpp"

namespace dygita {

namespace {

double first_gap(const Surface& surface, int point) {
  return surface.interface && surface.interface->has_gap_of_geometry ? surface.facing.gaps[point]
                                                                     : surface.declared_law().initial().gap;
}

// The port that has one side of a point held along a direction, or null.
const Port* holder_of(const StepModel& model, int first, int end, int d) {
  const std::vector<Port>& ports = model.exchange.ports;
  const auto holder =
      std::find_if(ports.begin() + first, ports.begin() + end, [d](const Port& port) { return port.is_held[d]; });
  return holder == ports.begin() + end ? nullptr : &*holder;
}

}  // namespace

std::vector<PortMotion> port_motions(const StepModel& model, const State& start) {
  const Cut& cut = *model.cut;
  const Exchange& exchange = model.exchange;
  constexpr size_t n_motion = 6;
  std::vector<double> values(n_motion * exchange.ports.size(), 0.0);
  for (size_t p = 0; p < exchange.ports.size(); ++p) {
    const Port& port = exchange.ports[p];
    if (!model.solves(port.piece)) continue;
    const auto motion = [&](const Points& field) -> Vec3 {
      if (!port.trace) return field.col(port.piece_node);
      return port.trace->at_nodes(port.point, [&](int node) { return field.col(cut.owner(port.part, node).node); });
    };
    Eigen::Map<Vec3>(values.data() + n_motion * p) = motion(start.displacement[port.piece]);
    Eigen::Map<Vec3>(values.data() + n_motion * p + 3) = motion(start.velocity[port.piece]);
  }
  if (!model.near.is_all()) receive_ports(cut, exchange, static_cast<int>(n_motion), values.data());
  std::vector<PortMotion> motions(exchange.ports.size());
  for (size_t p = 0; p < motions.size(); ++p)
    motions[p] = {Eigen::Map<const Vec3>(values.data() + n_motion * p),
                  Eigen::Map<const Vec3>(values.data() + n_motion * p + 3)};
  return motions;
}

PointRecord start_point(const StepModel& model, const Point& point, const State& start,
                        const std::vector<PortMotion>& ports) {
  PointRecord record;
  record.trial.area = point.area;
  if (!point.law) return record;
  LawState& law = record.law;
  for (const Member& member : point.members) {
    const LawState& m = start.surfaces[member.surface].points[member.point];
    law.add(m, member.share, point.frame);
    record.first_gap += member.share * first_gap((*model.surfaces)[member.surface], member.point);
  }
  record.is_released = start.released[point.members.front().surface] != 0;
  record.shortening_old = record.trial.shortening = start.shortening[point.members.front().surface];
  for (int d = 0; d < 3; ++d)
    record.trial.is_given[d] = point.has_law[d] && holder_of(model, point.first_port, point.first_port_2, d) &&
                               (point.is_wall || holder_of(model, point.first_port_2, point.end_port, d));
  if (model.scheme.is_static) return record;
  const int n_1 = point.first_port_2 - point.first_port, n_2 = point.end_port - point.first_port_2;
  for (int p = point.first_port; p < point.end_port; ++p) {
    const double share = p < point.first_port_2 ? -1.0 / n_1 : 1.0 / n_2;
    law.rate += share * (point.frame.transpose() * ports[p].velocity);
  }
  return record;
}

void begin_point(const StepModel& model, const Point& point, const Vec3& jump, int increment, PointRecord& record) {
  record.trial.jump = jump;
  record.shortening_old = record.trial.shortening;
  const Interface* interface = (*model.surfaces)[point.members.front().surface].interface;
  if (!interface) return;
  record.trial.shortening = model.loads->shortening(interface, record.trial.shortening, increment);
  record.is_released = record.is_released || model.loads->is_released(interface, increment);
}

// Differences of what moves both alike, or has brought them where they are, are rounding.
void give_rates(const StepModel& model, const Point& point, const std::vector<double>& motions, double moved,
                PointRecord& record) {
  constexpr double of_rates = 1e-12, of_places = 1e-14;
  double size = 0.0;
  record.given_rate.setZero();
  for (int d = 0; d < 3; ++d) {
    if (!record.trial.is_given[d]) continue;
    const auto velocity = [&](int first, int end) {
      const Port* holder = holder_of(model, first, end, d);
      return holder ? model.held_velocity(*holder, point.frame.col(d), motions) : 0.0;
    };
    const double side_1 = velocity(point.first_port, point.first_port_2),
                 side_2 = velocity(point.first_port_2, point.end_port);
    record.given_rate[d] = side_2 - side_1;
    size = std::max(size, std::abs(side_1) + std::abs(side_2));
  }
  const double rounding = std::max(of_rates * size, of_places * moved / model.scheme.dt);
  if (record.given_rate.norm() <= rounding) record.given_rate.setZero();
}

LawState end_of_point(const Point& point, const PointRecord& record, const Increment& increment) {
  if (!point.law) return record.law;
  if (!record.is_released) return point.law->advance(record.trial, increment, record.law, record.force);
  LawState end = record.law;
  end.force.setZero();
  end.status = PointState::open;
  point.law->let_go(end);
  return end;
}

bool links(const Point& point, const PointRecord& record, double least) {
  const double force = record.force.cwiseAbs2().dot(record.trial.y);
  return force > least || (point.law && point.has_law[0] && !point.law->shown().gap && !record.is_released);
}

double gap_of(const Point& point, const PointRecord& record, const Increment& increment) {
  if (!point.law || !point.has_law[0] || !point.law->shown().gap || record.is_released)
    return std::numeric_limits<double>::infinity();
  return point.law->opening(end_of_point(point, record, increment));
}

double gap_difference(const Point& point, const PointRecord& record) {
  if (!point.law || !point.law->shown().gap) return 0.0;
  return std::abs(record.first_gap + record.trial.jump[0] - record.law.gap);
}

void book_on_surfaces(const Point& point, const Work& work, State& state) {
  for (const Member& member : point.members) state.surfaces[member.surface].works[member.point].add(work, member.share);
}

void book_dissipation(const Point& point, const Work& work, State& state) {
  book_on_surfaces(point, work, state);
  state.energies.friction += work.friction;
  state.energies.plastic += work.plastic;
  state.energies.damping += work.damping;
  state.energies.stored += work.stored;
}

void book_work(const Point& point, const PointRecord& record, const LawState& end, const Increment& increment,
               double on_pieces, State& state, IncrementEnergy& energy) {
  Work work;
  if (point.law) {
    work = point.law->work(record.law, end, increment, point.area);
    const double force = working_force(record.law, end, increment)[0];
    work.given += force * (record.trial.shortening - record.shortening_old);
    book_on_surfaces(point, work, state);
  }
  energy.loads += work.given;
  energy.friction += work.friction;
  energy.plastic += work.plastic;
  energy.damping += work.damping;
  energy.stored += work.stored;
  energy.scheme += work.given - on_pieces - work.friction - work.plastic - work.damping - work.stored;
}

void book_work(const Point& point, const PointRecord& record, const LawState& end, const Increment& increment,
               double on_pieces, State& state) {
  IncrementEnergy energy;
  book_work(point, record, end, increment, on_pieces, state, energy);
  state.energies.friction += energy.friction;
  state.energies.plastic += energy.plastic;
  state.energies.damping += energy.damping;
  state.energies.loads += energy.loads;
  state.energies.scheme += energy.scheme;
  state.energies.stored += energy.stored;
}

void show_law(const Point& point, const LawState& law, State& state) {
  for (const Member& member : point.members)
    state.surfaces[member.surface].points[member.point] = law.member(member.share, point.frame);
}

void show_record(const Point& point, const PointRecord& record, State& state) {
  for (const Member& member : point.members) {
    state.shortening[member.surface] = record.trial.shortening;
    state.released[member.surface] = record.is_released;
  }
}

void show_point(const Point& point, const PointRecord& record, State& state) {
  show_law(point, record.law, state);
  show_record(point, record, state);
}

void show_ties(const StepModel& model, const Point& point, const PointRecord& record, std::span<const Vec3> port_force,
               State& state) {
  const Exchange& exchange = model.exchange;
  const std::span ties(exchange.ties.data() + point.first_tie, exchange.ties.data() + point.end_tie);
  if (ties.empty()) return;
  const int n_ports = point.end_port - point.first_port, n_ties = static_cast<int>(ties.size());
  thread_local std::vector<Vec3> net;  // called for every point of every time step
  net.assign(port_force.begin(), port_force.begin() + n_ports);
  // A tie holds a substructure, wherever that is cut: what its copies take goes to the owner.
  for (int p = 0; p < n_ports; ++p) {
    const Port& port = exchange.ports[point.first_port + p];
    for (int o = 0; o < n_ports && !port.is_owner; ++o) {
      const Port& owner = exchange.ports[point.first_port + o];
      if (!owner.is_owner || owner.part != port.part || owner.node != port.node) continue;
      net[o] += net[p];
      net[p].setZero();
      break;
    }
  }
  // The law's own share on each port is not the tie's.
  for (const Member& member : point.members) {
    const Surface& surface = (*model.surfaces)[member.surface];
    for (int p = 0; p < n_ports; ++p) {
      const Port& port = exchange.ports[point.first_port + p];
      if (!port.is_owner) continue;
      if (port.part == surface.part_1 && port.node == surface.facing.side_1.main_node(member.point))
        net[p] -= member.share * record.law.force;
      if (port.part == surface.part_2 && port.node == surface.facing.side_2.main_node(member.point))
        net[p] += member.share * record.law.force;
    }
  }
  const Mat& split = exchange.splits.of(point);
  for (int t = 0; t < n_ties; ++t) {
    Vec3 force = Vec3::Zero();
    for (int p = 0; p < n_ports; ++p) force += split(t, p) * net[p];
    LawState& shown = state.surfaces[ties[t].surface].points[ties[t].surface_point];
    shown.force = point.frame * force;
    shown.status = PointState::stick;
  }
}

void show_ties(const StepModel& model, const std::vector<PointRecord>& records, const std::vector<Vec3>& port_force,
               State& state) {
  for (size_t i = 0; i < records.size(); ++i)
    if (const Point& point = model.exchange.points[i]; !point.is_direct)
      show_ties(model, point, records[i], std::span(port_force).subspan(static_cast<size_t>(point.first_port)), state);
}

}  // namespace dygita
