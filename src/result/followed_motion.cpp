#include "result/followed_motion.hpp"

#include "law/law.hpp"

namespace dygita {

namespace {

Followed followed(const Surface& surface) { return surface.declared_law().shown().followed; }

}  // namespace

void FollowedMotion::begin_step(const Instant& instant) {
  const size_t n = instant.model.surfaces->size();
  sides_.resize(n);
  before_.resize(n);
  moved_.resize(n);
  for (size_t s = 0; s < n; ++s) {
    const Surface& surface = (*instant.model.surfaces)[s];
    if (followed(surface) == Followed::nothing) continue;
    if (moved_[s].size() == 0) {
      sides_[s] = MovedSides(surface);
      moved_[s] = Points::Zero(3, surface.n_points());
    }
    before_[s] = sides_[s].jump(instant);
  }
}

void FollowedMotion::accept(const Instant& instant) {
  for (size_t s = 0; s < before_.size(); ++s) {
    const Surface& surface = (*instant.model.surfaces)[s];
    if (moved_[s].size() == 0) continue;
    const bool is_slip = followed(surface) == Followed::slip_while_closed;
    const Points now = sides_[s].jump(instant);
    for (int i = 0; i < surface.n_points(); ++i) {
      if (is_slip && instant.surface(s).points[i].status == PointState::open) continue;
      const Vec3 n = surface.facing.normals.col(i), moved = now.col(i) - before_[s].col(i);
      moved_[s].col(i) += is_slip ? Vec3(moved - moved.dot(n) * n) : moved;
    }
    before_[s] = now;
  }
}

double FollowedMotion::opening(const Instant& instant, int surface, int point) const {
  const Surface& of = (*instant.model.surfaces)[surface];
  if (followed(of) == Followed::opening_and_slip && moved_[surface].size() > 0)
    return moved_[surface].col(point).dot(of.facing.normals.col(point));
  return of.declared_law().opening(instant.surface(surface).points[point]);
}

Vec3 FollowedMotion::slip(const Instant& instant, int surface, int point) const {
  const Surface& of = (*instant.model.surfaces)[surface];
  if (followed(of) == Followed::nothing || moved_[surface].size() == 0)
    return instant.surface(surface).points[point].slip;
  const Vec3 n = of.facing.normals.col(point), moved = moved_[surface].col(point);
  return followed(of) == Followed::slip_while_closed ? moved : Vec3(moved - moved.dot(n) * n);
}

}  // namespace dygita
