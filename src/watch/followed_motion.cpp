#include "watch/followed_motion.hpp"

#include <algorithm>

#include "law/law.hpp"
#include "model/load.hpp"

namespace dygita {

namespace {

Followed followed(const Surface& surface) { return surface.declared_law().shown().followed; }

// Does a load of some step release it, or a step leave its wall out?
bool may_let_go(const Problem& problem, const Surface& surface) {
  return std::any_of(problem.steps.begin(), problem.steps.end(), [&](const StepPtr& step) {
    if (surface.wall) return !takes_part(problem, *step, surface);
    return std::any_of(step->loads.begin(), step->loads.end(), [&](const LoadPtr& load) {
      const std::vector<Effect> effects = load->effects();
      return std::any_of(effects.begin(), effects.end(), [&](const Effect& effect) {
        const Release* release = std::get_if<Release>(&effect);
        return release && release->on.get() == surface.interface;
      });
    });
  });
}

bool has_let_go(const Instant& instant, size_t s) {
  const Surface& surface = (*instant.model.surfaces)[s];
  if (surface.wall) return !takes_part(*instant.model.problem, *instant.model.step, surface);
  return instant.state.released[s] != 0;
}

}  // namespace

void FollowedMotion::begin_step(const Instant& instant) {
  const bool is_first = motions_.empty();
  motions_.resize(instant.model.surfaces->size());
  for (size_t s = 0; s < motions_.size(); ++s) {
    const Surface& surface = (*instant.model.surfaces)[s];
    Motion& motion = motions_[s];
    if (is_first) {
      const bool is_followed = followed(surface) != Followed::nothing;
      motion.is_watched = is_followed || may_let_go(*instant.model.problem, surface);
      if (motion.is_watched) motion.sides = MovedSides(surface);
      if (is_followed) motion.moved = Points::Zero(3, surface.n_points());
    }
    if (!motion.is_watched) continue;
    if (!has_let_go(instant, s)) motion.loose.resize(3, 0);  // a wall that is back
    motion.before = motion.sides.jump(instant);
  }
}

void FollowedMotion::accept(const Instant& instant) {
  for (size_t s = 0; s < motions_.size(); ++s) {
    const Surface& surface = (*instant.model.surfaces)[s];
    Motion& motion = motions_[s];
    if (!motion.is_watched) continue;
    const Points now = motion.sides.jump(instant);
    if (motion.moved.size() > 0) {
      const bool is_slip = followed(surface) == Followed::slip_between_touches;
      for (int i = 0; i < surface.n_points(); ++i) {
        // As law/slip.hpp does where the law knows the tangents.
        const bool is_open = instant.surface(static_cast<int>(s)).points[i].status == PointState::open;
        if (is_slip && is_open && motion.moved.col(i).isZero(0.0)) continue;
        const Vec3 n = surface.facing.normals.col(i), moved = now.col(i) - motion.before.col(i);
        motion.moved.col(i) += is_slip ? Vec3(moved - moved.dot(n) * n) : moved;
      }
    }
    if (has_let_go(instant, s)) {
      if (motion.loose.size() == 0) motion.loose = Points::Zero(3, surface.n_points());
      motion.loose += now - motion.before;
    }
    motion.before = now;
  }
}

double FollowedMotion::opening(const Instant& instant, int surface, int point) const {
  const Surface& of = (*instant.model.surfaces)[surface];
  const Motion& motion = motions_[static_cast<size_t>(surface)];
  const Vec3 n = of.facing.normals.col(point);
  if (followed(of) == Followed::opening_and_slip && motion.moved.size() > 0) return motion.moved.col(point).dot(n);
  // The law's memory ends where it lets go.
  return of.declared_law().opening(instant.surface(surface).points[point]) + parted(instant, surface, point);
}

double FollowedMotion::parted(const Instant& instant, int surface, int point) const {
  const Points& loose = motions_[static_cast<size_t>(surface)].loose;
  return loose.size() > 0 ? loose.col(point).dot((*instant.model.surfaces)[surface].facing.normals.col(point)) : 0.0;
}

Vec3 FollowedMotion::slip(const Instant& instant, int surface, int point) const {
  const Surface& of = (*instant.model.surfaces)[surface];
  const Motion& motion = motions_[static_cast<size_t>(surface)];
  const Vec3 n = of.facing.normals.col(point);
  const auto along = [&](const Vec3& moved) { return Vec3(moved - moved.dot(n) * n); };
  if (followed(of) == Followed::slip_between_touches && motion.moved.size() > 0) return motion.moved.col(point);
  if (followed(of) == Followed::opening_and_slip && motion.moved.size() > 0) return along(motion.moved.col(point));
  const Vec3 kept = instant.surface(surface).points[point].slip;
  // What has a gap of its own slides while it is closed.
  return motion.loose.size() > 0 && !of.declared_law().shown().gap ? kept + along(motion.loose.col(point)) : kept;
}

}  // namespace dygita
