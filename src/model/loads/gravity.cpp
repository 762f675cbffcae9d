// load.gravity: a uniform acceleration of every substructure.
#include "model/load.hpp"

namespace dygita {

namespace {

class Gravity final : public Load {
 public:
  explicit Gravity(const ModelArguments& a) : Load(a, axis_values(a)) {}

  std::string acts_on() const override { return "every substructure, without 'on'"; }
  bool can_act_on(const Target&) const override { return false; }
  bool is_everywhere() const override { return true; }
  const char* unit() const override { return "m/s^2"; }
  std::optional<Complaint> complaint(const Step&) const override { return std::nullopt; }
  std::vector<Effect> effects() const override {
    std::vector<Effect> all;
    for (size_t axis = 0; axis < values.size(); ++axis)
      if (values[axis])
        all.push_back(BodyForce{name_of(axis), *values[axis],
                                [axis](const Vec3&) -> Vec3 { return Vec3::Unit(static_cast<int>(axis)); }});
    return all;
  }
  Settings settings() const override { return {}; }
};

}  // namespace

namespace loads {
LoadEntry gravity() { return {"gravity", new_load<Gravity>}; }
}  // namespace loads

}  // namespace dygita
