#include "reference/penalty.hpp"

#include <algorithm>
#include <cmath>

#include "fem/assembly.hpp"

namespace dygita {

namespace {

// What holds does not open and close: it can be as stiff as the cells behind it without making impacts chatter.
constexpr double least_tie = 1.0;
// Of the masses' own rule, Z = m / dt^2 (LS-DYNA's "soft" contact).
constexpr double soft_rule = 0.5;

struct Side {
  double stiffness = 0.0, mass = 0.0;  // N/m, kg
};

// K A^2 / V of the layer of cells behind the nodes of one side of a point (Hallquist's rule), and their mass.
Side side_of(const StepModel& model, const Point& point, int side) {
  Side sum;
  for (const Member& member : point.members) {
    const Surface& surface = (*model.surfaces)[member.surface];
    const int part = side == 1 ? surface.part_1 : surface.part_2;
    const int node = (side == 1 ? surface.facing.nodes_1 : surface.facing.nodes_2)[member.point];
    const Elastic& material = model.problem->substructures[part]->material;
    const double bulk = material.young / (3 * (1 - 2 * material.poisson));
    const double area = surface.facing.areas[member.point], mass = model.pieces[part]->node_masses()[node];
    // A node on a face has half of the volume of the cells behind its area.
    sum.stiffness += bulk * area * area / (2 * mass / material.density);
    sum.mass += mass;
  }
  return sum;
}

double stiffness_of(const StepModel& model, const Point& point, double penalty, double critical) {
  const Side side_1 = side_of(model, point, 1);
  if (point.is_wall) return penalty * side_1.stiffness;
  const Side side_2 = side_of(model, point, 2);
  const double mass = side_1.mass * side_2.mass / (side_1.mass + side_2.mass);
  return penalty * std::max(std::min(side_1.stiffness, side_2.stiffness), soft_rule * mass / (critical * critical));
}

}  // namespace

PenaltySprings::PenaltySprings(const StepModel& model, const std::vector<PointRecord>& start,
                               const std::vector<char>& is_tied, const InternalForce& internal) {
  const double penalty = model.problem->explicit_dynamics->penalty;
  double frequency = 0.0;
  for (const SubstructurePtr& part : model.problem->substructures)
    frequency = std::max(frequency, max_frequency(*part->mesh, part->material));
  for (size_t i = 0; i < model.exchange.points.size(); ++i) {
    const Point& point = model.exchange.points[i];
    if (!point.law || is_tied[point.members.front().surface] || start[i].is_released) continue;
    const Surface& surface = (*model.surfaces)[point.members.front().surface];
    const auto dof = [&](int port) {
      return internal.first(model.exchange.ports[port].part) + 3 * model.exchange.ports[port].node;
    };
    Spring spring;
    spring.point = static_cast<int>(i);
    spring.dof_1 = dof(point.first_port);
    spring.dof_2 = point.is_wall ? -1 : dof(point.first_port_2);
    spring.frame = point.frame;
    const bool is_contact = point.law->rubs();
    const double k = stiffness_of(model, point, is_contact ? penalty : std::max(least_tie, penalty), 2.0 / frequency);
    const LawState& law = start[i].law;
    for (int d = 0; d < 3; ++d) spring.stiffness[d] = point.law->acts_on(d) ? k : 0.0;
    spring.force = law.force;
    spring.status = law.status;
    spring.slip = law.slip;
    spring.start_plastic = law.plastic_opening;
    spring.start_accumulated = law.hardening_opening;
    if (is_contact) {
      spring.kind = Kind::contact;
      spring.friction = surface.interface ? surface.interface->friction : surface.wall->friction;
      spring.start_gap = law.gap;
      // What pressed at the start goes on pressing; what overlapped without force is let be.
      spring.offset = law.force[0] < 0.0 ? law.force[0] / k - law.gap : std::max(0.0, -law.gap);
    } else {
      const Interface& interface = *surface.interface;
      spring.kind = interface.kind == InterfaceKind::plastic ? Kind::plastic : Kind::tie;
      spring.yield = point.area * interface.yield;
      spring.hardening = point.area * interface.hardening;
      spring.yields_in_compression = interface.compression;
    }
    springs_.push_back(spring);
  }
}

double PenaltySprings::release(const StepModel& model, int increment) {
  double lost = 0.0;
  for (Spring& spring : springs_) {
    const Interface* interface =
        (*model.surfaces)[model.exchange.points[spring.point].members.front().surface].interface;
    if (spring.is_released || !interface || !model.loads->is_released(interface, increment)) continue;
    lost += energy_of(spring);
    spring.is_released = true;
    spring.force.setZero();
    spring.status = PointState::open;
  }
  return lost;
}

Vec3 PenaltySprings::jump_of(const Spring& spring, const Vec& displacement) const {
  Vec3 jump = -displacement.segment<3>(spring.dof_1);
  if (spring.dof_2 >= 0) jump += displacement.segment<3>(spring.dof_2);
  return spring.frame.transpose() * jump;
}

// Normal force of the gap, friction by radial return (eq. X9, X10).
void PenaltySprings::add_contact(Spring& spring, const Vec3& jump) {
  const Vec3 moved = jump - spring.jump;
  spring.force[0] = spring.stiffness[0] * std::min(0.0, spring.start_gap + jump[0] + spring.offset);
  if (spring.force[0] == 0.0) {
    spring.force.tail<2>().setZero();
    spring.status = PointState::open;
    return;
  }
  spring.status = PointState::slip;
  if (spring.stiffness[1] == 0.0) return;
  const double limit = spring.friction * -spring.force[0];
  const Eigen::Vector2d before = spring.force.tail<2>();
  const Eigen::Vector2d trial = before + spring.stiffness[1] * moved.tail<2>();
  const double norm = trial.norm();
  if (norm <= limit) {
    spring.force.tail<2>() = trial;
    spring.status = PointState::stick;
    return;
  }
  spring.force.tail<2>() = trial * (limit / norm);
  const Eigen::Vector2d slid = (trial - spring.force.tail<2>()) / spring.stiffness[1];
  spring.slip.tail<2>() += slid;
  spring.friction_work += spring.force.tail<2>().dot(slid);
}

// Elastic, then rigid-plastic with hardening in the normal direction by return mapping (eq. X11).
void PenaltySprings::add_bond(Spring& spring, const Vec3& jump) {
  spring.force += spring.stiffness.cwiseProduct(jump - spring.jump);
  spring.status = PointState::stick;
  if (spring.kind != Kind::plastic) return;
  const double limit = spring.yield + spring.hardening * (spring.start_accumulated + spring.accumulated);
  const double pull = spring.yields_in_compression ? std::abs(spring.force[0]) : spring.force[0];
  if (pull <= limit) return;
  const double opened = (pull - limit) / (spring.stiffness[0] + spring.hardening);
  const double sign = spring.force[0] < 0.0 ? -1.0 : 1.0;
  spring.force[0] -= sign * spring.stiffness[0] * opened;
  spring.plastic += sign * opened;
  spring.accumulated += opened;
  spring.status = PointState::slip;
}

void PenaltySprings::put(const Spring& spring, const Vec3& force, Vec& all) {
  const Vec3 f = spring.frame * force;
  all.segment<3>(spring.dof_1) -= f;
  if (spring.dof_2 >= 0) all.segment<3>(spring.dof_2) += f;
}

void PenaltySprings::add_force(const Vec& displacement, Vec& force) {
  for (Spring& spring : springs_) {
    if (spring.is_released) continue;
    const Vec3 jump = jump_of(spring, displacement);
    spring.kind == Kind::contact ? add_contact(spring, jump) : add_bond(spring, jump);
    spring.jump = jump;
    if (spring.force[0] != 0.0 || spring.kind != Kind::contact) put(spring, spring.force, force);
  }
}

void PenaltySprings::add_closed_force(const Vec& displacement, Vec& force) const {
  for (const Spring& spring : springs_)
    put(spring, spring.stiffness.cwiseProduct(jump_of(spring, displacement)), force);
}

void PenaltySprings::weigh(double weight) {
  for (Spring& spring : springs_) {
    spring.sum += weight * spring.force;
    spring.weight += weight;
  }
}

double PenaltySprings::energy_of(const Spring& spring) {
  double sum = 0.0;
  for (int d = 0; d < 3; ++d)
    if (spring.stiffness[d] > 0.0) sum += 0.5 * spring.force[d] * spring.force[d] / spring.stiffness[d];
  return sum;
}

double PenaltySprings::energy() const {
  double sum = 0.0;
  for (const Spring& spring : springs_) sum += energy_of(spring);
  return sum;
}

LawState PenaltySprings::state_of(const Spring& spring, const LawState& start, const Vec3& force) const {
  LawState law = start;
  law.force = force;
  law.status = spring.status;
  law.slip = spring.slip;
  law.opening_rate = 0.0;
  law.plastic_opening = spring.start_plastic + spring.plastic;
  law.hardening_opening = spring.start_accumulated + spring.accumulated;
  if (spring.kind == Kind::contact) law.gap = spring.start_gap + spring.jump[0];
  return law;
}

void PenaltySprings::show(const StepModel& model, std::vector<PointRecord>& records, State& state) {
  for (Spring& spring : springs_) {
    const Point& point = model.exchange.points[spring.point];
    PointRecord& record = records[spring.point];
    const LawState law = state_of(spring, record.law, spring.sum / spring.weight);
    const double plastic = point.law->plastic_work(law, point.area) - point.law->plastic_work(record.law, point.area);
    state.energies.friction += spring.friction_work;
    state.energies.plastic += plastic;
    for (const Member& member : point.members) {
      state.surfaces[member.surface].friction_work += member.share * spring.friction_work;
      state.surfaces[member.surface].plastic_work += member.share * plastic;
    }
    record.law = law;
    record.is_released = spring.is_released;
    show_point(point, record, state);
    spring.sum.setZero();
    spring.weight = spring.friction_work = 0.0;
  }
}

void PenaltySprings::keep(const StepModel& model, const std::vector<PointRecord>& records, State& state) const {
  for (const Spring& spring : springs_) {
    PointRecord record = records[spring.point];
    record.law.force = spring.force;
    show_point(model.exchange.points[spring.point], record, state);
  }
}

}  // namespace dygita
