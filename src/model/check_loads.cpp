#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <cmath>

#include "model/check.hpp"

namespace dygita::check {

namespace {

std::string known_as(const Load& load) { return std::string("load.") + load_kind_name(load.kind); }

bool is_prescribed_motion(const Load& load) {
  return load.kind == LoadKind::velocity || load.kind == LoadKind::displacement;
}

// Laws of the table whose interfaces a load can shorten: "an interface.bonded or an interface.plastic".
std::string what_can_be_tightened() {
  std::string text;
  for (const LawEntry& entry : law_table())
    if (example_of(entry)->can_be_tightened())
      text += (text.empty() ? "an interface." : " or an interface.") + entry.word;
  return text;
}

// What a kind of load acts on, in the deck's words.
std::string acts_on(LoadKind kind) {
  switch (kind) {
    case LoadKind::pressure:
    case LoadKind::traction:
      return "a face";
    case LoadKind::force:
    case LoadKind::velocity:
    case LoadKind::displacement:
      return "a face or a region";
    case LoadKind::base_acceleration:
      return "a support.fixed or a support.symmetry";
    case LoadKind::shortening:
    case LoadKind::preload:
      return what_can_be_tightened();
    case LoadKind::release:
      return "an interface";
    case LoadKind::gravity:
      return "every substructure, without 'on'";
  }
  CHECK(false, "unknown kind of load");
  return "";
}

bool can_act_on(LoadKind kind, const Target& target) {
  const InterfacePtr* interface = std::get_if<InterfacePtr>(&target);
  const SupportPtr* support = std::get_if<SupportPtr>(&target);
  switch (kind) {
    case LoadKind::pressure:
    case LoadKind::traction:
      return std::holds_alternative<Face>(target);
    case LoadKind::force:
    case LoadKind::velocity:
    case LoadKind::displacement:
      return !interface && !support;
    case LoadKind::base_acceleration:
      return support && ((*support)->kind == SupportKind::fixed || (*support)->kind == SupportKind::symmetry);
    case LoadKind::shortening:
    case LoadKind::preload:
      return interface && (*interface)->law->can_be_tightened();
    case LoadKind::release:
      return interface != nullptr;
    case LoadKind::gravity:
      return false;
  }
  return false;
}

bool same_target(const Target& a, const Target& b) {
  if (a.index() != b.index()) return false;
  if (const InterfacePtr* interface = std::get_if<InterfacePtr>(&a)) return *interface == std::get<InterfacePtr>(b);
  if (const SupportPtr* support = std::get_if<SupportPtr>(&a)) return *support == std::get<SupportPtr>(b);
  return coincide(*place_of(a), *place_of(b));
}

void targets_fit(const Problem& problem, const Step& step, const Load& load) {
  const std::string who = "step '" + step.name + "'";
  if (load.kind != LoadKind::gravity && load.on.empty()) {
    fail(problem, load.origin, who + ": " + known_as(load) + " is on nothing",
         known_as(load) + " acts on " + acts_on(load.kind));
  }
  for (size_t i = 0; i < load.on.size(); ++i) {
    const Target& target = load.on[i];
    target_exists(problem, load.origin, who + " loads", target, supports_of(problem, step));
    if (!can_act_on(load.kind, target)) {
      fail(problem, load.origin, who + ": " + known_as(load) + " cannot act on " + describe(target),
           known_as(load) + " acts on " + acts_on(load.kind));
    }
    for (size_t j = 0; j < i; ++j) {
      if (same_target(load.on[j], target)) {
        fail(problem, load.origin, who + ": " + known_as(load) + " is twice on " + describe(target));
      }
    }
  }
}

void values_are_given(const Problem& problem, const Step& step, const Load& load) {
  const bool is_vector = load.kind == LoadKind::traction || load.kind == LoadKind::force ||
                         load.kind == LoadKind::gravity || is_prescribed_motion(load);
  const bool is_given = load.value[0] || (is_vector && (load.value[1] || load.value[2]));
  if (!is_given) {
    fail(problem, load.origin, "step '" + step.name + "': " + known_as(load) + " has no value",
         is_vector ? "give at least one of x, y, z" : "");
  }
  if (load.kind == LoadKind::base_acceleration && std::abs(load.direction.norm() - 1.0) > 1e-9) {
    fail(problem, load.origin, "step '" + step.name + "': load.base_acceleration has no direction");
  }
}

void step_is_of_the_right_kind(const Problem& problem, const Step& step, const Load& load) {
  const std::string who = "step '" + step.name + "': " + known_as(load);
  if (load.kind == LoadKind::preload && step.is_static)
    for (int i = 1; i <= step.increments; ++i)
      if (const double force = load.value[0]->value(static_cast<double>(i) / step.increments); force < 0.0)
        fail(problem, load.origin,
             fmt::format(
                 "step '{}': load.preload asks for {:.6g} N in increment {}: a bolt pulls, its force is not negative",
                 step.name, force, i));
  if ((load.kind == LoadKind::shortening || load.kind == LoadKind::preload) && !step.is_static) {
    fail(problem, load.origin, who + " acts in static steps only, and this one is dynamic",
         "tighten in a step.static before it; the bolt keeps its length afterwards");
  }
  if (load.kind == LoadKind::base_acceleration && step.is_static) {
    fail(problem, load.origin, who + " acts in dynamic steps only, and this one is static",
         "a steady acceleration of the whole assembly is load.gravity");
  }
  if (load.kind == LoadKind::velocity && step.is_static) {
    fail(problem, load.origin, who + " acts in dynamic steps only, and this one is static",
         "a static step has no time: use load.displacement");
  }
  if (load.kind == LoadKind::release && load.value[0]->is_constant()) {
    const double at = load.value[0]->value(0.0), end = step.is_static ? 1.0 : step.duration;
    if (at < 0.0 || at > end) {
      fail(problem, load.origin, fmt::format("{}.at = {:g}, outside the step [0, {:g}]", who, at, end),
           step.is_static ? "a static step runs from 0 to 1" : "'at' counts in seconds from the step's start");
    }
  }
}

// The first direction that both loads prescribe, or -1.
int common_direction(const Load& a, const Load& b) {
  for (int d = 0; d < 3; ++d)
    if (a.value[d] && b.value[d]) return d;
  return -1;
}

// Forces, shortenings and releases of one kind on one target: which would the next step start from?
bool are_one_load(const Load& a, const Load& b) {
  if (a.kind != b.kind || is_prescribed_motion(a) || common_direction(a, b) < 0) return false;
  return a.kind != LoadKind::base_acceleration || std::abs(a.direction.dot(b.direction)) > 1e-6;
}

void loads_do_not_compete(const Problem& problem, const Step& step, const Load& a, const Load& b) {
  const std::string who = "step '" + step.name + "': ";
  const std::string in_one = "give their sum in one load; a history may be a function(t)";
  if (are_one_load(a, b) && a.kind == LoadKind::gravity) fail(problem, b.origin, who + "two load.gravity", in_one);
  const auto is_of_bolt = [](const Load& load) {
    return load.kind == LoadKind::shortening || load.kind == LoadKind::preload || load.kind == LoadKind::release;
  };
  for (const Target& target_a : a.on) {
    for (const Target& target_b : b.on) {
      if (a.kind != b.kind && is_of_bolt(a) && is_of_bolt(b) &&
          (a.kind == LoadKind::preload || b.kind == LoadKind::preload) && same_target(target_a, target_b))
        fail(problem, b.origin, who + known_as(a) + " and " + known_as(b) + " are both on " + describe(target_b),
             "a preload finds the shortening that brings its force: one of the two, or one after the other in steps of "
             "their own");
      if (are_one_load(a, b) && same_target(target_a, target_b)) {
        fail(problem, b.origin, who + "two " + known_as(b) + " on " + describe(target_b),
             b.kind == LoadKind::preload ? "one force per step: give the other one in a step of its own" : in_one);
      }
      if (!is_prescribed_motion(a) || !is_prescribed_motion(b)) continue;
      const int d = common_direction(a, b);
      if (d < 0 || !one_in_other(*place_of(target_a), *place_of(target_b))) continue;
      fail(problem, b.origin,
           who + known_as(a) + " and " + known_as(b) + " both prescribe the motion of " + describe(target_b) +
               " along " + "xyz"[d]);
    }
  }
}

// Mean outward normal of a face.
Vec3 normal_of(const Face& face) {
  const Points& x = face.part->mesh->nodes;
  Vec3 area = Vec3::Zero();
  for (const Facet& facet : face.facets()) {
    for (int i = 2; i < facet.n_nodes; ++i) {
      const Vec3 a = x.col(facet.nodes[0]);
      area += (x.col(facet.nodes[i - 1]) - a).cross(x.col(facet.nodes[i]) - a) / 2.0;
    }
  }
  return area.normalized();
}

// A support takes the directions it holds: all of them, or its normal.
void support_leaves_motion_free(const Problem& problem, const Step& step, const Load& load, const Support& support) {
  const bool holds_all = support.kind == SupportKind::fixed || support.kind == SupportKind::absorbing;
  for (const Target& target : load.on) {
    for (const FaceOrRegion& place : support.on) {
      if (!one_in_other(*place_of(target), place)) continue;
      for (int d = 0; d < 3; ++d) {
        const double aligned = 0.99;
        if (!load.value[d] || (!holds_all && std::abs(normal_of(std::get<Face>(place))[d]) < aligned)) continue;
        fail(problem, load.origin,
             "step '" + step.name + "': " + known_as(load) + " moves " + describe(target) + " along " + "xyz"[d] +
                 ", where " + describe(support) + " holds it",
             "take the support out of the step's 'supports', or move the support itself with load.base_acceleration");
      }
    }
  }
}

// What has let go carries no force.
void preloads_hold(const Problem& problem) {
  std::vector<std::pair<const Interface*, const Step*>> released;
  for (const StepPtr& step : problem.steps) {
    for (const LoadPtr& load : step->loads)
      for (const Target& target : load->on) {
        const auto* interface = std::get_if<InterfacePtr>(&target);
        if (!interface || load->kind != LoadKind::preload) continue;
        for (const auto& [gone, in] : released)
          if (gone == interface->get())
            fail(problem, load->origin,
                 "step '" + step->name + "': load.preload is on " + describe(target) + ", which step '" + in->name +
                     "' has released",
                 "what has let go carries no force any more");
      }
    for (const LoadPtr& load : step->loads)
      for (const Target& target : load->on)
        if (const auto* interface = std::get_if<InterfacePtr>(&target); interface && load->kind == LoadKind::release)
          released.emplace_back(interface->get(), step.get());
  }
}

}  // namespace

void loads(const Problem& problem) {
  preloads_hold(problem);
  for (const StepPtr& step : problem.steps) {
    for (size_t i = 0; i < step->loads.size(); ++i) {
      const Load& load = *step->loads[i];
      targets_fit(problem, *step, load);
      values_are_given(problem, *step, load);
      step_is_of_the_right_kind(problem, *step, load);
      for (size_t j = 0; j < i; ++j) {
        if (step->loads[j] == step->loads[i]) {
          fail(problem, load.origin, "step '" + step->name + "': one " + known_as(load) + " is listed twice");
        }
        loads_do_not_compete(problem, *step, *step->loads[j], load);
      }
      if (!is_prescribed_motion(load)) continue;
      for (const SupportPtr& support : supports_of(problem, *step)) {
        support_leaves_motion_free(problem, *step, load, *support);
      }
    }
  }
}

}  // namespace dygita::check
