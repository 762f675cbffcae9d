#include "solution/point_frames.hpp"

namespace dygita {

Mat3 frame_of(const Vec3& n, Vec3 t) {
  if (t.isZero()) {
    int least = 0;
    n.cwiseAbs().minCoeff(&least);
    t = Vec3::Unit(least);
  }
  Mat3 frame;
  frame.col(0) = n;
  frame.col(1) = (t - n.dot(t) * n).normalized();
  frame.col(2) = n.cross(frame.col(1));
  return frame;
}

void activate(const std::vector<Port>& ports, bool has_group, Point& point) {
  for (int d = 0; d < 3; ++d) {
    if (!has_group && !point.has_law[d]) continue;
    for (int p = point.first_port; p < point.end_port; ++p) point.is_active[d] |= !ports[p].is_held[d];
  }
}

}  // namespace dygita
