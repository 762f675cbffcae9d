#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "law/law.hpp"
#include "mesh/face_nodes.hpp"
#include "model/check.hpp"
#include "model/load.hpp"
#include "model/output.hpp"

namespace dygita::check {

namespace {

bool is_touched(const Problem& problem, const SubstructurePtr& part) {
  for (const InterfacePtr& interface : problem.interfaces) {
    if (interface->side_1.part == part || interface->side_2.part == part) return true;
  }
  for (const SupportPtr& support : all_supports(problem)) {
    for (const FaceOrRegion& place : support->on) {
      if (&part_of(place) == part.get()) return true;
    }
  }
  for (const StepPtr& step : problem.steps) {
    for (const LoadPtr& load : step->loads) {
      for (const Target& target : load->on) {
        const auto place = place_of(target);
        if (place && &part_of(*place) == part.get()) return true;
      }
    }
  }
  return false;
}

void doubt_supports(const Problem& problem, bool moves) {
  for (const SupportPtr& support : problem.supports) {
    const bool is_used = std::any_of(problem.steps.begin(), problem.steps.end(), [&](const StepPtr& step) {
      return index_of(supports_of(problem, *step), support.get()) >= 0;
    });
    if (!is_used) {
      doubt(problem, support->origin, describe(*support) + " holds in no step: every step has 'supports' of its own");
    }
  }
  if (moves) return;
  for (const SupportPtr& support : all_supports(problem)) {
    if (!support->kind->absorbs()) continue;
    doubt(problem, support->origin, describe(*support) + " acts like a fixed one: there is no dynamic step");
  }
}

// Extent of a face's part along the face's mean normal (m).
double length_behind(const Face& face) {
  const Points& x = face.part->mesh->nodes;
  Vec3 area = Vec3::Zero();
  for (const Facet& facet : face.facets()) area += facet_area_vector(x, facet);
  const Eigen::RowVectorXd along = area.normalized().transpose() * x;
  return along.maxCoeff() - along.minCoeff();
}

// A traction per length times the length of what yields is a plastic modulus: below a thousandth of Young's it is no
// metal's, and hardly what was meant.
void doubt_hardening(const Problem& problem, const Interface& interface) {
  for (const LawParameter& parameter : interface.law->parameters()) {
    const double* value = std::get_if<double>(&parameter.value);
    if (parameter.unit != "Pa/m" || !value || *value <= 0.0) continue;
    const bool first = length_behind(interface.side_1) >= length_behind(interface.side_2);
    const Face& face = first ? interface.side_1 : interface.side_2;
    const double length = length_behind(face), young = face.part->material.young, modulus = *value * length;
    if (modulus >= 1e-3 * young) continue;
    doubt(problem, interface.origin,
          fmt::format("{}: '{}' = {:g} Pa/m over the {:.4g} mm of '{}' is a plastic modulus of {:.3g} MPa, {:.2g} % of "
                      "its Young's "
                      "modulus; it is H/L, for a modulus H over a length L: is the division by L missing?",
                      describe(interface), parameter.name, *value, 1e3 * length, face.part->name, 1e-6 * modulus,
                      100.0 * modulus / young));
  }
}

}  // namespace

void doubts(const Problem& problem) {
  const bool moves = has_dynamic_step(problem);
  const bool has_spectrum = std::any_of(problem.outputs.begin(), problem.outputs.end(),
                                        [](const OutputPtr& output) { return output->settles(); });
  if (problem.solver.spectra > 0.0 && !has_spectrum)
    doubt(
        problem, problem.origin,
        "'spectra' of solver.latin waits for spectra to stand still, and no output.srs is asked for: one pass is run");
  for (const SubstructurePtr& part : problem.substructures) {
    const std::string who = "substructure '" + part->name + "'";
    if (!is_touched(problem, part)) doubt(problem, part->origin, "no interface, support or load touches " + who);
    if (!moves && !part->velocity.isZero()) {
      doubt(problem, part->origin, "the velocity of " + who + " is not used: there is no dynamic step");
    }
  }
  doubt_supports(problem, moves);
  for (const InterfacePtr& interface : problem.interfaces) doubt_hardening(problem, *interface);
  for (const OutputPtr& output : problem.outputs) output->doubt(problem);
}

}  // namespace dygita::check
