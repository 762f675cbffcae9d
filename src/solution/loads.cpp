#include "solution/loads.hpp"

#include <algorithm>

#include "mesh/facing.hpp"

namespace dygita {

namespace {

// Nodal forces of a unit pressure, traction component or total force.
std::vector<std::pair<int, Vec3>> unit_pattern(LoadKind kind, const Target& target, int component) {
  std::vector<std::pair<int, Vec3>> pattern;
  const Vec3 axis = Vec3::Unit(component);
  if (const auto* region = std::get_if<Region>(&target)) {
    for (const int node : region->nodes) pattern.emplace_back(node, axis / static_cast<double>(region->nodes.size()));
    return pattern;
  }
  const Face& face = std::get<Face>(target);
  const FaceNodes on = face_nodes(*face.part->mesh, face.facets());
  const double total = on.areas.sum();
  for (size_t i = 0; i < on.nodes.size(); ++i) {
    Vec3 force = on.areas[i] * axis;
    if (kind == LoadKind::pressure) force = -on.areas[i] * on.normals.col(i);
    if (kind == LoadKind::force) force = on.areas[i] / total * axis;
    pattern.emplace_back(on.nodes[i], force);
  }
  return pattern;
}

int part_of(const Problem& problem, const Target& target) {
  if (const auto* face = std::get_if<Face>(&target)) return index_of(problem.substructures, face->part.get());
  return index_of(problem.substructures, std::get<Region>(target).part.get());
}

bool is_force(LoadKind kind) {
  return kind == LoadKind::pressure || kind == LoadKind::traction || kind == LoadKind::force ||
         kind == LoadKind::gravity;
}

// Gravity acts on every part: its pattern is the mass.
const std::string gravity_key = "gravity ";

}  // namespace

Loads::Loads(const Problem& problem, const Step& step, const State& start, const std::vector<const Vec*>& masses)
    : problem_(problem), step_(step) {
  const auto from = [&](const std::string& key) {
    const auto it = start.reached.find(key);
    return it == start.reached.end() ? 0.0 : it->second;
  };
  const auto add_gravity = [&](int component, const LoadValue& value) {
    for (size_t part = 0; part < masses.size(); ++part) {
      LoadPattern pattern{static_cast<int>(part), {}, value, gravity_key + std::to_string(component)};
      for (int node = 0; node < masses[part]->size(); ++node)
        pattern.nodes.emplace_back(node, (*masses[part])[node] * Vec3::Unit(component));
      patterns_.push_back(std::move(pattern));
    }
  };
  for (const LoadPtr& load : step.loads) {
    for (int c = 0; c < 3; ++c) {
      if (!load->value[c]) continue;
      if (load->kind == LoadKind::gravity)
        add_gravity(c, {*load->value[c], load->is_number[c], from(gravity_key + std::to_string(c))});
      for (const Target& target : load->on) add_component(*load, target, c, start);
    }
  }
  if (!step.is_static) return;
  add_vanished(start);
  for (int c = 0; c < 3; ++c) {
    const std::string key = gravity_key + std::to_string(c);
    const bool listed = std::any_of(patterns_.begin(), patterns_.end(), [&](const auto& p) { return p.key == key; });
    if (!listed && from(key) != 0.0) add_gravity(c, {History::constant(0.0), true, from(key)});
  }
}

void Loads::add_component(const Load& load, const Target& target, int component, const State& start) {
  const std::string key = load_key(load.kind, target, component);
  const auto it = start.reached.find(key);
  const LoadValue value{*load.value[component], load.is_number[component],
                        it == start.reached.end() ? 0.0 : it->second};
  if (is_force(load.kind)) {
    patterns_.push_back({part_of(problem_, target), unit_pattern(load.kind, target, component), value, key});
  } else if (load.kind == LoadKind::shortening) {
    const Interface* interface = std::get<InterfacePtr>(target).get();
    // The bolt keeps the length its last step gave it: a later shortening starts from there. Interfaces are the first
    // surfaces.
    LoadValue from_there = value;
    from_there.from = start.shortening.at(index_of(problem_.interfaces, interface));
    shortenings_.emplace_back(interface, from_there);
  } else if (load.kind == LoadKind::preload) {
    preloads_.emplace_back(std::get<InterfacePtr>(target).get(), value);
  } else if (load.kind == LoadKind::release) {
    releases_.emplace_back(std::get<InterfacePtr>(target).get(), load.value[component]->value(0.0));
  } else if (load.kind == LoadKind::displacement) {
    motions_reached_[key] =
        step_.is_static ? value.at_static(step_.increments - 1, step_.increments) : value.history.value(step_.duration);
  }
}

// A load of the step before that is no longer listed is taken off along the same ramp.
void Loads::add_vanished(const State& start) {
  int i_step = -1;
  for (size_t i = 0; i < problem_.steps.size(); ++i)
    if (problem_.steps[i].get() == &step_) i_step = static_cast<int>(i);
  if (i_step <= 0) return;
  for (const LoadPtr& load : problem_.steps[i_step - 1]->loads)
    for (int c = 0; c < 3; ++c) {
      if (!load->value[c] || !is_force(load->kind)) continue;
      for (const Target& target : load->on) {
        const std::string key = load_key(load->kind, target, c);
        const auto it = start.reached.find(key);
        const bool listed =
            std::any_of(patterns_.begin(), patterns_.end(), [&](const auto& p) { return p.key == key; });
        if (listed || it == start.reached.end() || it->second == 0.0) continue;
        patterns_.push_back({part_of(problem_, target),
                             unit_pattern(load->kind, target, c),
                             {History::constant(0.0), true, it->second},
                             key});
      }
    }
}

void Loads::evaluate(int increment) {
  values_.clear();
  for (const LoadPattern& pattern : patterns_)
    values_.push_back(step_.is_static ? pattern.value.at_static(increment, step_.increments)
                                      : pattern.value.mean(step_.dt * increment, step_.dt * (increment + 1)));
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

std::map<std::string, double> Loads::reached() const {
  std::map<std::string, double> values = motions_reached_;
  for (const LoadPattern& pattern : patterns_)
    values[pattern.key] = step_.is_static ? pattern.value.at_static(step_.increments - 1, step_.increments)
                                          : pattern.value.history.value(step_.duration);
  return values;
}

}  // namespace dygita
