#include "watch/bolt_recorder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/error.hpp"
#include "law/law.hpp"

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
    ratings_.emplace_back();
    is_whole_.push_back(1);
    for (size_t i_step = 0; i_step < problem.steps.size(); ++i_step)
      if (const auto now = tightened(*problem.steps[i_step], interface)) {
        last_tightening_ = std::max(last_tightening_, static_cast<int>(i_step));
        if (!now->by.rating) continue;
        ratings_.back() = now->by.rating;
        bolts_.back().margins.emplace();
        bolts_.back().margins->proof_load = now->by.share * now->by.rating->proof_load;
        bolts_.back().margins->safety = now->by.rating->safety;
        is_whole_.back() = now->by.share >= 1.0;
      }
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

// Each point of a contact goes with the nearest of the axes of the bolts that clamp it.
void BoltRecorder::find_clamped(const Instant& start) {
  struct Axis {
    Vec3 place, along;
  };
  std::map<int, std::vector<std::pair<size_t, Axis>>> bolts_of;  // by surface
  for (size_t b = 0; b < bolts_.size(); ++b) {
    if (!ratings_[b]) continue;
    const Facing& shank = (*start.model.surfaces)[static_cast<size_t>(surfaces_[b])].facing;
    const Axis axis{shank.places * shank.areas / shank.areas.sum(), (shank.normals * shank.areas).normalized()};
    for (const InterfacePtr& contact : ratings_[b]->joint) {
      const int surface = index_of(start.model.problem->interfaces, contact.get());
      if (surface < 0)
        throw InputError("bolt '" + bolts_[b].name + "': its 'joint' has '" + contact->name +
                         "', which is not among the interfaces of the problem");
      bolts_of[surface].emplace_back(b, axis);
    }
  }
  for (const auto& [surface, bolts] : bolts_of) {
    const Surface& contact = (*start.model.surfaces)[static_cast<size_t>(surface)];
    const size_t first = clamped_.size(), n = static_cast<size_t>(contact.n_points());
    for (const auto& [b, axis] : bolts) {
      // Of a part of a bolt, its mirror images cancel some of the shear, which is not told apart: no slip margin.
      const double friction = is_whole_[b] ? friction_of(contact.declared_law()) : 0.0;
      clamped_.push_back({b, surface, friction, ratings_[b]->safety, std::vector<char>(n, 0)});
    }
    for (size_t i = 0; i < n; ++i) {
      size_t nearest = 0;
      double least = std::numeric_limits<double>::infinity();
      for (size_t k = 0; k < bolts.size(); ++k) {
        const Axis& axis = bolts[k].second;
        const Vec3 off = contact.facing.places.col(static_cast<Eigen::Index>(i)) - axis.place;
        if (const double distance = off.cross(axis.along).norm(); distance < least) least = distance, nearest = k;
      }
      clamped_[first + nearest].has_point[i] = 1;
    }
  }
}

void BoltRecorder::follow_clamped(const Instant& instant) {
  const Step& step = *instant.model.step;
  const bool is_tight = instant.i_step > last_tightening_,
             gets_tight = instant.i_step == last_tightening_ && instant.increment + 1 == step.increments;
  if (clamped_.empty() || !(is_tight || gets_tight)) return;
  std::vector<double> sums(4 * clamped_.size(), 0.0);  // N: pressed, and shear along x, y, z
  for (size_t c = 0; c < clamped_.size(); ++c) {
    const Facing& facing = (*instant.model.surfaces)[static_cast<size_t>(clamped_[c].surface)].facing;
    const std::vector<LawState>& points = instant.surface(clamped_[c].surface).points;
    for (size_t i = 0; i < points.size(); ++i) {
      if (!clamped_[c].has_point[i]) continue;
      const Vec3 n = facing.normals.col(static_cast<Eigen::Index>(i));
      const double normal = points[i].force.dot(n);
      sums[4 * c] -= normal;
      Eigen::Map<Vec3>(&sums[4 * c + 1]) += points[i].force - normal * n;
    }
  }
  for (size_t c = 0; c < clamped_.size(); ++c) {
    Clamped& own = clamped_[c];
    BoltMargins& margins = *bolts_[own.bolt].margins;
    const double pressed = sums[4 * c], shear = Eigen::Map<const Vec3>(&sums[4 * c + 1]).norm();
    if (gets_tight) own.pressed = own.least = pressed;
    own.least = std::min(own.least, pressed);
    const double left = own.pressed - own.least;
    if (!margins.clamp || left * *margins.clamp > (*margins.clamp - *margins.least_clamp) * own.pressed)
      margins.clamp = own.pressed, margins.least_clamp = own.least;
    constexpr double next_to_none = 1e-6;
    if (!(shear > next_to_none * std::abs(own.pressed)) || own.friction == 0.0) continue;
    const double held = std::max(0.0, pressed - (own.safety - 1.0) * std::max(0.0, own.pressed - pressed));
    const double slip = own.friction * held / (own.safety * shear) - 1.0;
    margins.slip = std::min(margins.slip.value_or(slip), slip);
  }
}

void BoltRecorder::begin_step(const Instant& start) {
  if (start.i_step == 0) find_clamped(start);
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
    if (bolt.margins) bolt.margins->largest = std::max(bolt.margins->largest, bolt.last);
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
  follow_clamped(instant);
}

}  // namespace dygita
