#include <spdlog/fmt/fmt.h>

#include <cmath>

#include "base/log.hpp"
#include "deck/build_model.hpp"

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
  return StepPtr(step);
}

Content build_dynamic(const Declaration& d) {
  auto step = new_step(d);
  step->duration = d.arguments.number("duration");
  step->dt = d.arguments.number("dt");
  const double n = step->duration / step->dt;
  if (n < 1.0 - 1e-6) {
    throw InputError(fmt::format("'dt' = {:g} s is longer than 'duration' = {:g} s", step->dt, step->duration));
  }
  if (n > most_time_steps) throw InputError(fmt::format("{:.3g} time steps are more than {:g}", n, most_time_steps));
  if (std::abs(n - std::round(n)) > 1e-6 * n) {
    warn(fmt::format("{}step '{}': 'duration' is {:g} times 'dt'; {:.0f} time steps are computed", d.origin.prefix(),
                     step->name, n, std::round(n)));
  }
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
  settings->max_iterations = a.integer("max_iterations");
  settings->numerical_damping = a.number("numerical_damping");
  settings->push_out = a.number("push_out");
  settings->search_direction = a.number("search_direction");
  settings->mass = {a.text("mass") == "tuned", a.boolean("massless_contact")};
  if (a.has("precision"))
    settings->precision = a.text("precision") == "single" ? Precision::single_precision : Precision::double_precision;
  if (settings->precision == Precision::single_precision && settings->tolerance < 1e-7)
    throw InputError(
        fmt::format("'precision' = \"single\" holds a tolerance of 1e-7 at least, got {:g}: leave 'precision' out or "
                    "say \"double\"",
                    settings->tolerance));
  settings->pieces = a.is_number("pieces") ? a.integer("pieces") : 0;  // the only word is "auto"
  if (settings->pieces > 1 && settings->mass.is_moved_from_contact)
    throw InputError(
        fmt::format("'pieces' = {} and 'massless_contact' exclude each other: mass does not move from one piece to "
                    "another; leave 'pieces' out, or 1",
                    settings->pieces));
  settings->spectra = a.number_or("spectra", settings->spectra);
  settings->history_memory = 1e6 * a.number("history_memory");
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

Content build_vtk(const Declaration& d) {
  auto output = std::make_shared<Output>();
  output->name = "vtk";
  output->origin = d.origin;
  output->kind = OutputKind::vtk;
  output->frames = d.arguments.integer("frames");
  output->fields = d.arguments.texts("fields");
  return OutputPtr(output);
}

Content build_energy(const Declaration& d) {
  auto output = std::make_shared<Output>();
  output->name = "energy";
  output->origin = d.origin;
  output->kind = OutputKind::energy;
  return OutputPtr(output);
}

Content build_history(const Declaration& d) {
  static const std::map<std::string, Quantity> quantities = {
      {"displacement", Quantity::displacement}, {"velocity", Quantity::velocity},
      {"acceleration", Quantity::acceleration}, {"stress", Quantity::stress},
      {"von_mises", Quantity::von_mises},       {"pressure", Quantity::pressure}};
  auto output = new_named<Output>(d);
  output->kind = OutputKind::history;
  output->on = d.arguments.targets("on");
  output->quantity = quantities.at(d.arguments.text("quantity"));
  if (d.arguments.has("direction")) output->direction = d.arguments.unit_vector("direction");
  return OutputPtr(output);
}

Content build_resultant(const Declaration& d) {
  auto output = new_named<Output>(d);
  output->kind = OutputKind::resultant;
  output->on = d.arguments.targets("on");
  return OutputPtr(output);
}

Content build_joint(const Declaration& d) {
  auto output = new_named<Output>(d);
  output->kind = OutputKind::joint;
  output->on = d.arguments.targets("on");
  return OutputPtr(output);
}

SrsSettings srs_settings(const Arguments& a) {
  static const std::map<std::string, SrsQuantity> quantities = {
      {"absolute_acceleration", SrsQuantity::absolute_acceleration},
      {"relative_displacement", SrsQuantity::relative_displacement},
      {"pseudo_velocity", SrsQuantity::pseudo_velocity}};
  SrsSettings srs{a.number_or("q_factor", 10.0), a.number("from"), a.number("to"), a.integer("per_octave"),
                  quantities.at(a.text("quantity"))};
  if (a.has("damping")) {
    if (a.has("q_factor"))
      throw InputError("'q_factor' and 'damping' are the same quantity: leave one out (Q = 1 / (2 damping))");
    srs.q_factor = q_factor_of(a.number("damping"));
  }
  if (srs.from >= srs.to)
    throw InputError(fmt::format("'from' = {:g} Hz is not below 'to' = {:g} Hz", srs.from, srs.to));
  return srs;
}

Content build_loop(const Declaration& d) {
  auto output = new_named<Output>(d);
  output->kind = OutputKind::loop;
  output->on = d.arguments.targets("on");
  output->direction = d.arguments.unit_vector("direction");
  output->between = d.arguments.places("between");
  output->after = d.arguments.step("after");
  return OutputPtr(output);
}

Content build_superelement(const Declaration& d) {
  static const std::map<std::string, FaceMotion> motions = {
      {"mean", FaceMotion::mean}, {"rigid", FaceMotion::rigid}, {"nodes", FaceMotion::nodes}};
  const LuaArguments& a = d.arguments;
  auto output = new_named<Output>(d);
  output->kind = OutputKind::superelement;
  output->on = d.arguments.targets("on");
  output->after = a.step("after");
  if (a.has("up_to") && a.has("modes"))
    throw InputError("'up_to' and 'modes' exclude each other: modes are kept up to twice 'up_to'");
  output->superelement.motion = motions.at(a.text("motion"));
  output->superelement.up_to = a.number_or("up_to", 0.0);
  output->superelement.modes = a.has("modes") ? a.integer("modes") : 0;
  output->superelement.ties_sliding = a.text("sliding") == "tied";
  return OutputPtr(output);
}

Content build_srs(const Declaration& d) {
  const LuaArguments& a = d.arguments;
  auto output = new_named<Output>(d);
  output->kind = OutputKind::srs;
  output->of = a.output("of");
  output->srs = srs_settings(a);
  output->specification = a.specification("specification");
  if (output->specification && output->srs.quantity != SrsQuantity::absolute_acceleration)
    throw InputError("a 'specification' is of absolute acceleration: leave 'quantity' out");
  return OutputPtr(output);
}

Content build_srs_field(const Declaration& d) {
  auto output = new_named<Output>(d);
  output->kind = OutputKind::srs_field;
  output->on = d.arguments.targets("on");
  output->quantity = Quantity::acceleration;
  if (d.arguments.has("direction")) output->direction = d.arguments.unit_vector("direction");
  output->srs = srs_settings(d.arguments);
  return OutputPtr(output);
}

Content build_attenuation(const Declaration& d) {
  const LuaArguments& a = d.arguments;
  auto output = new_named<Output>(d);
  output->kind = OutputKind::attenuation;
  output->of = a.output("entering");
  output->leaving = a.output("leaving");
  output->srs = srs_settings(a);
  output->bands = a.integer("bands");
  output->n_joints = a.integer("joints");
  return OutputPtr(output);
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
  check_problem(*problem);
  return std::shared_ptr<const Problem>(problem);
}

}  // namespace

const Builders& study_builders() {
  static const Builders builders = {
      {"step.static", build_static},
      {"step.dynamic", build_dynamic},
      {"solver.latin", build_latin},
      {"solver.monolithic", build_monolithic},
      {"solver.explicit", build_explicit},
      {"output.vtk", build_vtk},
      {"output.history", build_history},
      {"output.resultant", build_resultant},
      {"output.joint", build_joint},
      {"output.srs", build_srs},
      {"output.energy", build_energy},
      {"output.srs_field", build_srs_field},
      {"output.attenuation", build_attenuation},
      {"output.loop", build_loop},
      {"output.superelement", build_superelement},
      {"problem", build_problem},
  };
  return builders;
}

}  // namespace dygita
