#include "reference/inertial_laws.hpp"

#include <algorithm>
#include <map>

#include "law/law.hpp"

namespace dygita {

namespace {

// Points that share a node see each other: swept over until nothing changes. One that shares none is exact at once.
constexpr int most_sweeps = 200;
constexpr double unchanged = 1e-13;  // of the largest force

[[noreturn]] void refuse(const StepModel& model, const Point& point) {
  const Interface& interface = *(*model.surfaces)[point.members.front().surface].interface;
  throw InputError(interface.origin, "interface." + interface.law->word() + " '" + interface.name +
                                         "': solver.explicit supports this law only where the meshes of both faces "
                                         "match; use solver.latin, or matching meshes");
}

}  // namespace

InertialLaws::InertialLaws(const StepModel& model, const std::vector<PointRecord>& start, const InternalForce& internal,
                           const SharedNodes& shared)
    : all_(&model.exchange.points) {
  std::map<std::pair<bool, int>, int> known;  // by group, or by dof
  const auto mover_of = [&](int i_port) {
    const Port& port = model.exchange.ports[i_port];
    const int dof = internal.first(port.part) + 3 * port.node, group = shared.group_of(dof);
    const auto [it, is_new] =
        known.emplace(std::pair{group >= 0, group >= 0 ? group : dof}, static_cast<int>(movers_.size()));
    if (is_new) movers_.push_back({dof});
    return it->second;
  };
  for (size_t i = 0; i < all_->size(); ++i) {
    const Point& point = (*all_)[i];
    if (!point.law || start[i].is_released) continue;
    const ExplicitForm form = point.law->explicit_form();
    if (!form.rates) continue;
    if (model.exchange.ports[point.first_port].trace) refuse(model, point);
    InertialPoint& at = points_.emplace_back();
    at.point = static_cast<int>(i);
    at.law = form.rates;
    at.has_springs = form.springs != nullptr;
    at.side_1 = mover_of(point.first_port);
    if (!point.is_wall) at.side_2 = mover_of(point.first_port_2);
    at.is_given = start[i].trial.is_given;
    for (int d = 0; d < 3; ++d) at.is_active[d] = point.has_law[d] && point.is_active[d] && !at.is_given[d];
    at.start = start[i].law;
  }
}

void InertialLaws::release(const StepModel& model, int increment) {
  for (InertialPoint& at : points_) {
    const Interface* interface = (*model.surfaces)[(*all_)[at.point].members.front().surface].interface;
    if (!interface || !model.loads->is_released(interface, increment)) continue;
    at.is_released = true;
    at.force.setZero();
    if (!at.has_springs) at.law->let_go(at.start);
  }
}

// Velocities after the kick without the forces to be found, and what these change.
void InertialLaws::find_movers(const Kick& kick, const SharedNodes& shared, const Vec& inverse_mass,
                               const Vec& velocity, const Vec& internal) {
  for (Mover& mover : movers_) {
    mover.before = velocity.segment<3>(mover.dof);
    if (const int group = shared.group_of(mover.dof); group >= 0) {
      mover.now = shared.velocity_after(group, kick, internal, velocity);
      mover.mobility = shared.mobility(group, kick);
    } else {
      const double per_force = kick.tau * inverse_mass[mover.dof];
      mover.now = mover.before + per_force * (kick.external.segment<3>(mover.dof) - internal.segment<3>(mover.dof));
      mover.mobility = per_force * Mat3::Identity();
    }
  }
}

void InertialLaws::push(const InertialPoint& at, const Vec3& force) {
  const Vec3 f = (*all_)[at.point].frame * force;
  movers_[at.side_1].now += movers_[at.side_1].mobility * f;
  if (at.side_2 >= 0) movers_[at.side_2].now -= movers_[at.side_2].mobility * f;
}

Vec3 InertialLaws::rate(const InertialPoint& at, Vec3 Mover::*velocity) const {
  Vec3 rate = -(movers_[at.side_1].*velocity);
  if (at.side_2 >= 0) rate += movers_[at.side_2].*velocity;
  return (*all_)[at.point].frame.transpose() * rate;
}

// At fixed forces of all other points.
Trial InertialLaws::trial_at(const InertialPoint& at) const {
  const Point& point = (*all_)[at.point];
  Mat3 mobility = movers_[at.side_1].mobility;
  if (at.side_2 >= 0) mobility += movers_[at.side_2].mobility;
  const Vec3 now = rate(at, &Mover::now);
  Trial trial;
  trial.area = point.area;
  trial.is_given = at.is_given;
  for (int d = 0; d < 3; ++d) {
    if (at.is_given[d]) trial.s[d] = now[d];
    if (!at.is_active[d]) continue;
    trial.y[d] = point.frame.col(d).dot(mobility * point.frame.col(d));
    trial.s[d] = now[d] + trial.y[d] * at.force[d];
  }
  return trial;
}

// The law at each point in turn; returns the largest change of a force, of the largest force.
double InertialLaws::sweep(const Increment& increment) {
  double change = 0.0, largest = 0.0;
  for (InertialPoint& at : points_) {
    if (at.is_released) continue;
    const Trial trial = trial_at(at);
    at.start.rate = rate(at, &Mover::before);
    const Vec3 force = at.law->force(trial, increment, at.start);
    push(at, force - at.force);
    change = std::max(change, (force - at.force).cwiseAbs().maxCoeff());
    largest = std::max(largest, force.cwiseAbs().maxCoeff());
    at.force = force;
  }
  return largest > 0.0 ? change / largest : 0.0;
}

void InertialLaws::put(int dof, const Vec3& force, Vec& internal) {
  replaced_.emplace_back(dof, internal.segment<3>(dof));
  internal.segment<3>(dof) += force;
}

void InertialLaws::add_force(const Kick& kick, const SharedNodes& shared, const Vec& inverse_mass, const Vec& velocity,
                             Vec& internal) {
  if (points_.empty()) return;
  find_movers(kick, shared, inverse_mass, velocity, internal);
  for (const InertialPoint& at : points_) push(at, at.force);  // a first guess: those of the kick before
  const Increment increment{TimeScheme::weighted(kick.tau, 1.0 - kick.theta)};
  for (int i = 0; i < most_sweeps && sweep(increment) > unchanged; ++i) {
  }
  const Increment mean{TimeScheme::implicit(kick.tau)};
  for (InertialPoint& at : points_) {
    const Point& point = (*all_)[at.point];
    LawState end = at.is_released ? at.start : at.law->advance(trial_at(at), increment, at.start, at.force);
    end.rate = rate(at, &Mover::now);
    end.force = at.force;
    const Work work = at.law->work(at.start, end, mean, point.area);
    at.work.friction += work.friction;
    at.work.plastic += work.plastic;
    at.work.damping += work.damping;
    at.work.stored += work.stored;
    at.start = std::move(end);
    at.impulse += kick.tau * at.force;
    const Vec3 f = point.frame * at.force;
    put(movers_[at.side_1].dof, -f, internal);
    if (at.side_2 >= 0) put(movers_[at.side_2].dof, f, internal);
  }
}

void InertialLaws::remove_force(Vec& internal) {
  for (auto it = replaced_.rbegin(); it != replaced_.rend(); ++it) internal.segment<3>(it->first) = it->second;
  replaced_.clear();
}

void InertialLaws::show(const StepModel& model, double dt, std::vector<PointRecord>& records, State& state) {
  for (InertialPoint& at : points_) {
    const Point& point = model.exchange.points[at.point];
    PointRecord& record = records[at.point];
    if (!at.has_springs) {
      record.law = at.start;
      record.law.force.setZero();
    }
    record.law.force += at.impulse / dt;
    record.law.rate = rate(at, &Mover::now);
    record.is_released = at.is_released;
    book_dissipation(point, at.work, state);
    show_point(point, record, state);
    at.impulse.setZero();
    at.work = {};
  }
}

void InertialLaws::keep(const StepModel& model, const std::vector<PointRecord>& records, State& state) const {
  for (const InertialPoint& at : points_) {
    PointRecord record = records[at.point];
    if (at.has_springs)
      record.law.force += at.force;
    else
      record.law.force = at.force;
    show_point(model.exchange.points[at.point], record, state);
  }
}

double InertialLaws::bytes() const {
  return static_cast<double>(movers_.size() * sizeof(Mover) + points_.size() * sizeof(InertialPoint));
}

}  // namespace dygita
