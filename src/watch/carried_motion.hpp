// The motion of an assembly as a whole: what shakes it, or what it has gathered where nothing holds it.
#pragma once

#include <functional>

#include "step/observer.hpp"

namespace dygita {

// Velocity (m/s) that a dynamic step's motions are measured against. Along directions that supports, walls or
// prescribed motions hold it is theirs, as far as they all move alike, else zero; along others that of the centre of
// mass. Springs to the ground hold where they turn the assembly back within the step.
class CarriedMotion {
 public:
  explicit CarriedMotion(const Instant& start);
  // Something is free to move.
  bool asks_for_momentum() const { return free_.trace() > 0.5 && mass_ > 0.0; }
  // On to the directions that nothing holds.
  const Mat3& free() const { return free_; }
  // momentum: kg m/s, of the whole assembly; called only where it is asked for.
  Vec3 at(const Instant& instant, const std::function<Vec3()>& momentum) const;

 private:
  Mat3 held_inverse_ = Mat3::Zero();  // of the sum of d d' over held directions, on their span
  Mat3 free_ = Mat3::Identity();
  Eigen::Matrix3Xd pull_;  // 3 x motions: sum of d times the share of a motion
  Mat square_;             // motions x motions: sum of the products of shares
  double mass_ = 0.0;      // kg
};

}  // namespace dygita
