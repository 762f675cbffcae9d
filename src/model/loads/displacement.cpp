// load.displacement: a displacement that nodes are given; a direction left out is free.
#include "model/load.hpp"

namespace dygita {

namespace {

class Displacement final : public Load {
 public:
  explicit Displacement(const ModelArguments& a) : Load(a, axis_values(a)) {}

  std::string acts_on() const override { return "a face or a region"; }
  bool can_act_on(const Target& target) const override { return is_place(target); }
  bool is_everywhere() const override { return false; }
  const char* unit() const override { return "m"; }
  std::optional<Complaint> complaint(const Step&) const override { return std::nullopt; }
  std::vector<Effect> effects() const override {
    std::vector<Effect> all;
    for (const Target& target : on)
      all.push_back(PrescribedMotion{path, place(target), false, {values[0], values[1], values[2]}});
    return all;
  }
  Settings settings() const override { return {}; }
};

}  // namespace

namespace loads {
LoadEntry displacement() { return {"displacement", new_load<Displacement>}; }
}  // namespace loads

}  // namespace dygita
