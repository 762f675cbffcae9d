#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "base/log.hpp"
#include "checks/check_problem.hpp"
#include "deck/build_model.hpp"
#include "deck/deck_state.hpp"
#include "deck/integration.hpp"
#include "model/load.hpp"
#include "model/places.hpp"
#include "model/refusal.hpp"
#include "recording/output_table.hpp"

namespace dygita {

namespace {

constexpr double most_time_steps = 1e7;

std::shared_ptr<Step> new_step(const Declaration& d) {
  auto step = new_named<Step>(d);
  step->after = d.arguments.step("after");
  step->loads = d.arguments.list<LoadPtr>("loads");
  if (d.arguments.has("supports")) step->supports = d.arguments.list<SupportPtr>("supports");
  return step;
}

Content build_static(const Declaration& d) {
  auto step = new_step(d);
  step->is_static = true;
  step->increments = d.arguments.integer("increments");
  step->inertia_relief = d.arguments.boolean("inertia_relief");
  return StepPtr(step);
}

Content build_dynamic(const Declaration& d) {
  auto step = new_step(d);
  step->duration = d.arguments.number("duration");
  if (!d.arguments.has("dt")) {
    DeckState::of(d.lua).without_dt.emplace_back(step);
    return StepPtr(step);
  }
  step->dt = d.arguments.number("dt");
  const double n = step->duration / step->dt;
  if (n < 1.0 - 1e-6) {
    throw InputError(fmt::format("'dt' = {:g} s is longer than 'duration' = {:g} s", step->dt, step->duration));
  }
  if (n > most_time_steps)
    throw InputError(fmt::format("{:.3g} time steps exceed the limit of {:g}", n, most_time_steps));
  return StepPtr(step);
}

Content build_latin(const Declaration& d) {
  const LuaArguments& a = d.arguments;
  auto settings = std::make_shared<LatinSettings>();
  settings->tolerance = a.number("tolerance");
  settings->static_tolerance = a.number("static_tolerance");
  settings->window = a.is_number("window") ? a.integer("window") : 0;  // the only word is "whole"
  settings->relaxation = a.number_or("relaxation", settings->relaxation);
  settings->anderson = a.has("anderson") ? a.integer("anderson") : settings->anderson;
  settings->max_iterations = a.has("max_iterations") ? a.integer("max_iterations") : settings->max_iterations;
  settings->numerical_damping = a.number("numerical_damping");
  settings->push_out = a.number("push_out");
  settings->search_direction = a.number("search_direction");
  settings->mass = {a.text("mass") == "tuned", a.boolean("massless_contact"), a.text("mass") == "automatic"};
  settings->integration = integration_of(a.text("integration"));
  if (a.has("precision"))
    settings->precision = a.text("precision") == "single" ? Precision::single_precision : Precision::double_precision;
  if (settings->precision == Precision::single_precision && settings->tolerance < 1e-7)
    throw InputError(
        fmt::format("'precision' = \"single\" allows no tolerance below 1e-7, got {:g}: leave 'precision' out or "
                    "say \"double\"",
                    settings->tolerance));
  settings->pieces = a.is_number("pieces") ? a.integer("pieces") : 0;  // the only word is "auto"
  if (settings->pieces > 1 && settings->mass.is_moved_from_contact)
    throw InputError(
        fmt::format("'pieces' = {} and 'massless_contact' are mutually exclusive: mass cannot move between pieces; "
                    "omit 'pieces' or set it to 1",
                    settings->pieces));
  settings->spectra = a.number_or("spectra", settings->spectra);
  settings->history_memory = 1e6 * a.number("history_memory");
  const std::string statics = a.text("static_steps");
  settings->static_steps = statics == "assembled"  ? StaticSteps::assembled
                           : statics == "iterated" ? StaticSteps::iterated
                                                   : StaticSteps::automatic;
  settings->plain = a.boolean("plain");
  return std::shared_ptr<const LatinSettings>(settings);
}

Content build_monolithic(const Declaration& d) {
  const LuaArguments& a = d.arguments;
  auto settings = std::make_shared<MonolithicSettings>();
  settings->tolerance = a.number("tolerance");
  settings->max_iterations = a.integer("max_iterations");
  settings->numerical_damping = a.number("numerical_damping");
  settings->mass.is_tuned = a.text("mass") == "tuned";
  settings->plain = a.boolean("plain");
  return std::shared_ptr<const MonolithicSettings>(settings);
}

Content build_explicit(const Declaration& d) {
  const LuaArguments& a = d.arguments;
  auto settings = std::make_shared<ExplicitSettings>();
  settings->safety = a.number("safety");
  settings->penalty = a.number("penalty");
  settings->one_point = a.text("integration") == "one_point";
  settings->hourglass = a.number("hourglass");
  settings->bulk_viscosity = a.boolean("bulk_viscosity");
  return std::shared_ptr<const ExplicitSettings>(settings);
}

Content build_output(const Declaration& d) { return make_output(d.arguments); }

// What bolts clamp is held by friction: left out it is 0, and nothing holds.
void doubt_friction(const Problem& problem, const DeckState& state) {
  const bool tightens = std::any_of(problem.steps.begin(), problem.steps.end(), [](const StepPtr& step) {
    return std::any_of(step->loads.begin(), step->loads.end(), [](const LoadPtr& load) {
      const std::vector<Effect> effects = load->effects();
      return std::any_of(effects.begin(), effects.end(), [](const Effect& effect) { return bool(tightening(effect)); });
    });
  });
  if (!tightens) return;
  for (const std::weak_ptr<const Interface>& left_out : state.without_friction) {
    const InterfacePtr interface = left_out.lock();
    if (!interface ||
        std::find(problem.interfaces.begin(), problem.interfaces.end(), interface) == problem.interfaces.end())
      continue;
    check::doubt(problem, interface->origin,
                 fmt::format("{} has no 'friction' and slides freely, although tightened bolts rely on friction: "
                             "friction = 0 confirms this",
                             describe(*interface)),
                 {"no friction", 0.0, "'" + interface->name + "'", true});
  }
}

// A step of two problems can have one dt.
void choose_time_steps(const Problem& problem, DeckState& state) {
  for (const std::weak_ptr<Step>& left_out : state.without_dt) {
    const std::shared_ptr<Step> step = left_out.lock();
    const int i = step ? index_of(problem.steps, step.get()) : -1;
    if (i < 0) continue;
    const check::ChosenDt chosen = check::choose_dt(problem, static_cast<size_t>(i));
    if (step->dt > 0.0 && std::abs(step->dt - chosen.dt) > 1e-9 * chosen.dt)
      check::fail(problem, step->origin,
                  fmt::format("step '{}' has no 'dt' and is in two problems, of which one asks for {:.4g} us and this "
                              "one for {:.4g} us",
                              step->name, 1e6 * step->dt, 1e6 * chosen.dt),
                  "give 'dt', or each problem a step of its own");
    step->dt = chosen.dt;
    if (state.steps_told.insert(chosen.why).second) say(chosen.why);
  }
}

Content build_problem(const Declaration& d) {
  const LuaArguments& a = d.arguments;
  auto problem = new_named<Problem>(d);
  problem->substructures = a.list<SubstructurePtr>("substructures");
  problem->interfaces = a.list<InterfacePtr>("interfaces");
  problem->supports = a.list<SupportPtr>("supports");
  problem->steps = a.list<StepPtr>("steps");
  problem->outputs = a.list<OutputPtr>("outputs");
  if (a.has("solver")) {
    const Object& solver = a.object("solver");
    if (std::holds_alternative<std::shared_ptr<const MonolithicSettings>>(solver.content))
      problem->monolithic = *solver.as<std::shared_ptr<const MonolithicSettings>>();
    else if (std::holds_alternative<std::shared_ptr<const ExplicitSettings>>(solver.content))
      problem->explicit_dynamics = *solver.as<std::shared_ptr<const ExplicitSettings>>();
    else
      problem->solver = *solver.as<std::shared_ptr<const LatinSettings>>();
  }
  choose_time_steps(*problem, DeckState::of(d.lua));
  check_problem(*problem);
  doubt_friction(*problem, DeckState::of(d.lua));
  return std::shared_ptr<const Problem>(problem);
}

// Its members are problems that its function makes when it runs.
Content build_ensemble(const Declaration&) { return std::monostate(); }

}  // namespace

const Builders& study_builders() {
  static const Builders builders = [] {
    Builders all = {
        {"step.static", build_static},       {"step.dynamic", build_dynamic},
        {"solver.latin", build_latin},       {"solver.monolithic", build_monolithic},
        {"solver.explicit", build_explicit}, {"problem", build_problem},
        {"ensemble", build_ensemble},
    };
    for (const OutputEntry& output : output_table()) all.emplace("output." + output.word, build_output);
    return all;
  }();
  return builders;
}

}  // namespace dygita
