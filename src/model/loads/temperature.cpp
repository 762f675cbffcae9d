// load.temperature: parts warmer than they were made grow, or are stressed where they cannot (manual, eq. S8).
#include <spdlog/fmt/fmt.h>

#include "mesh/face_nodes.hpp"
#include "model/growth.hpp"
#include "model/load.hpp"

namespace dygita {

namespace {

class Temperature final : public Load {
 public:
  explicit Temperature(const ModelArguments& a)
      : Load(a, one_value(a, "by")), parts_(a.substructures("parts")), expansion_(a.number("expansion")) {
    for (const SubstructurePtr& part : parts_) {
      if (!part->mesh->has_cells())
        throw InputError(
            fmt::format("'{}' has no cells, and what it would do with temperature is not known", part->name));
      if (!part->material.is_isotropic())
        throw InputError(
            fmt::format("the material '{}' of '{}' has directions, and 'expansion' is one number for all of them",
                        part->material.name, part->name));
    }
  }

  std::string acts_on() const override { return "the substructures of 'parts', without 'on'"; }
  bool can_act_on(const Target&) const override { return false; }
  bool is_everywhere() const override { return true; }
  const char* unit() const override { return "K"; }
  std::optional<Complaint> complaint(const Step&) const override { return std::nullopt; }
  // The forces of the stress that would keep the part from growing, of opposite sign: those of a pull on all of its
  // surface.
  std::vector<Effect> effects() const override {
    std::vector<Effect> all;
    for (const SubstructurePtr& part : parts_) {
      const FaceNodes boundary = face_nodes(*part->mesh, boundary_facets(*part->mesh));
      const double pull = 3 * part->material.tensor().bulk_modulus() * expansion_;
      all.push_back(NodalForces{growth_name(expansion_), Region{part, boundary.nodes}, *values.front(),
                                [forces = Points(pull * boundary.vectors)](const LoadedNodes&) { return forces; }});
    }
    return all;
  }
  Settings settings() const override { return {{"expansion", {expansion_}}}; }

 private:
  std::vector<SubstructurePtr> parts_;
  double expansion_;  // 1/K
};

}  // namespace

namespace loads {
LoadEntry temperature() { return {"temperature", new_load<Temperature>}; }
}  // namespace loads

}  // namespace dygita
