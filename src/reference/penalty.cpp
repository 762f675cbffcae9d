#include "reference/penalty.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fem/assembly.hpp"
#include "law/law.hpp"

namespace dygita {

namespace {

// Of the masses' own rule, Z = m / dt^2 (LS-DYNA's "soft" contact).
constexpr double soft_rule = 0.5;

struct Side {
  double stiffness = 0.0, mass = 0.0;  // N/m, kg
};

// Mass that a force on a point moves: 1/m is the sum of t^2/m over its nodes.
double mass_of(const SideTrace& trace, int point, const Piece& piece) {
  double inverse = 0.0;
  for (int k = 0; k < trace.n_shares(point); ++k) {
    const SideTrace::Share& share = trace.share(point, k);
    inverse += share.weight * share.weight / piece.node_masses()[share.node];
  }
  return 1.0 / inverse;
}

// K A^2 / V of the layer of cells behind the nodes of one side of a point (Hallquist's rule), and their mass.
Side side_of(const StepModel& model, const Point& point, int side) {
  Side sum;
  for (const Member& member : point.members) {
    const Surface& surface = (*model.surfaces)[member.surface];
    const int part = side == 1 ? surface.part_1 : surface.part_2;
    const SideTrace& trace = side == 1 ? surface.facing.side_1 : surface.facing.side_2;
    const Elastic& material = model.problem->substructures[part]->material;
    const double bulk = material.tensor().bulk_modulus();
    const double area = surface.facing.areas[member.point], mass = mass_of(trace, member.point, *model.pieces[part]);
    // A node on a face has half of the volume of the cells behind its area.
    sum.stiffness += bulk * area * area / (2 * mass / material.density);
    sum.mass += mass;
  }
  return sum;
}

// N/m, of the cells behind a point.
double stiffness_behind(const StepModel& model, const Point& point, double critical) {
  const Side side_1 = side_of(model, point, 1);
  if (point.is_wall) return side_1.stiffness;
  const Side side_2 = side_of(model, point, 2);
  const double mass = side_1.mass * side_2.mass / (side_1.mass + side_2.mass);
  return std::max(std::min(side_1.stiffness, side_2.stiffness), soft_rule * mass / (critical * critical));
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
    const ExplicitForm form = point.law->explicit_form();
    if (!form.springs) continue;
    const auto nodes_of = [&](int i_port) {
      const Port& port = model.exchange.ports[i_port];
      std::vector<MovedNode> nodes;
      port.for_each_node([&](int node, const Mat3& block) {
        nodes.push_back({internal.first(port.part) + 3 * node, port.trace ? block : Mat3(Mat3::Identity())});
      });
      return nodes;
    };
    Spring spring;
    spring.point = static_cast<int>(i);
    if (!model.exchange.ports[point.first_port].trace) {
      spring.dof_1 = nodes_of(point.first_port)[0].dof;
      spring.dof_2 = point.is_wall ? -1 : nodes_of(point.first_port_2)[0].dof;
    } else {
      spring.side_1 = nodes_of(point.first_port);
      spring.side_2 = nodes_of(point.first_port_2);
    }
    spring.form = form.springs;
    spring.frame = point.frame;
    SpringPoint& at = spring.at;
    at.area = point.area;
    at.stiffness = spring.form->stiffness(point.area, stiffness_behind(model, point, 2.0 / frequency), penalty);
    for (int d = 0; d < 3; ++d)
      if (!point.has_law[d]) at.stiffness[d] = 0.0;
    at.start = at.now = start[i].law;
    spring.form->begin(at);
    springs_.push_back(std::move(spring));
  }
}

double PenaltySprings::release(const StepModel& model, int increment) {
  double lost = 0.0;
  for (Spring& spring : springs_) {
    const Interface* interface =
        (*model.surfaces)[model.exchange.points[spring.point].members.front().surface].interface;
    if (spring.is_released || !interface || !model.loads->is_released(interface, increment)) continue;
    const Point& point = model.exchange.points[spring.point];
    LawState& now = spring.at.now;
    lost += spring.form->penalty_energy(spring.at);
    spring.is_released = true;
    now.force.setZero();
    now.status = PointState::open;
    point.law->let_go(now);
  }
  return lost;
}

Vec3 PenaltySprings::jump_of(const Spring& spring, const Vec& displacement) const {
  if (!spring.side_1.empty()) {
    Vec3 jump = Vec3::Zero();
    for (const MovedNode& node : spring.side_1) jump -= node.block * displacement.segment<3>(node.dof);
    for (const MovedNode& node : spring.side_2) jump += node.block * displacement.segment<3>(node.dof);
    return spring.frame.transpose() * jump;
  }
  Vec3 jump = -displacement.segment<3>(spring.dof_1);
  if (spring.dof_2 >= 0) jump += displacement.segment<3>(spring.dof_2);
  return spring.frame.transpose() * jump;
}

void PenaltySprings::put(const Spring& spring, const Vec3& force, Vec& all) {
  const Vec3 f = spring.frame * force;
  for (const MovedNode& node : spring.side_1) all.segment<3>(node.dof) -= node.block.transpose() * f;
  for (const MovedNode& node : spring.side_2) all.segment<3>(node.dof) += node.block.transpose() * f;
  if (!spring.side_1.empty()) return;
  all.segment<3>(spring.dof_1) -= f;
  if (spring.dof_2 >= 0) all.segment<3>(spring.dof_2) += f;
}

void PenaltySprings::add_force(const Vec& displacement, Vec& force) {
  for (Spring& spring : springs_) {
    if (spring.is_released) continue;
    const Vec3 jump = jump_of(spring, displacement);
    spring.form->move(spring.at, jump);
    spring.at.jump = jump;
    if (!spring.at.now.force.isZero(0.0)) put(spring, spring.at.now.force, force);
  }
}

void PenaltySprings::add_closed_force(const Vec& displacement, Vec& force) const {
  for (const Spring& spring : springs_)
    put(spring, spring.at.stiffness.cwiseProduct(jump_of(spring, displacement)), force);
}

void PenaltySprings::weigh(double weight) {
  for (Spring& spring : springs_) {
    spring.sum += weight * spring.at.now.force;
    spring.weight += weight;
  }
}

double PenaltySprings::energy() const {
  double sum = 0.0;
  for (const Spring& spring : springs_) sum += spring.form->penalty_energy(spring.at);
  return sum;
}

void PenaltySprings::show(const StepModel& model, std::vector<PointRecord>& records, State& state) {
  for (Spring& spring : springs_) {
    const Point& point = model.exchange.points[spring.point];
    PointRecord& record = records[spring.point];
    LawState law = spring.at.now;
    law.force = spring.sum / spring.weight;
    law.rate = record.law.rate;
    Work work;
    work.friction = spring.at.friction_work;
    work.plastic = spring.form->plastic_work(law, point.area) - spring.form->plastic_work(record.law, point.area);
    work.stored = spring.form->stored_energy(law, point.area) - spring.form->stored_energy(record.law, point.area);
    if (spring.is_released) work.damping = -work.stored;
    book_dissipation(point, work, state);
    record.law = std::move(law);
    record.is_released = spring.is_released;
    show_point(point, record, state);
    spring.sum.setZero();
    spring.weight = spring.at.friction_work = 0.0;
  }
}

void PenaltySprings::keep(const StepModel& model, std::vector<PointRecord>& records, State& state) const {
  for (const Spring& spring : springs_) {
    PointRecord& record = records[spring.point];
    record.law.force = spring.at.now.force;
    show_point(model.exchange.points[spring.point], record, state);
  }
}

}  // namespace dygita
