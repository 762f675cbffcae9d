// load.torque: a moment about an axis, spread over a face as tractions around the axis that grow with the radius
// (manual, eq. S8).
#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>

#include "model/load.hpp"

namespace dygita {

namespace {

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
      Points forces(3, nodes.positions.cols());
      double moment = 0.0;
      for (int i = 0; i < forces.cols(); ++i) {
        const Vec3 around = axis.cross(nodes.positions.col(i) - centre);
        forces.col(i) = nodes.weights[i] * around;
        moment += nodes.weights[i] * around.squaredNorm();
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
