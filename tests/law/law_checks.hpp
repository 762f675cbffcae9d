// What the tests of laws share: trials, steps, a slope by differences, a point in an explicit step.
#pragma once

#include <gtest/gtest.h>

#include "law/law.hpp"

namespace dygita {

inline const Increment dynamic_step{TimeScheme::implicit(1e-6)};
inline const Increment static_step{};

inline Trial trial(const Vec3& s, const Vec3& y = Vec3(2e-3, 2e-3, 2e-3)) {
  Trial t;
  t.s = s;
  t.y = y;
  t.area = 1e-4;
  return t;
}

inline LawPtr contact(double friction, double gap = 0.0) {
  return make_law("contact", {{"friction", friction}, {"gap", gap}});
}
inline LawPtr plastic(double yield, double hardening, bool compression) {
  return make_law("plastic", {{"yield", yield}, {"hardening", hardening}, {"compression", compression ? 1.0 : 0.0}});
}

// d force / d s by central differences; columns are directions of s.
inline Mat3 slope(const Law& law, const Trial& t, const Increment& increment, const LawState& start, double h) {
  Mat3 slope;
  for (int d = 0; d < 3; ++d) {
    Trial more = t, less = t;
    more.s[d] += h;
    less.s[d] -= h;
    slope.col(d) = (law.force(more, increment, start) - law.force(less, increment, start)) / (2 * h);
  }
  return slope;
}

// A point in an explicit step with springs of k (N/m).
inline SpringPoint spring_point(const Law& law, const LawState& start, double area, double k) {
  SpringPoint point;
  point.area = area;
  for (int d = 0; d < 3; ++d) point.stiffness[d] = law.acts_on(d, false) ? k : 0.0;
  point.start = point.now = start;
  law.explicit_form().springs->begin(point);
  return point;
}
inline void move_to(const Law& law, const Vec3& jump, SpringPoint& point) {
  law.explicit_form().springs->move(point, jump);
  point.jump = jump;
}

}  // namespace dygita
