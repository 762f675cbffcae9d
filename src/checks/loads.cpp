// Loads of each step: on what they can act, in steps where they mean something, nothing given twice. What one load asks
// is its own to say (loads/); what two of them do to each other is told by their effects.
#include <spdlog/fmt/fmt.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <set>
#include <tuple>

#include "base/overloaded.hpp"
#include "checks/parts.hpp"
#include "checks/prescribed.hpp"
#include "law/law.hpp"
#include "mesh/condensed_body.hpp"
#include "mesh/face_nodes.hpp"
#include "model/load.hpp"

namespace dygita::check {

namespace {

bool same_target(const Target& a, const Target& b) {
  if (a.index() != b.index()) return false;
  if (const InterfacePtr* interface = std::get_if<InterfacePtr>(&a)) return *interface == std::get<InterfacePtr>(b);
  if (const SupportPtr* support = std::get_if<SupportPtr>(&a)) return *support == std::get<SupportPtr>(b);
  return coincide(*place_of(a), *place_of(b));
}

void targets_fit(const Problem& problem, const Step& step, const Load& load) {
  const std::string who = "step '" + step.name + "'";
  if (!load.is_everywhere() && load.on.empty())
    fail(problem, load.origin, who + ": " + load.path + " is on nothing", load.path + " acts on " + load.acts_on());
  for (size_t i = 0; i < load.on.size(); ++i) {
    const Target& target = load.on[i];
    target_exists(problem, load.origin, who + " loads", target, supports_of(problem, step));
    if (!load.can_act_on(target))
      fail(problem, load.origin, who + ": " + load.path + " cannot act on " + describe(target),
           load.path + " acts on " + load.acts_on());
    for (size_t j = 0; j < i; ++j)
      if (same_target(load.on[j], target))
        fail(problem, load.origin, who + ": " + load.path + " is twice on " + describe(target));
      else if (const auto place = place_of(target), other = place_of(load.on[j]);
               place && other && overlap(*place, *other))
        fail(problem, load.origin,
             who + ": " + load.path + " is on " + describe(load.on[j]) + " and on " + describe(target) +
                 ", which share facets or nodes: it would act there twice",
             "use a separate load for the additional part");
  }
}

void fits_step(const Problem& problem, const Step& step, const Load& load) {
  const std::string who = "step '" + step.name + "': " + load.path;
  if (std::none_of(load.values.begin(), load.values.end(), [](const auto& value) { return value.has_value(); }))
    fail(problem, load.origin, who + " has no value", load.has_axes() ? "give at least one of x, y, z" : "");
  if (const auto complaint = load.complaint(step)) fail(problem, load.origin, who + complaint->text, complaint->hint);
}

// The interface whose force or life an effect decides, or null.
InterfacePtr bolt_of(const Effect& effect) {
  return std::visit(
      overloaded{[](const Tightening& t) { return t.on; }, [](const Release& release) { return release.on; },
                 [](const NodalForces&) { return InterfacePtr(); }, [](const BodyForce&) { return InterfacePtr(); },
                 [](const PrescribedMotion&) { return InterfacePtr(); },
                 [](const BaseMotion&) { return InterfacePtr(); }},
      effect);
}

// The first direction that both prescribe, or -1.
int common_direction(const PrescribedMotion& a, const PrescribedMotion& b) {
  for (int d = 0; d < 3; ++d)
    if (a.along[d] && b.along[d]) return d;
  return -1;
}

constexpr const char* in_one = "give their sum in one load; a history may be a function(t)";

// Two loads of a step. A value given twice: which would the next step start from? A motion, a bolt: who is to decide?
class Competition {
 public:
  Competition(const Problem& problem, const Step& step, const Load& a, const Load& b)
      : problem_(problem), step_(step), a_(a), b_(b) {}

  void check(const std::vector<Effect>& effects_of_a, const std::vector<Effect>& effects_of_b) const {
    for (const Effect& of_a : effects_of_a)
      for (const Effect& of_b : effects_of_b)
        std::visit(
            overloaded{[](const NodalForces&) {}, [&](const BodyForce& a) { meet(a, of_b); },
                       [&](const PrescribedMotion& a) { meet(a, of_b); }, [&](const BaseMotion& a) { meet(a, of_b); },
                       [&](const Tightening&) { meet_at_bolt(of_a, of_b); },
                       [&](const Release&) { meet_at_bolt(of_a, of_b); }},
            of_a);
  }

 private:
  void meet(const BodyForce& a, const Effect& other) const {
    const auto* b = std::get_if<BodyForce>(&other);
    if (b && a.name == b->name) twice("");
  }

  void meet(const PrescribedMotion& a, const Effect& other) const {
    const auto* b = std::get_if<PrescribedMotion>(&other);
    const int d = b ? common_direction(a, *b) : -1;
    if (d < 0 || !one_in_other(a.on, b->on)) return;
    fail(problem_, b_.origin,
         who() + a_.path + " and " + b_.path + " both prescribe the motion of " + describe(target_of(b->on)) +
             " along " + "xyz"[d]);
  }

  void meet(const BaseMotion& a, const Effect& other) const {
    const auto* b = std::get_if<BaseMotion>(&other);
    if (b && a.on == b->on && std::abs(a.direction.dot(b->direction)) > 1e-6) twice(" on " + describe(*b->on));
  }

  void meet_at_bolt(const Effect& a, const Effect& b) const {
    const InterfacePtr bolt = bolt_of(a);
    if (bolt != bolt_of(b)) return;
    const bool is_force = std::holds_alternative<PreloadForce>(a) || std::holds_alternative<PreloadForce>(b);
    if (a.index() == b.index())
      twice(" on " + describe(*bolt), is_force ? "one force per step: apply the other in a separate step" : in_one);
    if (is_force)
      fail(problem_, b_.origin, who() + a_.path + " and " + b_.path + " are both on " + describe(*bolt),
           "a preload finds the shortening for its force: keep one of the two, or apply them in separate steps");
  }

  [[noreturn]] void twice(const std::string& where, const std::string& hint = in_one) const {
    fail(problem_, b_.origin, who() + "two " + b_.path + where, hint);
  }

  std::string who() const { return "step '" + step_.name + "': "; }

  const Problem& problem_;
  const Step& step_;
  const Load& a_;
  const Load& b_;
};

// Forces of a step at nodes, by name and place: thousands of faces are not compared in pairs.
class ForcesOnNodes {
 public:
  void add(const Problem& problem, const Step& step, const Load& load, const std::vector<Effect>& effects) {
    for (const Effect& effect : effects) {
      const auto* forces = std::get_if<NodalForces>(&effect);
      if (forces) target_exists(problem, load.origin, "step '" + step.name + "' loads", target_of(forces->on), {});
      if (!forces || taken_.emplace(forces->name, &part_of(forces->on), nodes_at(forces->on)).second) continue;
      fail(problem, load.origin,
           "step '" + step.name + "': two " + load.path + " on " + describe(target_of(forces->on)), in_one);
    }
  }

 private:
  std::set<std::tuple<std::string, const Substructure*, std::vector<int>>> taken_;
};

// Mean outward normal of a face.
Vec3 normal_of(const Face& face) {
  const Points& x = face.part->mesh->nodes;
  Vec3 area = Vec3::Zero();
  for (const Facet& facet : face.facets()) area += facet_area_vector(x, facet);
  return area.normalized();
}

bool claims(const Support& support, const FaceOrRegion& place, int axis) {
  const double aligned = 0.99;
  const Directions claimed = support.kind->claims();
  return claimed.axes[static_cast<size_t>(axis)] ||
         (claimed.along_normals && std::abs(normal_of(std::get<Face>(place))[axis]) >= aligned);
}

void support_leaves_motion_free(const Problem& problem, const Step& step, const Load& load,
                                const PrescribedMotion& motion, const Support& support) {
  for (const FaceOrRegion& place : support.on) {
    if (!one_in_other(motion.on, place)) continue;
    for (int d = 0; d < 3; ++d) {
      if (!motion.along[d] || !claims(support, place, d)) continue;
      fail(problem, load.origin,
           "step '" + step.name + "': " + load.path + " moves " + describe(target_of(motion.on)) + " along " +
               "xyz"[d] + ", where " + describe(support) + " holds it",
           "take the support out of the step's 'supports', or move the support itself with load.base_acceleration");
    }
  }
}

void supports_leave_motions_free(const Problem& problem, const Step& step, const Load& load) {
  for (const SupportPtr& support : supports_of(problem, step))
    for (const Effect& effect : load.effects())
      std::visit(overloaded{[&](const PrescribedMotion& motion) {
                              support_leaves_motion_free(problem, step, load, motion, *support);
                            },
                            Ignored<NodalForces, BodyForce, BaseMotion, Shortening, PreloadForce, Release>()},
                 effect);
}

// The part of a direction in which a support holds something while it moves.
Vec3 part_that_is_held(const Support& support, const Vec3& direction) {
  const Directions held = support.kind->holds(false);
  Mat3 normals = Mat3::Zero();
  for (int axis = 0; axis < 3; ++axis)
    if (held.axes[static_cast<size_t>(axis)]) normals(axis, axis) = 1.0;
  for (const FaceOrRegion& place : support.on) {
    if (!held.along_normals) break;
    const Face& face = std::get<Face>(place);
    for (const Facet& facet : face.facets()) {
      const Vec3 n = facet_area_vector(face.part->mesh->nodes, facet);
      normals += n * n.transpose() / n.norm();
    }
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(normals);
  Vec3 followed = Vec3::Zero();
  for (int i = 0; i < 3; ++i)
    if (axes.eigenvalues()[i] > 1e-6 * normals.trace())
      followed += axes.eigenvectors().col(i).dot(direction) * axes.eigenvectors().col(i);
  return followed;
}

// A support that does not hold along all directions is moved along those that it holds alone.
void support_follows(const Problem& problem, const Load& load, const BaseMotion& motion) {
  const Directions held = motion.on->kind->holds(false);
  if (held == Directions::all || held == Directions::none) return;
  const Vec3 followed = part_that_is_held(*motion.on, motion.direction);
  const std::string what = fmt::format("{} moves {} along ({:.3g}, {:.3g}, {:.3g})", load.path, describe(*motion.on),
                                       motion.direction[0], motion.direction[1], motion.direction[2]);
  const std::string hint = std::string("it holds only along ") +
                           (held.along_normals ? "the normals of its faces" : "some axes") +
                           "; a support.fixed can be moved in any direction";
  if (followed.norm() < 1e-3) fail(problem, load.origin, what + ", where it holds nothing", hint);
  if (followed.norm() < 0.999)
    doubt(problem, load.origin,
          what +
              fmt::format(", of which only the component ({:.3g}, {:.3g}, {:.3g}) moves it: ", followed[0], followed[1],
                          followed[2]) +
              hint);
}

// What was condensed with a support stands on ground that does not move.
void doubt_inner_supports(const Problem& problem, const Load& load, const BaseMotion& motion) {
  for (const SubstructurePtr& part : problem.substructures)
    if (part->mesh->inside->resists(part->mesh->nodes, motion.direction))
      doubt(problem, load.origin,
            load.path + " moves " + describe(*motion.on) + ", but the support condensed with superelement '" +
                part->name + "' is at rest");
}

void supports_follow(const Problem& problem, const Load& load) {
  for (const Effect& effect : load.effects())
    if (const auto* motion = std::get_if<BaseMotion>(&effect)) {
      support_follows(problem, load, *motion);
      doubt_inner_supports(problem, load, *motion);
    }
}

// Is every node of a face held or moved along an axis, and by what? Empty: not.
std::string driver_of(const Problem& problem, const Step& step, const std::vector<Prescribed>& prescribed,
                      const Face& face, int axis) {
  const auto covers = [&](const FaceOrRegion& place) {
    if (&part_of(place) != face.part.get()) return false;
    const std::vector<int> all = nodes_at(place), nodes = nodes_at(face);
    return std::includes(all.begin(), all.end(), nodes.begin(), nodes.end());
  };
  for (const SupportPtr& support : supports_of(problem, step))
    for (const FaceOrRegion& place : support->on)
      if (support->kind->holds(step.is_static) != Directions::none && claims(*support, place, axis) && covers(place))
        return describe(*support);
  for (const auto& [load, motion] : prescribed)
    if (motion.along[static_cast<size_t>(axis)] && covers(motion.on)) return load->path;
  return "";
}

// An interface both of whose sides move as told transmits nothing and may stand open or overlap unseen.
void interfaces_have_a_free_side(const Problem& problem, const Step& step) {
  const std::vector<Prescribed> prescribed = prescribed_in(step);
  for (const InterfacePtr& interface : problem.interfaces) {
    const Law& law = *interface->law;
    if (!law.takes_part(true)) continue;  // a damper holds nothing: it is made to be driven
    if (law.tangent(law.initial(), false).stiffness[0] > 0.0)
      continue;  // a spring transmits what both sides make of it
    const Vec3 normal = normal_of(interface->side_1);
    int axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    const std::string one = driver_of(problem, step, prescribed, interface->side_1, axis);
    if (one.empty()) continue;
    const std::string other = driver_of(problem, step, prescribed, interface->side_2, axis);
    if (other.empty()) continue;
    fail(problem, interface->origin,
         "step '" + step.name + "': both sides of " + describe(*interface) + " are held or moved along " + "xyz"[axis] +
             ", by " + one + " and " + other + ": it would transmit no force, and its gap would follow from them",
         "drive one side: the interface carries the motion to the other");
  }
}

using Released = std::vector<std::pair<InterfacePtr, const Step*>>;

// What has let go carries no force.
void preload_holds(const Problem& problem, const Step& step, const Load& load, const Released& released) {
  for (const Effect& effect : load.effects()) {
    if (!std::holds_alternative<PreloadForce>(effect)) continue;
    const InterfacePtr bolt = bolt_of(effect);
    for (const auto& [gone, in] : released)
      if (gone == bolt)
        fail(problem, load.origin,
             "step '" + step.name + "': " + load.path + " is on " + describe(*bolt) + ", which step '" + in->name +
                 "' has released",
             "a released interface carries no force");
  }
}

void preloads_hold(const Problem& problem) {
  Released released;
  for (const StepPtr& step : problem.steps) {
    for (const LoadPtr& load : step->loads) preload_holds(problem, *step, *load, released);
    for (const LoadPtr& load : step->loads)
      for (const Effect& effect : load->effects())
        if (std::holds_alternative<Release>(effect)) released.emplace_back(bolt_of(effect), step.get());
  }
}

// How a body force loads the inside of a condensed body follows from its mass where it can move with it alone.
void superelements_feel(const Problem& problem, const Load& load) {
  for (const Effect& effect : load.effects()) {
    const auto* force = std::get_if<BodyForce>(&effect);
    if (!force) continue;
    for (const SubstructurePtr& part : problem.substructures)
      if (part->mesh->inside->resists(part->mesh->nodes, force->unit(part->place)))
        fail(problem, load.origin,
             force->name + ": its effect inside superelement '" + part->name +
                 "' is not known, since its matrices resist that motion because a support was condensed with it",
             "condense it without the support, with the supported face in 'on', and hold it in the deck");
    for (const SubstructurePtr& part : problem.substructures) {
      const CondensedBody* body = part->mesh->inside->matrices();
      const bool is_uniform = force->unit(part->place) == force->unit(part->place + Vec3(1.0, 2.0, 3.0));
      if (body && !body->is_rigid() && !is_uniform)
        fail(problem, load.origin,
             load.path + ": how it loads the inside of superelement '" + part->name +
                 "' does not follow from its matrices, since it is not uniform",
             "take the part with its mesh");
    }
  }
}

}  // namespace

void loads(const Problem& problem) {
  for (const StepPtr& step : problem.steps) {
    std::vector<std::vector<Effect>> effects;
    ForcesOnNodes forces;
    for (size_t i = 0; i < step->loads.size(); ++i) {
      const Load& load = *step->loads[i];
      targets_fit(problem, *step, load);
      fits_step(problem, *step, load);
      effects.push_back(load.effects());
      for (size_t j = 0; j < i; ++j) {
        if (step->loads[j] == step->loads[i])
          fail(problem, load.origin, "step '" + step->name + "': one " + load.path + " is listed twice");
        Competition(problem, *step, *step->loads[j], load).check(effects[j], effects[i]);
      }
      forces.add(problem, *step, load, effects.back());
      supports_leave_motions_free(problem, *step, load);
      supports_follow(problem, load);
      superelements_feel(problem, load);
    }
    interfaces_have_a_free_side(problem, *step);
  }
  preloads_hold(problem);
}

}  // namespace dygita::check
