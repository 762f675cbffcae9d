// load.spin: what turns with a steady speed about an axis is pulled away from it (manual, eq. S8).
#include "model/load.hpp"

namespace dygita {

namespace {

class Spin final : public Load {
 public:
  explicit Spin(const ModelArguments& a) : Spin(a, a.number("speed")) {}

  std::string acts_on() const override { return "every substructure, without 'on'"; }
  bool can_act_on(const Target&) const override { return false; }
  bool is_everywhere() const override { return true; }
  const char* unit() const override { return "rad^2/s^2"; }
  // In motion Coriolis' forces would be missing.
  std::optional<Complaint> complaint(const Step& step) const override {
    return static_only(step, "a rotor that vibrates feels Coriolis' forces, which this program does not have");
  }
  std::vector<Effect> effects() const override {
    return {BodyForce{path, *values.front(), [axis = axis_, through = through_](const Vec3& position) -> Vec3 {
                        const Vec3 arm = position - through;
                        return arm - axis * axis.dot(arm);
                      }}};
  }
  Settings settings() const override {
    return {{"speed", {speed_}},
            {"axis", {axis_[0], axis_[1], axis_[2]}},
            {"through", {through_[0], through_[1], through_[2]}}};
  }

 private:
  Spin(const ModelArguments& a, double speed)
      : Load(a, {TimeValue{History::constant(speed * speed), true}}),
        speed_(speed),
        axis_(a.unit_vector("axis")),
        through_(a.vector("through")) {}

  double speed_;         // rad/s
  Vec3 axis_, through_;  // unit; m
};

}  // namespace

namespace loads {
LoadEntry spin() { return {"spin", new_load<Spin>}; }
}  // namespace loads

}  // namespace dygita
