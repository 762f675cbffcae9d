// load.torque: a moment about an axis, spread over a face as tractions that grow with the radius (manual, eq. S8).
#include <spdlog/fmt/fmt.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "model/load.hpp"

namespace dygita {

namespace {

// About which tractions turn for a moment along the axis alone, which on a face aslant of it is another direction.
Vec3 turn_of(const Vec3& axis, const LoadedNodes& nodes, const Vec3& centre) {
  Mat3 inertia = Mat3::Zero();
  for (Eigen::Index i = 0; i < nodes.positions.cols(); ++i) {
    const Vec3 arm = nodes.positions.col(i) - centre, moment = nodes.moments.col(i) - nodes.weights[i] * centre;
    inertia += arm.dot(moment) * Mat3::Identity() - arm * moment.transpose();
  }
  const Eigen::LDLT<Mat3> factor(inertia);
  return factor.rcond() > 1e-9 ? Vec3(factor.solve(axis).normalized()) : axis;
}

class Torque final : public Load {
 public:
  explicit Torque(const ModelArguments& a) : Load(a, one_value(a, "history")), axis_(a.unit_vector("axis")) {
    if (a.has("through")) through_ = a.vector("through");
  }

  std::string acts_on() const override { return "a face"; }
  bool can_act_on(const Target& target) const override { return is_face(target); }
  bool is_everywhere() const override { return false; }
  const char* unit() const override { return "N m"; }
  std::optional<Complaint> complaint(const Step&) const override { return std::nullopt; }
  std::vector<Effect> effects() const override {
    std::vector<Effect> all = nodal_forces([axis = axis_, through = through_](const LoadedNodes& nodes, size_t) {
      const Vec3 centre = through.value_or(nodes.positions * nodes.weights / nodes.weights.sum());
      const Vec3 turn = through ? axis : turn_of(axis, nodes, centre);
      Points forces(3, nodes.positions.cols());
      double moment = 0.0;
      for (int i = 0; i < forces.cols(); ++i) {
        forces.col(i) = turn.cross(Vec3(nodes.moments.col(i) - nodes.weights[i] * centre));
        moment += forces.col(i).dot(axis.cross(Vec3(nodes.positions.col(i) - centre)));
      }
      return Points(forces / moment);
    });
    for (Effect& effect : all)  // about another axis is another value
      for (const auto& [name, numbers] : settings())
        std::get<NodalForces>(effect).name += fmt::format(" {} {}", name, fmt::join(numbers, " "));
    return all;
  }
  Settings settings() const override {
    Settings all = {{"axis", {axis_[0], axis_[1], axis_[2]}}};
    if (through_) all.push_back({"through", {(*through_)[0], (*through_)[1], (*through_)[2]}});
    return all;
  }

 private:
  Vec3 axis_;                    // unit
  std::optional<Vec3> through_;  // m; none: the centroid of the face
};

}  // namespace

namespace loads {
LoadEntry torque() { return {"torque", new_load<Torque>}; }
}  // namespace loads

}  // namespace dygita
