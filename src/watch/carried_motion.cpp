#include "watch/carried_motion.hpp"

#include "law/law.hpp"
#include "numerics/dense.hpp"

namespace dygita {

namespace {

// Directions in which springs to the ground turn a motion of this mass (kg) back within a step of `duration` (s): what
// swings on them is the shock's. Softer ones, as cords that hang a free assembly, let it go where it goes.
Mat3 held_by_springs(const Surface& surface, double mass, double duration) {
  Mat3 held = Mat3::Zero();
  const Law& law = surface.declared_law();
  const Tangent tangent = law.tangent(law.initial(), true);
  for (int i = 0; i < surface.n_points(); ++i)
    for (int d = 0; d < 3; ++d) {
      const double stiffness = tangent.stiffness[d] * surface.facing.areas[i];
      if (!surface.facing.acts_along(i, d) || stiffness * duration * duration < mass) continue;
      const Vec3 axis = surface.facing.frames[static_cast<size_t>(i)].col(d);
      held += axis * axis.transpose();
    }
  return held;
}

}  // namespace

CarriedMotion::CarriedMotion(const Instant& start) {
  const StepModel& model = start.model;
  const auto n_motions = static_cast<Eigen::Index>(model.conditions.motions.size());
  pull_ = Eigen::Matrix3Xd::Zero(3, n_motions);
  square_ = Mat::Zero(n_motions, n_motions);
  Mat3 held = Mat3::Zero();
  for (const auto& of_part : model.conditions.held)
    for (const auto& [node, at_node] : of_part)
      for (int j = 0; j < at_node.n; ++j) {
        const Vec3 d = at_node.directions.col(j);
        held += d * d.transpose();
        for (const auto& [i, share] : at_node.motion[j]) {
          pull_.col(i) += share * d;
          for (const auto& [k, other] : at_node.motion[j]) square_(i, k) += share * other;
        }
      }
  for (const SubstructurePtr& part : model.problem->substructures) {
    const Eigen::Matrix3Xd resisted = part->mesh->inside->resisted_motions(part->mesh->nodes).topRows<3>();
    held += resisted * resisted.transpose();
  }
  for (const auto& piece : model.pieces) mass_ += piece->mass();
  for (const Surface& surface : *model.surfaces) {
    if (!surface.wall || !surface.is_on_ground || !takes_part(*model.problem, *model.step, surface)) continue;
    if (!surface.facing.is_of_sums())
      held += surface.facing.normals * surface.facing.normals.transpose();
    else if (!surface.is_of_rotation)
      held += held_by_springs(surface, mass_, start.interval() * model.step->n_increments());
  }
  for (const InterfacePtr& interface : model.problem->interfaces)  // what other sectors push adds up along the axis
    if (interface->cyclic) held += Mat3::Identity() - interface->cyclic->along * interface->cyclic->along.transpose();
  for (const SupportPtr& support : supports_of(*model.problem, *model.step))
    if (support->kind->absorbs()) held += Mat3::Identity();
  const PrincipalAxes axes = principal_axes(held);
  for (int d = 0; d < 3; ++d) {
    const Vec3 axis = axes.vectors.col(d);
    if (axes.values[d] < 1e-6) continue;
    held_inverse_ += axis * axis.transpose() / axes.values[d];
    free_ -= axis * axis.transpose();
  }
}

Vec3 CarriedMotion::at(const Instant& instant, const std::function<Vec3()>& momentum) const {
  Vec3 carried = Vec3::Zero();
  if (pull_.cols() > 0) {
    const std::vector<double> motions = instant.model.motion_velocities(std::max(instant.last_substep(), 0));
    const Eigen::Map<const Vec> v(motions.data(), static_cast<Eigen::Index>(motions.size()));
    const Vec3 pulled = pull_ * v;
    const double all = v.dot(square_ * v), together = pulled.dot(held_inverse_ * pulled);
    if (together > 0.99 * all) carried = held_inverse_ * pulled;  // all that is held moves alike
  }
  if (asks_for_momentum()) carried += free_ * momentum() / mass_;
  return carried;
}

}  // namespace dygita
