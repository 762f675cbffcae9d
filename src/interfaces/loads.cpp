#include "interfaces/loads.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "base/overloaded.hpp"
#include "meeting/facing.hpp"

namespace dygita {

namespace {

int part_of(const Problem& problem, const FaceOrRegion& on) {
  return std::visit([&](const auto& place) { return index_of(problem.substructures, place.part.get()); }, on);
}

double value_reached(const State& state, const std::string& key) {
  const auto it = state.reached.find(key);
  return it == state.reached.end() ? 0.0 : it->second;
}

// Key of the size of the forces that a value of one has been.
std::string size_key(const std::string& key) { return key + " size"; }

// The value that brings the forces of a load whose forces for a value of one are now of this size.
double value_reached(const State& state, const std::string& key, double size) {
  const auto before = state.reached.find(size_key(key));
  const double share = before == state.reached.end() || before->second == size ? 1.0 : before->second / size;
  return share * value_reached(state, key);
}

}  // namespace

NodesUnderLoad nodes_under_load(const FaceOrRegion& on) {
  NodesUnderLoad result;
  if (const auto* region = std::get_if<Region>(&on)) {
    const auto n = static_cast<int>(region->nodes.size());
    result.nodes = region->nodes;
    result.loaded = {Points(3, n), Vec::Ones(n), Points::Zero(3, n), Points::Zero(3, n)};
  } else {
    const Face& face = std::get<Face>(on);
    FaceNodes nodes = face_nodes(*face.part->mesh, face.facets());
    result.loaded = {Points(3, nodes.areas.size()), std::move(nodes.weights), std::move(nodes.vectors),
                     std::move(nodes.moments)};
    result.nodes = std::move(nodes.nodes);
  }
  const Substructure& part = *std::visit([](const auto& place) { return place.part; }, on);
  for (size_t i = 0; i < result.nodes.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    result.loaded.positions.col(k) = part.mesh->nodes.col(result.nodes[i]) + part.place;
    if (std::holds_alternative<Region>(on))
      result.loaded.moments.col(k) = result.loaded.positions.col(k);
    else
      result.loaded.moments.col(k) += result.loaded.weights[k] * part.place;
  }
  return result;
}

Loads::Loads(const Problem& problem, const Step& step, const State& start, const InertiaForce& inertia,
             const InertiaForce& of_static_steps)
    : problem_(problem), step_(step) {
  for (const LoadPtr& load : step.loads)
    for (const Effect& effect : load->effects())
      std::visit(overloaded{[&](const NodalForces& forces) { add(forces, forces.value, start); },
                            [&](const BodyForce& force) {
                              const LoadValue value{force.value, value_reached(start, force.name)};
                              add(force, value, force.name, inertia);
                            },
                            [&](const PrescribedMotion& motion) { note_reached(motion, start); },
                            [&](const Shortening& shortening) { add(shortening, start); },
                            [&](const PreloadForce& preload) {
                              preloads_.emplace_back(preload.on.get(), LoadValue{preload.value, 0.0});
                            },
                            [&](const Release& release) { releases_.emplace_back(release.on.get(), release.at); },
                            Ignored<BaseMotion>()},  // moves with the conditions
                 effect);
  if (step.is_static) add_vanished(start, inertia);
  if (of_static_steps) keep_as_laid(inertia, of_static_steps);
}

void Loads::add(const NodalForces& forces, const TimeValue& value, const State& start) {
  const std::string key = force_key(forces.name, forces.on);
  const NodesUnderLoad on = nodes_under_load(forces.on);
  const Points unit = forces.unit(on.loaded);
  const double size = unit.colwise().norm().sum();
  LoadPattern pattern{part_of(problem_, forces.on), {}, {value, value_reached(start, key, size)}, key, size};
  const Interior& inside = *problem_.substructures[static_cast<size_t>(pattern.part)]->mesh->inside;
  for (size_t i = 0; i < on.nodes.size(); ++i) {
    const Vec3 f = unit.col(static_cast<int>(i));
    const Interior::Follower* own = inside.follower(on.nodes[i]);
    pattern.nodes.emplace_back(own ? own->point : on.nodes[i], f);
    if (own && own->turn >= 0) pattern.nodes.emplace_back(own->turn, own->arm.cross(f) / own->size);
  }
  patterns_.push_back(std::move(pattern));
}

void Loads::add(const BodyForce& force, const LoadValue& value, const std::string& key, const InertiaForce& inertia) {
  for (size_t i = 0; i < problem_.substructures.size(); ++i) {
    const Substructure& part = *problem_.substructures[i];
    LoadPattern pattern{static_cast<int>(i), {}, value, key, 0.0};
    const auto at = [&](const Vec3& x) -> Vec3 { return force.unit(x + part.place); };
    const Points unit = inertia(static_cast<int>(i), part.mesh->inside->acceleration(part.mesh->nodes, at));
    if (unit.isZero(0.0)) continue;
    for (int node = 0; node < part.mesh->n_nodes(); ++node) pattern.nodes.emplace_back(node, unit.col(node));
    patterns_.push_back(std::move(pattern));
  }
}

void Loads::add(const Shortening& shortening, const State& start) {
  const Interface* interface = shortening.on.get();
  // The bolt keeps the length its last step gave it: a later shortening starts from there. Interfaces are the first
  // surfaces.
  shortenings_.emplace_back(interface,
                            LoadValue{shortening.value, start.shortening.at(index_of(problem_.interfaces, interface))});
}

void Loads::note_reached(const PrescribedMotion& motion, const State& start) {
  if (motion.is_velocity) return;
  for (int axis = 0; axis < 3; ++axis) {
    if (!motion.along[axis]) continue;
    const std::string key = motion_key(motion.name_along(axis), motion.on);
    const LoadValue value{*motion.along[axis], value_reached(start, key)};
    motions_reached_[key] =
        step_.is_static ? value.at_static(step_.increments - 1, step_.increments) : value.history.value(step_.duration);
  }
}

// A force of the step before that is no longer listed is taken off along the same ramp.
void Loads::add_vanished(const State& start, const InertiaForce& inertia) {
  const int i_step = index_of(problem_.steps, &step_);
  if (i_step <= 0) return;
  const TimeValue nothing{History::constant(0.0), true};
  const auto has_vanished = [&](const std::string& key) {
    return value_reached(start, key) != 0.0 &&
           std::none_of(patterns_.begin(), patterns_.end(), [&](const auto& pattern) { return pattern.key == key; });
  };
  std::vector<NodalForces> nodal_forces;
  std::vector<BodyForce> body_forces;
  for (const LoadPtr& load : problem_.steps[i_step - 1]->loads)
    for (const Effect& effect : load->effects())
      std::visit(overloaded{[&](const NodalForces& forces) { nodal_forces.push_back(forces); },
                            [&](const BodyForce& force) { body_forces.push_back(force); },
                            Ignored<PrescribedMotion, BaseMotion, Shortening, PreloadForce, Release>()},
                 effect);
  for (const NodalForces& forces : nodal_forces)
    if (has_vanished(force_key(forces.name, forces.on))) add(forces, nothing, start);
  for (const BodyForce& force : body_forces)
    if (has_vanished(force.name)) add(force, {nothing, value_reached(start, force.name)}, force.name, inertia);
}

// What the last static step has balanced cell by cell stays in balance where this one's mass is spread in another way,
// and goes as gravity goes.
void Loads::keep_as_laid(const InertiaForce& inertia, const InertiaForce& of_static_steps) {
  int last = index_of(problem_.steps, &step_) - 1;
  while (last >= 0 && !problem_.steps[static_cast<size_t>(last)]->is_static) --last;
  if (last < 0) return;
  std::set<std::string> laid;
  for (const LoadPtr& load : problem_.steps[static_cast<size_t>(last)]->loads)
    for (const Effect& effect : load->effects())
      if (const auto* force = std::get_if<BodyForce>(&effect)) laid.insert(force->name);
  for (const LoadPtr& load : step_.loads)
    for (const Effect& effect : load->effects())
      if (const auto* force = std::get_if<BodyForce>(&effect); force && laid.count(force->name) > 0)
        add(*force, {force->value, 0.0}, "", [&](int part, const Points& acceleration) {
          return Points(of_static_steps(part, acceleration) - inertia(part, acceleration));
        });
}

void Loads::evaluate(int increment) {
  values_.clear();
  for (size_t i = 0; i + opposed_.motions.size() < patterns_.size(); ++i) {
    const LoadValue& value = patterns_[i].value;
    values_.push_back(step_.is_static ? value.at_static(increment, step_.increments)
                                      : value.mean(step_.dt * increment, step_.dt * (increment + 1)));
  }
  if (opposed_.motions.empty()) return;
  const Vec of_motions = accelerations();
  for (const int motion : opposed_.motions) values_.push_back(-of_motions[motion]);
}

void Loads::oppose(const std::vector<std::vector<Points>>& inertia, Mat accelerations) {
  CHECK(step_.is_static && opposed_.motions.empty(), "inertia opposes the loads of a static step, once");
  opposed_.accelerations = std::move(accelerations);
  for (size_t motion = 0; motion < inertia.size(); ++motion)
    for (size_t part = 0; part < inertia[motion].size(); ++part) {
      const Points& unit = inertia[motion][part];
      if (unit.isZero(0.0)) continue;
      LoadPattern pattern{static_cast<int>(part), {}, {{History::constant(0.0), true}, 0.0}, "", 0.0};
      for (int node = 0; node < unit.cols(); ++node) pattern.nodes.emplace_back(node, unit.col(node));
      patterns_.push_back(std::move(pattern));
      opposed_.motions.push_back(static_cast<int>(motion));
    }
}

Vec Loads::accelerations() const {
  return opposed_.accelerations *
         Eigen::Map<const Vec>(values_.data(), static_cast<Eigen::Index>(opposed_.accelerations.cols()));
}

void Loads::evaluate_mean(double t0, double t1) {
  values_.clear();
  for (const LoadPattern& pattern : patterns_) values_.push_back(pattern.value.mean(t0, t1));
}

void Loads::add_forces(int part, Points& force) const {
  for (size_t i = 0; i < values_.size(); ++i) {
    if (patterns_[i].part != part || values_[i] == 0.0) continue;
    for (const auto& [node, unit] : patterns_[i].nodes) force.col(node) += values_[i] * unit;
  }
}

double Loads::shortening(const Interface* interface, double had, int increment) const {
  double d = had;
  for (const auto& [on, value] : shortenings_) {
    if (on != interface || !step_.is_static) continue;
    d = value.at_static(increment, step_.increments);
  }
  return d;
}

const LoadValue* Loads::preload(const Interface* interface) const {
  for (const auto& [on, value] : preloads_)
    if (on == interface) return &value;
  return nullptr;
}

bool Loads::is_released(const Interface* interface, int increment) const {
  for (const auto& [on, at] : releases_)
    if (on == interface &&
        (step_.is_static ? (increment + 1.0) / step_.increments : step_.dt * (increment + 0.5)) >= at)
      return true;
  return false;
}

bool Loads::is_released_in_step(const Interface* interface) const {
  return std::any_of(releases_.begin(), releases_.end(),
                     [&](const auto& release) { return release.first == interface; });
}

std::map<std::string, double> Loads::reached() const {
  std::map<std::string, double> values = motions_reached_;
  for (const LoadPattern& pattern : patterns_) {
    if (pattern.key.empty()) continue;
    values[pattern.key] = step_.is_static ? pattern.value.at_static(step_.increments - 1, step_.increments)
                                          : pattern.value.history.value(step_.duration);
    if (pattern.size > 0.0) values[size_key(pattern.key)] = pattern.size;
  }
  return values;
}

}  // namespace dygita
