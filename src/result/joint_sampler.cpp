// The joint's columns: forces, largest opening and slip, areas by state, works.
#include <algorithm>
#include <cmath>

#include "result/surface_sums.hpp"

namespace dygita {

namespace {

// What a joint is at one instant; a row is the mean of both ends of an increment, forces are means already.
struct JointState {
  double opening = 0.0, slip = 0.0, plastic_opening = 0.0;
  double friction_work = 0.0, plastic_work = 0.0, damping_work = 0.0;
};

class JointSampler : public Sampler {
 public:
  JointSampler(const Problem& problem, const Output& output)
      : Sampler({{"time", "normal", "shear", "opening", "slip", "plastic_opening", "open_area", "stick_area",
                  "slip_area", "friction_work", "plastic_work", "damping_work"},
                 {"s", "N", "N", "m", "m", "m", "m^2", "m^2", "m^2", "J", "J", "J"},
                 {},
                 {}}),
        problem_(problem),
        output_(output) {}

  void begin_step(const Instant& instant) override {
    motion_.begin_step(instant);
    before_ = state_of(instant);
  }

  void accept(const Instant& instant) override {
    motion_.accept(instant);
    const JointState now = state_of(instant);
    const JointState& a = instant.is_static() ? now : before_;
    const auto mean = [](double x, double y) { return 0.5 * (x + y); };
    const Resultant r = resultant(instant, problem_, output_.on);
    double area[3] = {0.0, 0.0, 0.0};
    for (const int s : surfaces_of(instant, output_.on)) {
      const Surface& surface = (*instant.model.surfaces)[s];
      if (!surface.declared_law().shown().states) continue;
      for (int i = 0; i < surface.n_points(); ++i)
        area[static_cast<int>(instant.state.surfaces[s].points[i].status)] += surface.facing.areas[i];
    }
    add_row(instant, mean_time(instant),
            {r.normal, r.shear, mean(a.opening, now.opening), mean(a.slip, now.slip),
             mean(a.plastic_opening, now.plastic_opening), area[0], area[1], area[2],
             mean(a.friction_work, now.friction_work), mean(a.plastic_work, now.plastic_work),
             mean(a.damping_work, now.damping_work)});
    before_ = now;
  }

 private:
  JointState state_of(const Instant& instant) const {
    JointState joint;
    for (const int s : surfaces_of(instant, output_.on)) {
      const SurfaceState& surface = instant.state.surfaces[s];
      for (size_t i = 0; i < surface.points.size(); ++i) {
        const LawState& p = surface.points[i];
        const double opening = motion_.opening(instant, s, static_cast<int>(i));
        if (std::abs(opening) > std::abs(joint.opening)) joint.opening = opening;
        if (std::abs(p.plastic_opening) > std::abs(joint.plastic_opening)) joint.plastic_opening = p.plastic_opening;
        joint.slip = std::max(joint.slip, motion_.slip(instant, s, static_cast<int>(i)).norm());
      }
      joint.friction_work += surface.friction_work;
      joint.plastic_work += surface.plastic_work;
      joint.damping_work += surface.damping_work;
    }
    return joint;
  }

  const Problem& problem_;
  const Output& output_;
  FollowedMotion motion_;
  JointState before_;
};

}  // namespace

std::unique_ptr<Sampler> make_joint_sampler(const Problem& problem, const Output& output) {
  return std::make_unique<JointSampler>(problem, output);
}

namespace {

Followed followed(const Surface& surface) { return surface.declared_law().shown().followed; }

}  // namespace

Points FollowedMotion::relative_displacement(const Instant& instant, int s) const {
  const Surface& surface = (*instant.model.surfaces)[s];
  const Points u_1 = instant.displacement(surface.part_1);
  const Points u_2 = surface.part_2 >= 0 ? instant.displacement(surface.part_2) : Points();
  Points relative(3, surface.n_points());
  for (int i = 0; i < surface.n_points(); ++i) {
    relative.col(i) = -u_1.col(surface.facing.nodes_1[i]);
    if (surface.part_2 >= 0) relative.col(i) += u_2.col(surface.facing.nodes_2[i]);
  }
  return relative;
}

void FollowedMotion::begin_step(const Instant& instant) {
  const size_t n = instant.model.surfaces->size();
  before_.resize(n);
  moved_.resize(n);
  for (size_t s = 0; s < n; ++s) {
    const Surface& surface = (*instant.model.surfaces)[s];
    if (followed(surface) == Followed::nothing) continue;
    before_[s] = relative_displacement(instant, static_cast<int>(s));
    if (moved_[s].size() == 0) moved_[s] = Points::Zero(3, surface.n_points());
  }
}

void FollowedMotion::accept(const Instant& instant) {
  for (size_t s = 0; s < before_.size(); ++s) {
    const Surface& surface = (*instant.model.surfaces)[s];
    if (moved_[s].size() == 0) continue;
    const bool is_slip = followed(surface) == Followed::slip_while_closed;
    const Points now = relative_displacement(instant, static_cast<int>(s));
    for (int i = 0; i < surface.n_points(); ++i) {
      if (is_slip && instant.state.surfaces[s].points[i].status == PointState::open) continue;
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
  return of.declared_law().opening(instant.state.surfaces[surface].points[point]);
}

Vec3 FollowedMotion::slip(const Instant& instant, int surface, int point) const {
  const Surface& of = (*instant.model.surfaces)[surface];
  if (followed(of) == Followed::nothing || moved_[surface].size() == 0)
    return instant.state.surfaces[surface].points[point].slip;
  const Vec3 n = of.facing.normals.col(point), moved = moved_[surface].col(point);
  return followed(of) == Followed::slip_while_closed ? moved : Vec3(moved - moved.dot(n) * n);
}

}  // namespace dygita
