// load.traction: force per area, in fixed directions.
#include "model/load.hpp"

namespace dygita {

namespace {

class Traction final : public Load {
 public:
  explicit Traction(const ModelArguments& a) : Load(a, axis_values(a)) {}

  std::string acts_on() const override { return "a face"; }
  bool can_act_on(const Target& target) const override { return is_face(target); }
  bool is_everywhere() const override { return false; }
  const char* unit() const override { return "Pa"; }
  std::optional<Complaint> complaint(const Step&) const override { return std::nullopt; }
  std::vector<Effect> effects() const override {
    return nodal_forces([](const LoadedNodes& nodes, size_t axis) -> Points {
      return Vec3::Unit(static_cast<int>(axis)) * nodes.weights.transpose();
    });
  }
  Settings settings() const override { return {}; }
};

}  // namespace

namespace loads {
LoadEntry traction() { return {"traction", new_load<Traction>}; }
}  // namespace loads

}  // namespace dygita
