#include "foreign/abaqus_axes.hpp"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <cmath>

#include "base/error.hpp"

namespace dygita {

Mat3 axes_of_node(const CardFile& file, const FileCard& card, bool is_cylinder, const std::array<Vec3, 2>& points,
                  const Vec3& x) {
  constexpr double nothing = 1e-9;
  Mat3 axes;
  if (is_cylinder) {
    axes.col(2) = (points[1] - points[0]).normalized();
    axes.col(0) = x - points[0] - axes.col(2).dot(x - points[0]) * axes.col(2);
    if (!(axes.col(0).norm() > nothing * (x - points[0]).norm())) file.fail(card, "a node on the axis has no axes");
  } else {
    axes.col(0) = points[0].normalized();
    axes.col(2) = points[0].cross(points[1]);
    if (!(axes.col(2).norm() > nothing * points[0].norm() * points[1].norm()))
      file.fail(card, "its two points are on one line");
  }
  axes.col(0).normalize();
  axes.col(2).normalize();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

AxesSaying forced_in(const Mat3& axes, const Vec3& by) {
  constexpr double rounding = 1e-12;
  const Vec3 force = axes * by;
  AxesSaying says{};
  for (int d = 0; d < 3; ++d)
    if (std::abs(force[d]) > rounding * force.norm())
      says[static_cast<size_t>(d)] = 1, says[static_cast<size_t>(d) + 3] = force[d];
  return says;
}

HeldInAxes held_in(const Mat3& axes, const AxesSaying& own, const std::string& where) {
  constexpr double close = 1e-9;
  Mat3 left = Mat3::Zero();
  for (int d = 0; d < 3; ++d)
    if (own[static_cast<size_t>(d)] != 0) left += axes.col(d) * axes.col(d).transpose();
  const Mat3 held = left;
  const Vec3 by = axes * Vec3(own[3], own[4], own[5]);
  HeldInAxes found;
  Vec3 oblique_motion = by;
  for (int d = 0; d < 3; ++d) {
    if ((held.col(d) - Vec3::Unit(d)).norm() > close) continue;
    left -= Vec3::Unit(d) * Vec3::Unit(d).transpose();
    oblique_motion[d] = 0.0;
    found.says[static_cast<size_t>(d)] = 1;
    if (std::abs(by[d]) > close * by.norm()) found.says[static_cast<size_t>(d) + 3] = by[d];
  }
  for (int d = 0; d < 3; ++d) {
    const Vec3 e = left * axes.col(d);
    if (own[static_cast<size_t>(d)] == 0 || e.norm() < close) continue;
    Vec3 unit = e.normalized();
    left -= unit * unit.transpose();
    for (int i = 2; i >= 0; --i)
      if (std::abs(unit[i]) > close && (unit.head(i).cwiseAbs().array() < close).all()) unit *= unit[i] < 0 ? -1 : 1;
    found.oblique.push_back(unit);
  }
  if (!found.oblique.empty() && oblique_motion.norm() > close * by.norm())
    throw InputError(
        fmt::format("{}: *BOUNDARY: a node moves along axes of *TRANSFORM that are none of the file's", where));
  return found;
}

}  // namespace dygita
