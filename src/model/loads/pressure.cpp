// load.pressure: against the outward normal, so that a positive one pushes.
#include "model/load.hpp"

namespace dygita {

namespace {

class Pressure final : public Load {
 public:
  explicit Pressure(const ModelArguments& a) : Load(a, one_value(a, "history")) {}

  std::string acts_on() const override { return "a face"; }
  bool can_act_on(const Target& target) const override { return is_face(target); }
  bool is_everywhere() const override { return false; }
  const char* unit() const override { return "Pa"; }
  std::optional<Complaint> complaint(const Step&) const override { return std::nullopt; }
  std::vector<Effect> effects() const override {
    return nodal_forces([](const LoadedNodes& nodes, size_t) -> Points { return -nodes.vectors; });
  }
  Settings settings() const override { return {}; }
};

}  // namespace

namespace loads {
LoadEntry pressure() { return {"pressure", new_load<Pressure>}; }
}  // namespace loads

}  // namespace dygita
