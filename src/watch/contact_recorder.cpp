#include "watch/contact_recorder.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "law/law.hpp"
#include "ranks/ranks.hpp"
#include "result/result.hpp"
#include "watch/linked_parts.hpp"

namespace dygita {

namespace {

bool is_contact(const Surface& surface) {
  const Shown shown = surface.declared_law().shown();
  return shown.gap && shown.states;
}

// The largest so far and where; of equal ones the first.
void raise(double value, const Vec3& place, double& largest, Vec3& at) {
  if (!(value > largest)) return;
  largest = value;
  at = place;
}

}  // namespace

void ContactRecorder::find_contacts(const Instant& start) {
  const std::vector<Surface>& surfaces = *start.model.surfaces;
  for (size_t s = 0; s < surfaces.size(); ++s) {
    if (!is_contact(surfaces[s])) continue;
    // The faces of a wall follow each other.
    const bool is_next_face = surfaces[s].wall && s > 0 && surfaces[s - 1].wall == surfaces[s].wall;
    if (!is_next_face) {
      contacts_.push_back({surfaces[s].name(), {}, 0.0, friction_of(surfaces[s].declared_law()), {}});
      for (const int part : {surfaces[s].part_1, surfaces[s].part_2})
        if (part >= 0) contacts_.back().parts.push_back(part);
      surfaces_.emplace_back();
      middles_.emplace_back(Vec3::Zero());
    }
    const Facing& facing = surfaces[s].facing;
    contacts_.back().area += facing.areas.sum();
    if (facing.n_points() > 0) middles_.back() += facing.places * facing.areas;
    surfaces_.back().push_back(static_cast<int>(s));
  }
  for (size_t c = 0; c < contacts_.size(); ++c)
    if (contacts_[c].area > 0.0) middles_[c] /= contacts_[c].area;
}

void ContactRecorder::begin_step(const Instant& start) {
  if (contacts_.empty()) find_contacts(start);
  watched_.clear();
  for (size_t c = 0; c < contacts_.size(); ++c)
    for (const int s : surfaces_[c]) {
      const Surface& surface = (*start.model.surfaces)[static_cast<size_t>(s)];
      if (!takes_part(*start.model.problem, *start.model.step, surface)) continue;
      Watched watched{c, s, std::vector<Start>(static_cast<size_t>(surface.n_points()))};
      watched.rubs = !start.is_static() && start.model.n_substeps() == 1 && !start.model.problem->explicit_dynamics &&
                     surface.declared_law().shown().slip;
      const std::vector<Work>& works = start.state.surfaces[static_cast<size_t>(s)].works;
      start.for_each_point_here(s, [&](int i, const LawState& point) {
        const bool is_closed = point.status != PointState::open;
        watched.points[static_cast<size_t>(i)] = {point.slip, is_closed, is_closed,
                                                  works[static_cast<size_t>(i)].friction};
      });
      if (!start.is_static() &&
          (changes_.empty() || changes_.back().step != start.model.step || changes_.back().contact != c))
        changes_.push_back({start.model.step, c});
      if (watched.rubs &&
          (rubbing_.empty() || rubbing_.back().step != start.model.step || rubbing_.back().contact != c))
        rubbing_.push_back({start.model.step, c});
      watched_.push_back(std::move(watched));
    }
  is_new_ = true;
}

// A slide ends where the point sticks or its friction turns round.
void ContactRecorder::follow_slide(const LawState& now, const Vec3& force, double taken, Slide& slide, Rubbing& of) {
  constexpr int brief = 2;
  const bool slides = now.status == PointState::slip;
  of.taken += taken;
  if (!slides || slide.force.dot(force) < 0.0) {
    if (slide.n <= brief) of.brief += slide.work;
    slide = {};
  }
  if (!slides) {
    of.brief += taken;
    return;
  }
  slide = {slide.n + 1, slide.work + taken, force};
}

void ContactRecorder::follow_friction(const Instant& instant) {
  for (Watched& watched : watched_) {
    if (!watched.rubs) continue;
    const auto of = std::find_if(rubbing_.rbegin(), rubbing_.rend(),
                                 [&](const Rubbing& rubbing) { return rubbing.contact == watched.contact; });
    const Surface& surface = (*instant.model.surfaces)[static_cast<size_t>(watched.surface)];
    const std::vector<Work>& works = instant.state.surfaces[static_cast<size_t>(watched.surface)].works;
    of->motion = std::max(of->motion, instant.state.energies.kinetic);
    instant.for_each_point_here(watched.surface, [&](int i, const LawState& point) {
      Start& past = watched.points[static_cast<size_t>(i)];
      const double now = works[static_cast<size_t>(i)].friction;
      const Vec3 n = surface.facing.normals.col(i);
      follow_slide(point, point.force - point.force.dot(n) * n, now - std::exchange(past.work, now), past.slide, *of);
    });
  }
}

void ContactRecorder::tell(RunResult& result) const {
  tell_friction(result);
  tell_chatter(result);
  tell_let_go(result);
}

void ContactRecorder::tell_friction(RunResult& result) const {
  constexpr double most = 0.2;        // of what friction takes
  constexpr double of_motion = 0.05;  // friction that takes less hardly damps it
  for (const Rubbing& of : rubbing_)
    if (of.brief > most * of.taken && of.taken > of_motion * of.motion)
      result.warnings.push_back(fmt::format(
          "step '{}': {:.0f} % of what friction takes at '{}' goes in slides of one or two time steps: dt = {:.3g} us "
          "does not resolve it, and the damping is too large; halve dt until this is below {:.0f} %, or give the faces "
          "'compliance', without which points stick and slide by turns",
          of.step->name, 100.0 * of.brief / of.taken, result.contacts[of.contact].name, 1e6 * of.step->dt,
          100.0 * most));
}

// Points that open and close every few increments while the force swings: what the mesh and dt make of a contact
// without damping. Its mean force, and so friction and motion, are right; its extremes mean nothing.
void ContactRecorder::tell_chatter(RunResult& result) const {
  constexpr double most = 10.0, least = 0.15;  // increments from change to change; of the force, from each to the next
  for (const Changes& of : changes_) {
    const ContactSummary& contact = result.contacts[of.contact];
    const double every = contact.area * of.n / of.area, change = of.changed / of.pressed;
    if (!(every < most) || !(change > least)) continue;
    result.warnings.push_back(
        fmt::format("step '{}': contact '{}' chatters: its points open or close every {:.2g} time steps, and its "
                    "force, {:.4g} to {:.4g} N, changes by {:.0f} % from one to the next on average; friction and "
                    "motion follow its mean and are right, peaks of force and stress are not: give the parts "
                    "'damping', use numerical_damping (implicit parts) or solver.explicit, or a smaller dt",
                    of.step->name, contact.name, every, of.lowest, of.highest, 100.0 * change));
  }
}

// A part that touched at first and has lost touch is where iteration has left it: no force brings it back, and none has
// taken it further.
void ContactRecorder::find_let_go(const Instant& instant) {
  constexpr double rounding = 1e-10;  // of the size of a contact
  let_go_.clear();                    // a later step may load what an earlier one leaves loose
  constexpr double all = 1.0 - 1e-9;
  const auto is_open = [&](const Watched& watched) { return contacts_[watched.contact].steps.back().closed < all; };
  if (std::none_of(watched_.begin(), watched_.end(), is_open)) return;
  for (const int part : LinkedParts::let_go(instant)) {
    LetGo found{instant.model.step, instant.model.problem->substructures[static_cast<size_t>(part)]->name, ""};
    for (const Watched& watched : watched_) {
      const Surface& surface = (*instant.model.surfaces)[static_cast<size_t>(watched.surface)];
      if (surface.n_points() == 0) continue;
      const double nothing = rounding * std::sqrt(contacts_[watched.contact].area);
      if ((surface.part_1 != part && surface.part_2 != part) || surface.facing.gaps.minCoeff() > nothing) continue;
      double opening = 0.0;
      instant.for_each_point_here(watched.surface, [&](int, const LawState& point) {
        opening = std::max(opening, surface.declared_law().opening(point));
      });
      opening = ranks::largest(opening);
      if (!(opening > std::max(found.opening, nothing))) continue;
      found.opening = opening;
      found.contact = surface.name();
    }
    let_go_.push_back(found);
  }
}

void ContactRecorder::tell_let_go(RunResult& result) const {
  for (const LetGo& of : let_go_)
    if (of.opening > 0.0)
      result.warnings.push_back(fmt::format(
          "static step '{}': at its end no force acts on substructure '{}': contact '{}' is open by up to {:.3g} um, "
          "and where the part rests is arbitrary; load it (gravity, a preload), or hold it by a support",
          of.step->name, of.part, of.contact, 1e6 * of.opening));
}

void ContactRecorder::look_at(const Instant& instant, Watched& watched, Sums& sums, ContactStep& step) const {
  const Surface& surface = (*instant.model.surfaces)[static_cast<size_t>(watched.surface)];
  const Law& law = surface.declared_law();
  if (instant.state.released[static_cast<size_t>(watched.surface)]) return;
  instant.for_each_point_here(watched.surface, [&](int i, const LawState& point) {
    Start& start = watched.points[static_cast<size_t>(i)];
    const bool is_closed = point.status != PointState::open;
    if (std::exchange(start.was_closed, is_closed) != is_closed) sums.changed += surface.facing.areas[i];
    const Vec3 place = surface.facing.places.col(i);
    if (start.is_closed) raise(law.opening(point), place, step.opening, step.opening_at);
    if (!is_closed) return;
    if (step.slip) raise((point.slip - start.slip).norm(), place, *step.slip, step.slip_at);
    const Vec3 n = surface.facing.normals.col(i);
    const double normal = point.force.dot(n), area = surface.facing.areas[i];
    sums.pressed -= normal;
    const Vec3 shear = point.force - normal * n, arm = surface.facing.places.col(i) - middles_[watched.contact];
    sums.shear += shear;
    sums.moment += arm.cross(shear);
    sums.leverage -= normal * arm.norm();
    sums.closed += area;
    if (point.status == PointState::slip) sums.sliding += area;
  });
}

void ContactRecorder::add(const Sums& sums, bool is_static, size_t c) {
  ContactSummary& contact = contacts_[c];
  const auto changes =
      std::find_if(changes_.rbegin(), changes_.rend(), [&](const Changes& of) { return of.contact == c; });
  if (!is_static && sums.pressed > 0.0) {
    if (changes->n++ > 0) changes->changed += std::abs(sums.pressed - changes->last);
    changes->last = sums.pressed;
    changes->pressed += sums.pressed;
    changes->area += sums.changed;
    changes->lowest = std::min(changes->lowest, sums.pressed);
    changes->highest = std::max(changes->highest, sums.pressed);
  }
  const double shear = sums.shear.norm(), closed = contact.area > 0.0 ? sums.closed / contact.area : 0.0;
  const bool is_first = is_static || is_new_;
  ContactStep& step = contact.steps.back();
  step.lowest = is_first ? sums.pressed : std::min(step.lowest, sums.pressed);
  step.highest = is_first ? sums.pressed : std::max(step.highest, sums.pressed);
  step.shear = is_first ? shear : std::max(step.shear, shear);
  step.closed = is_first ? closed : std::min(step.closed, closed);
  if (!(contact.friction > 0.0)) return;
  constexpr double next_to_none = 1e-3;  // of what has pressed: an instant of touch says nothing of friction
  if (!is_first && sums.pressed < next_to_none * step.highest) return;
  const double sliding = sums.closed > 0.0 ? sums.sliding / sums.closed : 0.0,
               of_shear = sums.pressed > 0.0 ? shear / (contact.friction * sums.pressed) : 0.0,
               turning = sums.leverage > 0.0 ? sums.moment.norm() / (contact.friction * sums.leverage) : 0.0,
               used = std::max(of_shear, turning);
  step.sliding = is_first ? sliding : std::max(*step.sliding, sliding);
  step.friction_used = is_first ? used : std::max(*step.friction_used, used);
}

void ContactRecorder::accept(const Instant& instant) {
  if (contacts_.empty()) return;
  std::vector<char> is_watched(contacts_.size(), 0);
  for (const Watched& watched : watched_) {
    ContactSummary& contact = contacts_[watched.contact];
    if (!is_watched[watched.contact]++ && is_new_) contact.steps.emplace_back().step = instant.i_step;
    if (!is_new_ && !instant.is_static()) continue;
    contact.steps.back().opening = 0.0;
    if (contact.friction > 0.0) contact.steps.back().slip = 0.0;
  }
  std::vector<Sums> of_each(contacts_.size());
  for (Watched& watched : watched_)
    look_at(instant, watched, of_each[watched.contact], contacts_[watched.contact].steps.back());
  std::vector<double> numbers;
  constexpr size_t n_sums = 11;
  for (const Sums& of : of_each)
    numbers.insert(numbers.end(), {of.pressed, of.shear[0], of.shear[1], of.shear[2], of.closed, of.sliding,
                                   of.moment[0], of.moment[1], of.moment[2], of.leverage, of.changed});
  numbers = ranks::sums(numbers);
  for (size_t c = 0; c < contacts_.size(); ++c) {
    const double* n = numbers.data() + n_sums * c;
    if (is_watched[c])
      add({n[0], {n[1], n[2], n[3]}, n[4], n[5], {n[6], n[7], n[8]}, n[9], n[10]}, instant.is_static(), c);
  }
  is_new_ = false;
  if (!instant.is_static()) return follow_friction(instant);
  find_let_go(instant);
}

void ContactRecorder::settle() {
  if (ranks::is_alone()) return;
  std::vector<double> work;
  for (const Rubbing& of : rubbing_) work.insert(work.end(), {of.taken, of.brief});
  work = ranks::sums(work);
  for (size_t i = 0; i < rubbing_.size(); ++i) rubbing_[i].taken = work[2 * i], rubbing_[i].brief = work[2 * i + 1];
  std::vector<double> own;
  for (const ContactSummary& contact : contacts_)
    for (const ContactStep& step : contact.steps) {
      own.insert(own.end(), {step.opening, step.slip.value_or(0.0)});
      own.insert(own.end(), step.opening_at.begin(), step.opening_at.end());
      own.insert(own.end(), step.slip_at.begin(), step.slip_at.end());
    }
  for (const std::vector<double>& of_rank : ranks::of_all(own)) {
    const double* of = of_rank.data();
    for (ContactSummary& contact : contacts_)
      for (ContactStep& step : contact.steps) {
        raise(of[0], Eigen::Map<const Vec3>(of + 2), step.opening, step.opening_at);
        if (step.slip) raise(of[1], Eigen::Map<const Vec3>(of + 5), *step.slip, step.slip_at);
        of += 8;
      }
  }
}

}  // namespace dygita
