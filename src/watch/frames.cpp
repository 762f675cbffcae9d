// Only the fields asked for are computed.
#include "watch/frames.hpp"

#include <algorithm>
#include <limits>

#include "fem/own_stress.hpp"
#include "fem/stress_error.hpp"
#include "law/law.hpp"
#include "watch/growth.hpp"

namespace dygita {

namespace {

constexpr double not_there = std::numeric_limits<double>::quiet_NaN();  // of a part whose material has no such field

InterfaceFrame interface_frame(const Instant& instant, int s, const FollowedMotion& motion) {
  const Surface& surface = (*instant.model.surfaces)[s];
  const std::vector<LawState>& state = instant.surface(s).points;
  const Shown shown = surface.declared_law().shown();
  const int n = surface.n_points();
  InterfaceFrame frame;
  frame.name = surface.name();
  frame.points = surface.facing.places;
  frame.facets = surface.facing.facets;
  Mat pressure(1, n), gap(1, n), plastic(1, n), status(1, n), residual(1, n), slips(3, n), traction(3, n),
      displacement(3, n);
  const Points u = MovedSide(surface, 1).displacement(instant);
  for (int i = 0; i < n; ++i) {
    const Vec3 normal = surface.facing.normals.col(i);
    const Vec3 t = state[i].force / surface.facing.areas[i];
    pressure(0, i) = -t.dot(normal);
    traction.col(i) = t - t.dot(normal) * normal;
    if (shown.followed == Followed::opening_and_slip)
      gap(0, i) = motion.opening(instant, s, i);
    else
      gap(0, i) = (shown.gap ? state[i].gap : 0.0) + motion.parted(instant, s, i);
    plastic(0, i) = state[i].plastic_opening;
    slips.col(i) = motion.slip(instant, s, i);
    status(0, i) = static_cast<double>(state[i].status);
    residual(0, i) = instant.surface(s).residual[i] / surface.facing.areas[i];
    displacement.col(i) = u.col(i);
  }
  frame.fields = {{"displacement", displacement},
                  {"pressure", pressure},
                  {"gap", gap},
                  {"slip", slips},
                  {"friction_traction", traction},
                  {"plastic_opening", plastic},
                  {"state", status},
                  {"constitutive_error", residual}};
  return frame;
}

}  // namespace

Frame make_frame(const Instant& instant, const std::vector<std::string>& fields, const FollowedMotion& motion) {
  Frame frame;
  frame.time = instant.time();
  frame.step = instant.model.step->name;
  for (const SubstructurePtr& part : instant.model.problem->substructures) {
    PartFrame& of_part = frame.parts.emplace_back();
    of_part.part = part.get();
    for (const std::string& name : fields) of_part.fields.push_back({name, {}});
  }
  for (size_t s = 0; s < instant.model.surfaces->size(); ++s)
    frame.interfaces.push_back(interface_frame(instant, static_cast<int>(s), motion));
  return frame;
}

int components_of(const std::string& field) {
  if (field == "stress" || field == "material_stress") return 6;
  return field == "von_mises" || field == "stress_error" || field == "failure_index" ? 1 : 3;
}

void fill_part(const Mesh& mesh, const NodalMotion& motion, const std::vector<FreeCell>& free, PartFrame& frame) {
  const Elastic& material = frame.part->material;
  const auto wants = [&](const char* name) {
    return std::any_of(frame.fields.begin(), frame.fields.end(), [&](const NamedField& f) { return f.name == name; });
  };
  frame.displacement = motion.displacement;
  const Points strained = without_growth(motion.displacement, motion.growth, mesh.nodes);
  Tensors stress;
  if (wants("stress") || wants("von_mises")) stress = nodal_stress(mesh, material, strained);
  for (auto& [name, values] : frame.fields) {
    if (name == "displacement") values = motion.displacement;
    if (name == "velocity") values = motion.velocity;
    if (name == "acceleration") values = motion.acceleration;
    if (name == "stress") values = stress;
    if (name == "stress_error") values = stress_error(mesh, material, strained, free).at_nodes.transpose();
    if (name == "material_stress")
      values = material.is_isotropic() ? Mat(Mat::Constant(6, mesh.n_nodes(), not_there))
                                       : Mat(own_stress(mesh, material, strained));
    if (name == "failure_index")
      values = material.has_strength() ? Mat(nodal_failure(mesh, material, strained).index.transpose())
                                       : Mat(Mat::Constant(1, mesh.n_nodes(), not_there));
    if (name == "von_mises") values = von_mises(stress).transpose();
  }
}

}  // namespace dygita
