// Only the fields asked for are computed.
#include "result/frames.hpp"

#include <algorithm>
#include <map>

#include "fem/assembly.hpp"
#include "fem/stress_error.hpp"
#include "law/law.hpp"

namespace dygita {

namespace {

PartFrame part_frame(const Instant& instant, int part, const std::vector<std::string>& fields) {
  const Substructure& body = *instant.model.problem->substructures[part];
  PartFrame frame;
  frame.part = &body;
  frame.displacement = instant.displacement(part);
  const auto wants = [&](const char* name) { return std::find(fields.begin(), fields.end(), name) != fields.end(); };
  Tensors stress;
  if (wants("stress") || wants("von_mises")) stress = nodal_stress(*body.mesh, body.material, frame.displacement);
  for (const std::string& name : fields) {
    if (name == "displacement") frame.fields.push_back({name, frame.displacement});
    if (name == "velocity") frame.fields.push_back({name, instant.velocity(part)});
    if (name == "acceleration") frame.fields.push_back({name, instant.acceleration(part)});
    if (name == "stress") frame.fields.push_back({name, stress});
    if (name == "stress_error")
      frame.fields.push_back({name, stress_error(*body.mesh, body.material, frame.displacement).at_nodes.transpose()});
    if (name == "von_mises") frame.fields.push_back({name, von_mises(stress).transpose()});
  }
  return frame;
}

InterfaceFrame interface_frame(const Instant& instant, int s, const FollowedMotion& motion) {
  const Surface& surface = (*instant.model.surfaces)[s];
  const std::vector<LawState>& state = instant.state.surfaces[s].points;
  const Shown shown = surface.declared_law().shown();
  const int n = surface.n_points();
  InterfaceFrame frame;
  frame.name = surface.name();
  frame.points = surface.facing.places;
  frame.facets = surface.facing.facets;
  Mat pressure(1, n), gap(1, n), plastic(1, n), status(1, n), residual(1, n), slips(3, n), traction(3, n),
      displacement(3, n);
  const Points u = instant.displacement(surface.part_1);
  for (int i = 0; i < n; ++i) {
    const Vec3 normal = surface.facing.normals.col(i);
    const Vec3 t = state[i].force / surface.facing.areas[i];
    pressure(0, i) = -t.dot(normal);
    traction.col(i) = t - t.dot(normal) * normal;
    gap(0, i) = shown.gap                                      ? state[i].gap
                : shown.followed == Followed::opening_and_slip ? motion.opening(instant, s, i)
                                                               : 0.0;
    plastic(0, i) = state[i].plastic_opening;
    slips.col(i) = motion.slip(instant, s, i);
    status(0, i) = static_cast<double>(state[i].status);
    residual(0, i) = instant.state.surfaces[s].residual[i] / surface.facing.areas[i];
    displacement.col(i) = surface.facing.side_1.at(i, u);
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
  for (size_t i = 0; i < instant.model.problem->substructures.size(); ++i)
    frame.parts.push_back(part_frame(instant, static_cast<int>(i), fields));
  for (size_t s = 0; s < instant.model.surfaces->size(); ++s)
    frame.interfaces.push_back(interface_frame(instant, static_cast<int>(s), motion));
  return frame;
}

}  // namespace dygita
