// load.force: a force in all, spread evenly over the area of all faces, or over all nodes of all regions.
#include <algorithm>

#include "mesh/face_nodes.hpp"
#include "model/load.hpp"

namespace dygita {

namespace {

class Force final : public Load {
 public:
  explicit Force(const ModelArguments& a) : Load(a, axis_values(a)) {
    const auto n_faces = std::count_if(on.begin(), on.end(), is_face);
    if (n_faces > 0 && n_faces < static_cast<long>(on.size()))
      throw InputError(
          "load.force is spread over the area of faces or over the nodes of regions, not both: use a separate load for "
          "each kind");
  }

  std::string acts_on() const override { return "a face or a region"; }
  bool can_act_on(const Target& target) const override { return is_place(target); }
  bool is_everywhere() const override { return false; }
  const char* unit() const override { return "N"; }
  std::optional<Complaint> complaint(const Step&) const override { return std::nullopt; }
  std::vector<Effect> effects() const override {
    const double all = size_of_all();
    return nodal_forces([all](const LoadedNodes& nodes, size_t axis) -> Points {
      return Vec3::Unit(static_cast<int>(axis)) * (nodes.weights / all).transpose();
    });
  }
  Settings settings() const override { return {}; }

 private:
  // m^2, or the number of nodes: what LoadedNodes weighs.
  double size_of_all() const {
    double all = 0.0;
    for (const Target& target : on) {
      if (const Face* face = std::get_if<Face>(&target))
        all += face_nodes(*face->part->mesh, face->facets()).areas.sum();
      else if (const Region* region = std::get_if<Region>(&target))
        all += static_cast<double>(region->nodes.size());
    }
    return all;
  }
};

}  // namespace

namespace loads {
LoadEntry force() { return {"force", new_load<Force>}; }
}  // namespace loads

}  // namespace dygita
