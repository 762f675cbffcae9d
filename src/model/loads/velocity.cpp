// load.velocity: a velocity that nodes are given; a direction left out is free.
#include "model/load.hpp"

namespace dygita {

namespace {

class Velocity final : public Load {
 public:
  explicit Velocity(const ModelArguments& a) : Load(a, axis_values(a)) {}

  std::string acts_on() const override { return "a face or a region"; }
  bool can_act_on(const Target& target) const override { return is_place(target); }
  bool is_everywhere() const override { return false; }
  const char* unit() const override { return "m/s"; }
  std::optional<Complaint> complaint(const Step& step) const override {
    return dynamic_only(step, "a static step has no physical time: use load.displacement");
  }
  std::vector<Effect> effects() const override {
    std::vector<Effect> all;
    for (const Target& target : on)
      all.push_back(PrescribedMotion{path, place(target), true, {values[0], values[1], values[2]}});
    return all;
  }
  Settings settings() const override { return {}; }
};

}  // namespace

namespace loads {
LoadEntry velocity() { return {"velocity", new_load<Velocity>}; }
}  // namespace loads

}  // namespace dygita
