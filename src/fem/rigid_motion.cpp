#include "fem/rigid_motion.hpp"

#include <Eigen/Geometry>

#include "numerics/dense.hpp"

namespace dygita {

NearestRigidMotion nearest_rigid_motion(const Points& x, const Points& field) {
  NearestRigidMotion motion{x.rowwise().mean(), field.rowwise().mean(), Vec3::Zero()};
  Mat3 inertia = Mat3::Zero();
  Vec3 moment = Vec3::Zero();
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    const Vec3 arm = x.col(i) - motion.middle, moved = field.col(i) - motion.moved;
    inertia += arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose();
    moment += arm.cross(moved);
  }
  motion.rotation = pseudo_inverse(inertia) * moment;
  return motion;
}

Points without_rigid_motion(Points field, const Points& x) {
  const NearestRigidMotion motion = nearest_rigid_motion(x, field);
  for (Eigen::Index i = 0; i < x.cols(); ++i)
    field.col(i) -= motion.moved + motion.rotation.cross(Vec3(x.col(i) - motion.middle));
  return field;
}

}  // namespace dygita
