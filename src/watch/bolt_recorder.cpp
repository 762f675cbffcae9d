#include "watch/bolt_recorder.hpp"

#include <algorithm>
#include <cmath>

namespace dygita {

namespace {

struct Tightened {
  Tightening by;
  bool is_to_force = false;
};

// What tightens an interface in a step, if something does.
std::optional<Tightened> tightened(const Step& step, const Interface* interface) {
  for (const LoadPtr& load : step.loads)
    for (const Effect& effect : load->effects())
      if (const Tightening* by = tightening(effect); by && by->on.get() == interface)
        return Tightened{*by, std::holds_alternative<PreloadForce>(effect)};
  return std::nullopt;
}

}  // namespace

BoltRecorder::BoltRecorder(const Problem& problem) {
  for (size_t i = 0; i < problem.interfaces.size(); ++i) {
    const Interface* interface = problem.interfaces[i].get();
    if (std::none_of(problem.steps.begin(), problem.steps.end(),
                     [&](const StepPtr& step) { return tightened(*step, interface).has_value(); }))
      continue;
    surfaces_.push_back(static_cast<int>(i));
    interfaces_.push_back(interface);
    bolts_.emplace_back();
    bolts_.back().name = interface->name;
  }
  now_.resize(bolts_.size());
  before_ = tightened_ = now_;
  swing_.resize(bolts_.size());
}

BoltRecorder::Held BoltRecorder::held(const Instant& instant, int surface) {
  const Surface& on = (*instant.model.surfaces)[surface];
  Held held;
  for (int i = 0; i < on.n_points(); ++i) {
    const LawState& point = instant.surface(surface).points[i];
    held.force += point.force.dot(on.facing.normals.col(i));
    held.opening += point.plastic_opening * on.facing.areas[i];
  }
  held.opening /= on.facing.areas.sum();
  held.shortening = instant.state.shortening[surface];
  return held;
}

void BoltRecorder::begin_step(const Instant& start) {
  for (size_t b = 0; b < bolts_.size(); ++b) {
    now_[b] = held(start, surfaces_[b]);
    if (start.i_step == 0) bolts_[b].area = (*start.model.surfaces)[surfaces_[b]].facing.areas.sum();
    if (start.is_static() || is_dynamic_) continue;
    if (bolts_[b].tightened != 0.0) {
      bolts_[b].before_motion = now_[b].force;
      bolts_[b].yielded_before = now_[b].opening - tightened_[b].opening;
    }
    // Shocks count from the force before them.
    bolts_[b].lowest = bolts_[b].highest = now_[b].force;
  }
  is_dynamic_ = is_dynamic_ || !start.is_static();
}

// What a step that tightens was asked for, and what it made.
void BoltRecorder::note_tightening(size_t b, const Tightening& by, bool is_to_force, int increments) {
  BoltSummary& bolt = bolts_[b];
  bolt.tightened = bolt.last;
  tightened_[b] = now_[b];
  // Contacts are closed by the last increment: its slope is the bolt's in the joint.
  const double gained = now_[b].force - before_[b].force,
               shortened = now_[b].shortening - now_[b].opening - before_[b].shortening + before_[b].opening;
  bolt.stiffness.reset();
  if (gained * shortened > 0.0) bolt.stiffness = gained / shortened;
  bolt.target.reset();
  if (is_to_force) bolt.target = LoadValue{by.value, 0.0}.at_static(increments - 1, increments);
  if (!by.hand && !bolt.formula) return;
  if (by.hand) bolt.formula = {bolt_resilience(*by.hand), by.share};
  // Of the whole bolt, which the model has a share of.
  const double compliance = bolt.formula->resilience.sum() / bolt.formula->share;
  bolt.formula->shortening = bolt.target.value_or(bolt.tightened) * compliance;
  bolt.hand = bolt.shortening / compliance;
}

void BoltRecorder::follow_motion(const Instant& instant, size_t b, double force) {
  BoltSummary& bolt = bolts_[b];
  bolt.lowest = std::min(bolt.lowest, force);
  bolt.highest = std::max(bolt.highest, force);
  const int n = instant.model.step->n_increments(), first = n - std::max(1, n / 10);
  if (instant.increment < first) return;
  auto& [low, high] = swing_[b];
  low = instant.increment == first ? force : std::min(low, force);
  high = instant.increment == first ? force : std::max(high, force);
  bolt.swing = 0.5 * (high - low);
}

void BoltRecorder::accept(const Instant& instant) {
  const Step& step = *instant.model.step;
  for (size_t b = 0; b < bolts_.size(); ++b) {
    BoltSummary& bolt = bolts_[b];
    before_[b] = now_[b];
    now_[b] = held(instant, surfaces_[b]);
    bolt.last = now_[b].force;
    bolt.shortening = now_[b].shortening;
    bolt.yielded = now_[b].opening - tightened_[b].opening;
    bolt.plastic_opening = 0.0;
    for (const LawState& point : instant.surface(surfaces_[b]).points)
      bolt.plastic_opening = std::max(bolt.plastic_opening, std::abs(point.plastic_opening));
    if (!instant.is_static()) follow_motion(instant, b, bolt.last);
    if (!is_dynamic_) bolt.lowest = bolt.highest = bolt.last;
    if (instant.is_static()) bolt.swing = 0.0;
    if (!instant.is_static() || instant.increment + 1 < step.increments) continue;
    bolt.after_static.push_back(bolt.last);
    if (const auto now = tightened(step, interfaces_[b])) {
      note_tightening(b, now->by, now->is_to_force, step.increments);
      bolt.yielded = 0.0;
    }
  }
}

}  // namespace dygita
