#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "base/log.hpp"
#include "model/check.hpp"

namespace dygita::check {

namespace {

std::string known_as(const Output& output) {
  return std::string("output.") + output_kind_name(output.kind) + " '" + output.name + "'";
}

bool has_dynamic_step(const Problem& problem) {
  return std::any_of(problem.steps.begin(), problem.steps.end(), [](const StepPtr& step) { return !step->is_static; });
}

bool is_wall(const Target& target) {
  const SupportPtr* support = std::get_if<SupportPtr>(&target);
  return support && (*support)->kind->law();
}

// What an output can be on, in the deck's words; empty when `target` is.
std::string refused(const Output& output, const Target& target) {
  const bool is_interface = std::holds_alternative<InterfacePtr>(target);
  const bool is_support = std::holds_alternative<SupportPtr>(target);
  if (output.kind == OutputKind::superelement) {
    return is_interface || is_support ? "output.superelement takes faces or regions: where something is to be attached"
                                      : "";
  }
  if (output.kind == OutputKind::resultant) {
    return is_interface || is_support ? "" : "output.resultant takes an interface or a support";
  }
  if (output.kind == OutputKind::loop) {
    return is_interface || is_support ? "" : "output.loop takes interfaces or supports; faces go to 'between'";
  }
  if (output.kind == OutputKind::joint) {
    return is_interface || is_wall(target) ? "" : "output.joint takes an interface or a support.wall";
  }
  if (output.quantity == Quantity::pressure) {
    return is_interface || is_wall(target) ? "" : "quantity 'pressure' takes an interface or a support.wall";
  }
  if (output.kind == OutputKind::srs_field)
    return std::holds_alternative<Face>(target) ? "" : "output.srs_field takes faces";
  const std::string quantity = quantity_name(output.quantity);
  return is_interface || is_support ? "quantity '" + quantity + "' takes a face or a region" : "";
}

void is_on_what_it_can_be(const Problem& problem, const Output& output) {
  if (output.on.empty()) fail(problem, output.origin, known_as(output) + " is on nothing");
  for (const Target& target : output.on) {
    target_exists(problem, output.origin, known_as(output) + " is on", target, all_supports(problem));
    const std::string hint = refused(output, target);
    if (!hint.empty()) fail(problem, output.origin, known_as(output) + " cannot be on " + describe(target), hint);
  }
}

void direction_has_a_meaning(const Problem& problem, const Output& output) {
  if (!output.direction) return;
  if (output.quantity == Quantity::von_mises || output.quantity == Quantity::pressure) {
    fail(problem, output.origin,
         known_as(output) + ": quantity '" + quantity_name(output.quantity) + "' has no direction");
  }
  if (std::abs(output.direction->norm() - 1.0) > 1e-9) {
    fail(problem, output.origin, known_as(output) + ": 'direction' is not a unit vector");
  }
}

void frequencies_rise(const Problem& problem, const Output& output) {
  const std::string who = known_as(output);
  if (!has_dynamic_step(problem)) {
    fail(problem, output.origin, who + ": the problem has no dynamic step", "a spectrum is of dynamic steps only");
  }
  const SrsSettings& srs = output.srs;
  if (!(srs.from > 0.0) || !(srs.to > srs.from)) {
    fail(problem, output.origin,
         fmt::format("{}: 'from' = {:g} Hz and 'to' = {:g} Hz must be 0 < from < to", who, srs.from, srs.to));
  }
}

// A spectrum is of one absolute acceleration over dynamic steps.
void spectrum_has_a_signal(const Problem& problem, const Output& output) {
  const std::string who = known_as(output);
  const std::string hint = "'of' takes an output.history of quantity 'acceleration' with a 'direction'";
  if (!output.of) fail(problem, output.origin, who + " has no 'of'", hint);
  listed(problem, who + " is of output", *output.of, problem.outputs, "outputs");
  const Output& of = *output.of;
  if (of.kind != OutputKind::history) fail(problem, output.origin, who + " is of " + known_as(of), hint);
  if (of.quantity != Quantity::acceleration) {
    fail(problem, output.origin, who + " is of " + known_as(of) + ", a " + quantity_name(of.quantity), hint);
  }
  if (!of.direction) fail(problem, output.origin, who + " is of " + known_as(of) + ", which has no direction", hint);
  frequencies_rise(problem, output);
}

// What enters and what leaves are compared axis by axis.
void attenuation_has_two_signals(const Problem& problem, const Output& output) {
  const std::string who = known_as(output);
  const std::string hint = "'entering' and 'leaving' take output.history of quantity 'acceleration'";
  for (const auto& [name, signal] : {std::pair{"entering", output.of}, {"leaving", output.leaving}}) {
    if (!signal) fail(problem, output.origin, fmt::format("{} has no '{}'", who, name), hint);
    listed(problem, fmt::format("{} has '{}' of output", who, name), *signal, problem.outputs, "outputs");
    if (signal->quantity != Quantity::acceleration)
      fail(problem, output.origin,
           fmt::format("{}: '{}' is {}, a {}", who, name, known_as(*signal), quantity_name(signal->quantity)), hint);
  }
  if (output.of->direction.has_value() != output.leaving->direction.has_value())
    fail(problem, output.origin, who + ": one of 'entering' and 'leaving' has a direction, the other has none",
         "both with a direction, or both without for x, y and z");
  frequencies_rise(problem, output);
}

// The force of a loop is that on side 1, or on the ground, and its displacement must be of the same two.
void loop_has_two_sides(const Problem& problem, const Output& output) {
  const std::string who = known_as(output);
  size_t n_supports = 0;
  bool needs_between = false;
  for (const Target& target : output.on) {
    n_supports += std::holds_alternative<SupportPtr>(target);
    needs_between = needs_between || (std::holds_alternative<SupportPtr>(target) && !is_wall(target));
  }
  if (n_supports > 0 && n_supports < output.on.size())
    fail(problem, output.origin, who + " is on interfaces and supports",
         "the force is that of interfaces or that on supports: take two loops");
  if (needs_between && output.between.empty())
    fail(problem, output.origin, who + " is on a support that does not slide, and has no 'between'",
         "as in between = block:face \"xmax\"");
  if (output.between.size() > 2)
    fail(problem, output.origin,
         fmt::format("{}: 'between' takes one or two places, got {}", who, output.between.size()));
  for (const FaceOrRegion& place : output.between) place_exists(problem, output.origin, who + " is between", place);
  if (output.after) listed(problem, who + " begins after step", *output.after, problem.steps, "steps");
  if (output.between.size() < 2) return;
  for (const Target& target : output.on) {
    const auto* interface = std::get_if<InterfacePtr>(&target);
    if (!interface || (*interface)->side_1.part == (*interface)->side_2.part) continue;
    if (&part_of(output.between[0]) == (*interface)->side_2.part.get() &&
        &part_of(output.between[1]) == (*interface)->side_1.part.get())
      fail(problem, output.origin,
           fmt::format("{}: 'between' is the other way round than that of {}: write {} first", who,
                       describe(**interface), label_of(output.between[1])),
           "the displacement is of the second place against the first, the force acts on side 1");
  }
}

// The assembly is taken about the end of a step, with that step's supports.
void superelement_has_a_state(const Problem& problem, const Output& output) {
  const std::string who = known_as(output);
  const Step* step = output.after.get();
  if (step) listed(problem, who + " is made after step", *step, problem.steps, "steps");
  for (const StepPtr& other : problem.steps)
    if (!output.after && other->is_static) step = other.get();
  if (!step)
    fail(problem, output.origin, who + ": the problem has no static step",
         "it is taken about the state after one; or name another step with 'after'");
  for (const SupportPtr& support : supports_of(problem, *step))
    if (support->kind->absorbs())
      fail(problem, output.origin,
           who + ": " + describe(*support) + " is a non-reflecting boundary in step '" + step->name +
               "', which a superelement cannot represent",
           "give the step its own 'supports', without it");
}

// Further files of an output are named after it.
void derived_names_are_free(const Problem& problem, const Output& output, const std::vector<std::string>& suffixes) {
  for (const std::string& suffix : suffixes)
    for (const OutputPtr& other : problem.outputs)
      if (other->name == output.name + suffix)
        fail(problem, other->origin,
             fmt::format("output '{}' would overwrite {}.csv of {}", other->name, other->name, known_as(output)));
}

}  // namespace

void outputs(const Problem& problem) {
  for (const OutputPtr& output : problem.outputs) {
    switch (output->kind) {
      case OutputKind::history:
        is_on_what_it_can_be(problem, *output);
        direction_has_a_meaning(problem, *output);
        break;
      case OutputKind::resultant:
      case OutputKind::joint:
        is_on_what_it_can_be(problem, *output);
        break;
      case OutputKind::srs:
        spectrum_has_a_signal(problem, *output);
        break;
      case OutputKind::srs_field:
        is_on_what_it_can_be(problem, *output);
        frequencies_rise(problem, *output);
        break;
      case OutputKind::attenuation:
        attenuation_has_two_signals(problem, *output);
        break;
      case OutputKind::loop:
        is_on_what_it_can_be(problem, *output);
        loop_has_two_sides(problem, *output);
        derived_names_are_free(problem, *output, {"_cycles", "_backbone"});
        break;
      case OutputKind::superelement:
        is_on_what_it_can_be(problem, *output);
        superelement_has_a_state(problem, *output);
        break;
      case OutputKind::vtk:
        if (output->frames < 1) {
          fail(problem, output->origin,
               fmt::format("output.vtk: 'frames' = {}, at least 1 per step is needed", output->frames));
        }
        break;
      case OutputKind::energy:
        break;
    }
  }
}

}  // namespace dygita::check
