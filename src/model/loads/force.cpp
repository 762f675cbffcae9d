// load.force: a force in all, spread evenly over an area or over nodes.
#include "model/load.hpp"

namespace dygita {

namespace {

class Force final : public Load {
 public:
  explicit Force(const ModelArguments& a) : Load(a, axis_values(a)) {}

  std::string acts_on() const override { return "a face or a region"; }
  bool can_act_on(const Target& target) const override { return is_place(target); }
  bool is_everywhere() const override { return false; }
  const char* unit() const override { return "N"; }
  std::optional<Complaint> complaint(const Step&) const override { return std::nullopt; }
  std::vector<Effect> effects() const override {
    return nodal_forces([](const LoadedNodes& nodes, size_t axis) -> Points {
      return Vec3::Unit(static_cast<int>(axis)) * (nodes.weights / nodes.weights.sum()).transpose();
    });
  }
  Settings settings() const override { return {}; }
};

}  // namespace

namespace loads {
LoadEntry force() { return {"force", new_load<Force>}; }
}  // namespace loads

}  // namespace dygita
