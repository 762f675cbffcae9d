// load.mode: forces in the shape of a mode, mass times shape times an acceleration (manual, eq. D17).
#include "model/load.hpp"
#include "model/mode_forces.hpp"
#include "model/output.hpp"

namespace dygita {

namespace {

class ModeLoad final : public Load {
 public:
  explicit ModeLoad(const ModelArguments& a)
      : Load(a, one_value(a, "value")),
        modes_(a.output("mode")),
        shapes_(dynamic_cast<const ModeShapes*>(modes_.get())),
        number_(a.integer("number")),
        parts_(a.substructures("parts")) {
    CHECK(shapes_, "'mode' of load.mode is no output of modes");
  }

  std::string acts_on() const override { return "the substructures of 'parts', without 'on'"; }
  bool can_act_on(const Target&) const override { return false; }
  bool is_everywhere() const override { return true; }
  const char* unit() const override { return "m/s^2"; }
  std::optional<Complaint> complaint(const Step&) const override { return std::nullopt; }
  std::vector<Effect> effects() const override {
    std::vector<Effect> all;
    for (const SubstructurePtr& part : parts_) {
      Region region{part, {}};
      for (int node = 0; node < part->mesh->n_nodes(); ++node) region.nodes.push_back(node);
      all.push_back(NodalForces{path + " " + std::to_string(number_), region, *values.front(),
                                [shapes = shapes_, part, number = number_](const LoadedNodes&) {
                                  return shapes->mass_times_shape(*part, number);
                                }});
    }
    return all;
  }
  OutputPtr made_of() const override { return modes_; }
  Settings settings() const override { return {{"number", {static_cast<double>(number_)}}}; }

 private:
  OutputPtr modes_;  // has the shapes
  const ModeShapes* shapes_;
  int number_;
  std::vector<SubstructurePtr> parts_;
};

}  // namespace

namespace loads {
LoadEntry mode() { return {"mode", new_load<ModeLoad>}; }
}  // namespace loads

}  // namespace dygita
