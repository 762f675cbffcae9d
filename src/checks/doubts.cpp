// What a problem says that its author may not mean: warnings before anything is computed. A list of short doubts that
// have nothing in common but being asked in one order; hence longer than most.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>

#include "base/overloaded.hpp"
#include "base/warnings.hpp"
#include "checks/parts.hpp"
#include "law/law.hpp"
#include "material/layup.hpp"
#include "material/strip_stiffness.hpp"
#include "mesh/condensed_body.hpp"
#include "mesh/face_nodes.hpp"
#include "mesh/mean_nodes.hpp"
#include "model/growth.hpp"
#include "model/joint_path.hpp"
#include "model/load.hpp"
#include "model/output.hpp"
#include "model/places.hpp"

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
      for (const Effect& effect : load->effects())  // of a load that chooses its own places
        if (const auto* forces = std::get_if<NodalForces>(&effect); forces && &part_of(forces->on) == part.get())
          return true;
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
      doubt(problem, support->origin, describe(*support) + " is not used: every step has its own 'supports'");
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
  if (!interface.law->shown().plastic_opening) return;
  for (const LawParameter& parameter : interface.law->parameters()) {
    const double* value = std::get_if<double>(&parameter.value);
    if (parameter.unit != "Pa/m" || !value || *value <= 0.0) continue;
    const bool first = length_behind(interface.side_1) >= length_behind(interface.side_2);
    const Face& face = first ? interface.side_1 : interface.side_2;
    if (!face.part->mesh->has_cells()) continue;
    const double length = length_behind(face), young = face.part->material.young(), modulus = *value * length;
    if (modulus >= 1e-3 * young) continue;
    doubt(problem, interface.origin,
          fmt::format("{}: '{}' = {:g} Pa/m over the {:.4g} mm of '{}' is a plastic modulus of {:.3g} MPa, {:.2g} % of "
                      "its Young's "
                      "modulus; it is H/L, for a modulus H over a length L: was the division by L forgotten?",
                      describe(interface), parameter.name, *value, 1e3 * length, face.part->name, 1e-6 * modulus,
                      100.0 * modulus / young));
  }
}

// Mass damping brakes whatever moves, a body that does not deform too.
void doubt_mass_damping(const Problem& problem) {
  double duration = 0.0;
  bool moves_freely = std::any_of(problem.substructures.begin(), problem.substructures.end(),
                                  [](const SubstructurePtr& part) { return !part->velocity.isZero(); });
  for (const StepPtr& step : problem.steps) {
    if (step->is_static) continue;
    duration += step->duration;
    const std::vector<SupportPtr>& supports = supports_of(problem, *step);
    moves_freely |= std::none_of(supports.begin(), supports.end(), [](const SupportPtr& support) {
      return support->kind->holds(false) != Directions::none;
    });
    for (const LoadPtr& load : step->loads)
      for (const Effect& effect : load->effects())
        moves_freely |= std::holds_alternative<BaseMotion>(effect) || std::holds_alternative<PrescribedMotion>(effect);
  }
  if (!moves_freely || duration == 0.0) return;
  std::set<std::string> told;
  for (const SubstructurePtr& part : problem.substructures) {
    const double lost = 1.0 - std::exp(-part->material.damping.mass * duration);
    if (lost < 1e-3 || !told.insert(part->material.name).second) continue;
    doubt(
        problem, part->origin,
        fmt::format("damping of material '{}' at two frequencies has a mass-proportional part, {:.3g} 1/s, which also "
                    "damps rigid motion: {:.2g} % of a free velocity in the {:.3g} ms of the dynamic steps, and a "
                    "force that shows in reactions and momentum; a ratio at one frequency has no such part",
                    part->material.name, part->material.damping.mass, 100.0 * lost, 1e3 * duration));
  }
}

// In one cell all plies have one shear stress across, or one linear from face to face: a core carries it by itself.
void doubt_layups(const Problem& problem) {
  constexpr double most = 0.03, wave = 9.87;  // of the deflection of half a sine over the length; pi^2
  for (const SubstructurePtr& part : problem.substructures) {
    const auto& layup = part->material.layup;
    if (!layup || !part->mesh->has_cells() || part->mesh->blocks.front().axes.empty()) continue;
    const Points along = part->mesh->blocks.front().axes.front().transpose() * part->mesh->nodes;
    const Vec3 extent = along.rowwise().maxCoeff() - along.rowwise().minCoeff();
    const int direction = extent[0] >= extent[1] ? 0 : 1;
    const double length = extent[direction];
    const StripStiffness strip = strip_of(*layup, direction);
    const double bends = length * length / (wave * strip.bending), shears = 1.0 / strip.shear;
    const double lost = (shears - 1.0 / strip.shear_of_one_stress) / (bends + shears);
    if (!(lost > most)) continue;
    double softest = std::numeric_limits<double>::infinity(), stiffest = 0.0;  // Pa
    for (int i = 0; i < layup->n_plies(); ++i) {
      const int row = direction == 0 ? 2 : 1;
      softest = std::min(softest, 1.0 / layup->law(i).s(row, row));
      stiffest = std::max(stiffest, 1.0 / layup->law(i).s(row, row));
    }
    doubt(problem, part->origin,
          fmt::format("substructure '{}': layup '{}' is one cell across, which makes it up to {:.2g} % too stiff where "
                      "it bends over its {:.4g} mm: shear across the plies is {:.0f} % of the deflection, and one cell "
                      "gives all plies the same shear stress (their moduli are 1 : {:.3g}); model the core, or each "
                      "half, as a part of its own with several cells across, joined by interface.bonded",
                      part->name, part->material.name, 100.0 * lost, 1e3 * length, 100.0 * shears / (bends + shears),
                      stiffest / softest),
          {"layup in one cell", lost, "'" + part->name + "'"});
  }
}

// Constant damping implies a stiffness that grows with frequency (causality).
void doubt_stiffening(const Problem& problem) {
  constexpr double least = 0.01;  // of a natural frequency
  std::set<std::string> told;
  for (const SubstructurePtr& part : problem.substructures) {
    const Damping& damping = part->material.damping;
    if (!damping.band || !told.insert(part->material.name).second) continue;
    const auto [low, high] = *damping.band;
    const auto shift = [&](double f) { return std::sqrt(damping.storage(f)) - 1.0; };
    if (std::max(std::abs(shift(low)), std::abs(shift(high))) < least) continue;
    doubt(problem, part->origin,
          fmt::format("constant damping of material '{}' stiffens it with frequency, as causality has it: natural "
                      "frequencies are {:.1f} % low near {:g} Hz and {:.1f} % high near {:g} Hz, right at {:.4g} Hz; "
                      "static steps have the modulus as given, slow loads in dynamic ones {:.1f} % less, so that what "
                      "is let go of a static load comes to rest beyond its unloaded shape, by {:.1f} % of the way",
                      part->material.name, -100.0 * shift(low), low, 100.0 * shift(high), high, std::sqrt(low * high),
                      100.0 * (1.0 - damping.storage(0.0)), 100.0 * (1.0 / damping.storage(0.0) - 1.0)));
  }
}

// Sound that creeps: a modulus in the wrong unit.
void doubt_moduli(const Problem& problem) {
  const double slowest = 300.0;
  std::set<std::string> told;
  for (const SubstructurePtr& part : problem.substructures) {
    const auto& material = part->material;
    const double speed = std::sqrt(material.young() / material.density);  // nan: there is no material
    if (!part->mesh->has_cells()) continue;
    if (!(speed < slowest) || !told.insert(material.name).second) continue;
    doubt(problem, part->origin,
          fmt::format("a bar of material '{}' (young {:.4g} GPa, density {:.4g} kg/m^3) has a wave speed of {:.3g} "
                      "m/s, like rubber: is the modulus in GPa?",
                      material.name, material.young() / 1e9, material.density, speed));
  }
}

// Far more than a bolt can be stretched by.
// How many times the second moment of area of a face its points have, about an axis of the deck: 1 + 2/n^2 for n facets
// across.
double spread_of_points(const Face& face) {
  const Points& x = face.part->mesh->nodes;
  const FaceNodes nodes = face_nodes(*face.part->mesh, face.facets());
  const Mat3 exact = mean_nodes(nodes, x).inertia, at_nodes = mean_nodes(nodes.nodes, nodes.areas, x).inertia;
  double most = 1.0;
  for (int i = 0; i < 3; ++i)
    if (exact(i, i) > 1e-6 * exact.trace()) most = std::max(most, at_nodes(i, i) / exact(i, i));
  return most;
}

void doubt_isolators(const Problem& problem) {
  constexpr double good = 1.15;
  for (const InterfacePtr& interface : problem.interfaces) {
    if (!is_isolator(*interface) || interface->means || interface->cyclic) continue;
    const double spread = std::min(spread_of_points(interface->side_1), spread_of_points(interface->side_2));
    if (spread > good)
      doubt(problem, interface->origin,
            fmt::format("{} acts at the nodes of few facets, and resists rotation {:.2g} times as much as a layer "
                        "spread over the face; refine one of its faces (n facets across: 2/n^2 too much)",
                        describe(*interface), spread));
  }
}

void doubt_shortenings(const Problem& problem) {
  const double most = 0.02;  // of the longer of the two parts: steel is at 4 GPa
  for (const StepPtr& step : problem.steps)
    for (const LoadPtr& load : step->loads)
      for (const Effect& effect : load->effects()) {
        const auto* shortening = std::get_if<Shortening>(&effect);
        if (!shortening) continue;
        const double length = std::max(length_behind(shortening->on->side_1), length_behind(shortening->on->side_2)),
                     by = shortening->value.history.value(1.0);
        if (std::abs(by) <= most * length) continue;
        doubt(problem, load->origin,
              fmt::format("step '{}': {} of {:.4g} mm on {} is {:.2g} % of the {:.4g} mm of the longer part it joins, "
                          "beyond any bolt; was a unit forgotten?",
                          step->name, load->path, 1e3 * by, describe(*shortening->on), 100.0 * std::abs(by) / length,
                          1e3 * length));
      }
}

// Substructures on either side of what is tightened.
std::vector<SubstructurePtr> tightened_parts(const Problem& problem) {
  std::vector<SubstructurePtr> parts;
  for (const StepPtr& step : problem.steps)
    for (const LoadPtr& load : step->loads)
      for (const Effect& effect : load->effects())
        if (const Tightening* bolt = tightening(effect))
          for (const SubstructurePtr& part : {bolt->on->side_1.part, bolt->on->side_2.part})
            if (std::find(parts.begin(), parts.end(), part) == parts.end()) parts.push_back(part);
  return parts;
}

// A whole bolt in half a model carries twice what it should, or is tightened to half of it.
void doubt_whole_bolts(const Problem& problem, const Support& support, const Face& face) {
  constexpr double beyond = 0.1;  // of what lies on one side
  Vec3 area = Vec3::Zero();
  for (const Facet& facet : face.facets()) area += facet_area_vector(face.part->mesh->nodes, facet);
  const Vec3 outwards = area.normalized();
  const Vec3 place = face.part->mesh->nodes.col(face.facets().front().nodes()[0]) + face.part->place;
  for (const SubstructurePtr& part : tightened_parts(problem)) {
    const Eigen::RowVectorXd out =
        (outwards.transpose() * part->mesh->nodes).array() + outwards.dot(part->place - place);
    const double far = out.maxCoeff(), near = -out.minCoeff();
    if (part == face.part || far <= beyond * near || near <= beyond * far) continue;
    doubt(problem, support.origin,
          fmt::format("'{}', which a load tightens, lies on both sides of the plane of {}, {:.3g} mm beyond it: in a "
                      "half model, model half of a bolt on the plane, with half its preload",
                      part->name, describe(support), 1e3 * far),
          {"whole bolt", far, "'" + part->name + "'", true});
  }
}

// A rigid body on a face that ends on the plane moves across it and turns out of it, which its other half would not let
// it.
void doubt_rigid_bodies(const Problem& problem, const Support& support, const Face& face) {
  const std::vector<int> on_plane = nodes_at(face);
  for (const InterfacePtr& interface : problem.interfaces)
    for (const auto& [body, other] :
         {std::pair{&interface->side_1, &interface->side_2}, {&interface->side_2, &interface->side_1}}) {
      const CondensedBody* matrices = body->part->mesh->inside->matrices();
      if (!matrices || !matrices->is_rigid() || other->part != face.part) continue;
      std::vector<int> shared;
      const std::vector<int> joined = nodes_at(*other);
      std::set_intersection(on_plane.begin(), on_plane.end(), joined.begin(), joined.end(), std::back_inserter(shared));
      if (shared.empty()) continue;
      doubt(
          problem, support.origin,
          fmt::format("rigid body '{}' is joined to face '{}', which ends on the plane of {}: that plane does not hold "
                      "the body, which may move across it and turn out of it; model the whole of what it stands on",
                      body->part->name, other->label(), describe(support)),
          {"rigid body on a plane of symmetry", 0.0, "'" + body->part->name + "'", true});
    }
}

void doubt_symmetry(const Problem& problem) {
  for (const SupportPtr& support : all_supports(problem)) {
    if (support->kind->holds(true) != Directions::normal || support->kind->law()) continue;
    for (const FaceOrRegion& place : support->on)
      if (const Face* face = std::get_if<Face>(&place)) {
        doubt_whole_bolts(problem, *support, *face);
        doubt_rigid_bodies(problem, *support, *face);
      }
  }
}

// What moves when a static step begins stops in no time.
void doubt_sudden_rest(const Problem& problem) {
  for (size_t i = 1; i < problem.steps.size(); ++i)
    if (problem.steps[i]->is_static && !problem.steps[i - 1]->is_static)
      doubt(problem, problem.steps[i]->origin,
            "static step '" + problem.steps[i]->name + "' follows the dynamic step '" + problem.steps[i - 1]->name +
                "': all motion stops at its start, and the kinetic energy counts as numerical dissipation");
}

// A force of a load: its name and where it acts (nowhere in particular: on every mass).
struct Force {
  std::string name;
  std::optional<FaceOrRegion> on;
  TimeValue value;
};

std::vector<Force> forces_of(const Load& load) {
  std::vector<Force> forces;
  for (const Effect& effect : load.effects())
    std::visit(overloaded{[&](const NodalForces& force) {
                            forces.push_back({force.name, force.on, force.value});
                          },
                          [&](const BodyForce& force) {
                            forces.push_back({force.name, std::nullopt, force.value});
                          },
                          Ignored<PrescribedMotion, BaseMotion, Shortening, PreloadForce, Release>()},
               effect);
  return forces;
}

// A temperature goes on whatever expansion the next step gives with it.
bool is_same(const Force& a, const Force& b) {
  return a.name == b.name || (expansion_of(a.name) && expansion_of(b.name));
}

bool goes_on(const Force& force, const Step& step) {
  for (const LoadPtr& load : step.loads)
    for (const Force& other : forces_of(*load))
      if (is_same(other, force) && other.on.has_value() == force.on.has_value() &&
          (!force.on || coincide(*force.on, *other.on)))
        return true;
  return false;
}

// What is left of a value when its step ends; zero where that is nothing beside what it was.
double left_at_end(const TimeValue& value, const Step& step) {
  const double end = step.is_static ? 1.0 : step.duration, left = value.history.value(end);
  double largest = std::abs(left);
  const int n = 64;
  for (int i = 0; i < n; ++i) largest = std::max(largest, std::abs(value.history.value(end * i / n)));
  return std::abs(left) > 1e-3 * largest ? left : 0.0;
}

// A load that stands at the end of a step and is not listed in the dynamic step that follows is a shock by itself.
void doubt_dropped_loads(const Problem& problem, const Step& before, const Step& step) {
  for (const LoadPtr& load : before.loads)
    for (const Force& force : forces_of(*load)) {
      const double left = left_at_end(force.value, before);
      if (left == 0.0 || goes_on(force, step)) continue;
      const bool is_growth = expansion_of(force.name).has_value();
      const std::string where = !force.on   ? ""
                                : is_growth ? " of '" + part_of(*force.on).name + "'"
                                            : " on " + describe(target_of(*force.on));
      doubt(problem, load->origin,
            fmt::format("{}{} stands at {:.4g} {} at the end of step '{}' and is not listed in the dynamic step '{}', "
                        "where it is released suddenly, which is itself a shock; {}",
                        is_growth ? load->path : force.name, where, left, load->unit(), before.name, step.name,
                        load->complaint(step)
                            ? "it acts in static steps only: a static step without it releases it slowly"
                            : "list it there too, or with the value 0 if the release is intended"));
    }
}

// Does anything in a step hold or move these nodes along an axis?
bool is_held_in(const Problem& problem, const Step& step, const PrescribedMotion& motion, size_t axis) {
  for (const LoadPtr& load : step.loads)
    for (const Effect& effect : load->effects())
      if (const auto* other = std::get_if<PrescribedMotion>(&effect);
          other && other->along[axis] && one_in_other(other->on, motion.on))
        return true;
  for (const SupportPtr& support : supports_of(problem, step))
    for (const FaceOrRegion& place : support->on)
      if (support->kind->holds(step.is_static) != Directions::none && one_in_other(motion.on, place)) return true;
  return false;
}

// Nodes that a load has brought somewhere and that nothing holds there in the step that follows spring back.
void doubt_dropped_motions(const Problem& problem, const Step& before, const Step& step) {
  for (const LoadPtr& load : before.loads)
    for (const Effect& effect : load->effects()) {
      const auto* motion = std::get_if<PrescribedMotion>(&effect);
      for (size_t axis = 0; motion && !motion->is_velocity && axis < 3; ++axis) {
        const double left = motion->along[axis] ? left_at_end(*motion->along[axis], before) : 0.0;
        if (left == 0.0 || is_held_in(problem, step, *motion, axis)) continue;
        doubt(problem, load->origin,
              fmt::format("{} on {} stands at {:.4g} m at the end of step '{}' and is not listed in the {} step '{}', "
                          "where nothing holds these nodes: they are released suddenly{}; list it there too to hold "
                          "them, unless the release is intended",
                          motion->name_along(static_cast<int>(axis)), describe(target_of(motion->on)), left,
                          before.name, step.is_static ? "static" : "dynamic", step.name,
                          step.is_static ? "" : ", which is itself a shock"));
      }
    }
}

void doubt_dropped(const Problem& problem, const Step& before, const Step& step) {
  if (!step.is_static) doubt_dropped_loads(problem, before, step);
  doubt_dropped_motions(problem, before, step);
}

}  // namespace

void doubts(const Problem& problem) {
  const bool moves = has_dynamic_step(problem);
  const bool has_spectrum = std::any_of(problem.outputs.begin(), problem.outputs.end(),
                                        [](const OutputPtr& output) { return output->settles(); });
  if (problem.solver.spectra > 0.0 && !has_spectrum)
    doubt(problem, problem.origin,
          "'spectra' of solver.latin iterates until the spectra converge, but there is no output.srs: one pass is run");
  for (const SubstructurePtr& part : problem.substructures) {
    const std::string who = "substructure '" + part->name + "'";
    if (!is_touched(problem, part)) doubt(problem, part->origin, "no interface, support or load touches " + who);
    if (!moves && !part->velocity.isZero()) {
      doubt(problem, part->origin, "the velocity of " + who + " is not used: there is no dynamic step");
    }
  }
  doubt_supports(problem, moves);
  doubt_mass_damping(problem);
  if (moves) doubt_stiffening(problem);
  doubt_moduli(problem);
  doubt_layups(problem);
  doubt_isolators(problem);
  doubt_shortenings(problem);
  doubt_symmetry(problem);
  doubt_sudden_rest(problem);
  for (const InterfacePtr& interface : problem.interfaces) doubt_hardening(problem, *interface);
  for (size_t i = 1; i < problem.steps.size(); ++i) doubt_dropped(problem, *problem.steps[i - 1], *problem.steps[i]);
  for (const OutputPtr& output : problem.outputs) output->doubt(problem);
}

}  // namespace dygita::check
