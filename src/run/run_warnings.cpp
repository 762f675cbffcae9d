#include "run/run_warnings.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "base/log.hpp"
#include "base/warnings.hpp"
#include "law/law.hpp"
#include "model/load.hpp"
#include "model/tightening.hpp"
#include "partition/stored_precision.hpp"
#include "result/limits.hpp"

namespace dygita {

namespace {

// "increment 3 of 4", "increments 3, 4, 5 ... of 200".
std::string list_increments(const StepSummary& step) {
  std::string list;
  const size_t shown = std::min<size_t>(step.missed.size(), 5);
  for (size_t i = 0; i < shown; ++i) list += fmt::format("{}{}", i ? ", " : "", step.missed[i].increment + 1);
  const int n = step.increments_not_converged;
  return fmt::format("increment{} {}{} of {}", n > 1 ? "s" : "", list, n > static_cast<int>(shown) ? " ..." : "",
                     step.increments);
}

// More iterations, since they still help: so many, and how to ask for them.
std::string cure_by_iterations(const StepSummary& step, const Missed& worst, const std::filesystem::path& kept) {
  double more = 0.0, halving = 0.0;
  for (const Missed& m : step.missed)
    if (m.halving) {
      more = std::max(more, *m.halving * std::log2(m.indicator / m.tolerance));
      halving = std::max(halving, *m.halving);
    }
  const int asked = std::max(static_cast<int>(std::ceil(2.0 * more / 100.0)) * 100, 100);
  std::string text = "the indicator is still decreasing";
  if (more > 0.0) text += fmt::format(", halving in {:.0f} iterations: about {:.0f} more are needed", halving, more);
  text += ": ";
  if (!kept.empty()) text += fmt::format("`dygita continue {} --iterations {}`, or ", kept.string(), asked);
  return text + fmt::format("solver.latin{{ max_iterations = {} }}", (worst.iterations + 99) / 100 * 100 + asked);
}

// The indicator has stagnated: iterations do not help, if there were enough to tell.
std::string cure_of_stall(const Problem& problem, const StepSummary& step, const Missed& worst) {
  if (problem.solver.max_iterations > 0 && problem.solver.max_iterations < 1000)
    return "omit 'max_iterations': the iteration then continues while it improves";
  std::string text = "the indicator has stagnated: more iterations will not help; ";
  const bool is_stored_in_single =
      !step.is_static && step.explicit_parts.size() < problem.substructures.size() &&
      std::any_of(problem.substructures.begin(), problem.substructures.end(), [&](const auto& part) {
        return stored_precision(problem.solver, 3.0 * part->mesh->n_nodes()) == Precision::single_precision;
      });
  const std::string stored =
      is_stored_in_single ? ", or solver.latin{ precision = \"double\" }, if the stored factors limit it" : "";
  if (worst.indicator < 30.0 * worst.tolerance)
    return text + fmt::format("it is within {:.0f} times the tolerance: {} = {:.0e} accepts it{}",
                              std::ceil(worst.indicator / worst.tolerance),
                              step.is_static ? "static_tolerance" : "tolerance", 2.0 * worst.indicator, stored);
  if (!step.is_static) return text + "take half of dt" + stored;
  const bool has_friction =
      std::any_of(problem.interfaces.begin(), problem.interfaces.end(),
                  [](const InterfacePtr& i) { return i->law->shown().gap && i->law->shown().slip; });
  // Left to the program, both ways have been gone.
  const bool is_fixed = problem.solver.static_steps != StaticSteps::automatic;
  return text + fmt::format("take more increments{}{}",
                            is_fixed ? ", or omit 'static_steps': if one method stagnates, the other is then used" : "",
                            has_friction ? ", or check what friction alone must resist (output.joint)" : "");
}

void warn_of_missed(const Problem& problem, const RunResult& result, const std::filesystem::path& kept) {
  const bool is_latin = !problem.monolithic && !problem.explicit_dynamics;
  for (size_t i = 0; i < result.steps.size(); ++i) {
    const StepSummary& step = result.steps[i];
    if (step.missed.empty() || !is_latin) continue;
    const std::vector<int>& overloaded = result.overloaded_steps;
    if (std::find(overloaded.begin(), overloaded.end(), static_cast<int>(i)) != overloaded.end()) continue;  // was told
    const auto less = [](const Missed& a, const Missed& b) { return a.indicator < b.indicator; };
    const Missed& worst = *std::max_element(step.missed.begin(), step.missed.end(), less);
    const bool is_falling =
        std::all_of(step.missed.begin(), step.missed.end(), [](const Missed& m) { return m.is_falling; });
    warn(fmt::format(
        "step '{}': {} not converged: the indicator is at {:.2g} after {} iterations, the tolerance is {:g}; {}",
        step.name, list_increments(step), worst.indicator, worst.iterations, worst.tolerance,
        is_falling ? cure_by_iterations(step, worst, kept) : cure_of_stall(problem, step, worst)));
  }
}

bool has_bands(const RunResult& result) {
  return std::any_of(result.findings.begin(), result.findings.end(),
                     [](const auto& of) { return of.second.band.n_rows() > 0; });
}

// Bands of spectra are made of errors that are small.
std::string doubt_of_bands(const RunResult& result) {
  return has_bands(result) ? "; with errors this large, spectra may be off by far more than their bands" : "";
}

bool is_looser(const Problem& problem) {
  return !problem.monolithic && problem.solver.tolerance > LatinSettings{}.tolerance;
}

// What a loose tolerance leaves adds up from increment to increment, and the balance shows it; a preload's forces work
// on it.
std::string cure_of_balance(const Problem& problem, const RunResult& result, bool is_motion) {
  const Figures& figures = result.figures;
  constexpr double small = 1e-3;
  const double motion = figures.energy_of_motion.value_or(0.0), all = figures.largest_energy.value_or(0.0);
  if (!problem.monolithic && is_motion && motion < small * all)
    return fmt::format(
        "the motion has {:.2g} J against {:.2g} J stored before it, whose forces do work on the remaining interface "
        "error: 'tolerance = {:.1g}' closes it",
        motion, all, 0.1 * problem.solver.tolerance);
  const LatinSettings usual;
  const LatinSettings& asked = problem.solver;
  if (!problem.monolithic && (asked.static_tolerance > usual.static_tolerance || asked.tolerance > usual.tolerance))
    return fmt::format(
        "the tolerance is loose (tolerance {:g}, static_tolerance {:g}) and its errors add up: take {:g} "
        "and {:g}{}",
        asked.tolerance, asked.static_tolerance, usual.tolerance, usual.static_tolerance,
        is_motion && is_looser(problem) && has_bands(result)
            ? "; where they feed a lightly damped mode, spectra are off by more than their bands"
            : "");
  return "every increment has converged: if a ten times smaller tolerance does not close it, this is a bug: please "
         "report it with the deck";
}

// %, of the motion or of the static steps.
struct Shares {
  double lost, gained, open;
};

// Numerical dissipation and energy gain are the price of dt and mesh at impacts, of increments where gaps close: above
// a few percent the answer is not to be trusted.
void warn_of_books(const Problem& problem, const RunResult& result, const Shares& shares, bool is_motion) {
  const char* const what = is_motion ? "the energy of the motion" : "the energy of the static steps";
  const bool has_missed = std::any_of(result.steps.begin(), result.steps.end(),
                                      [](const StepSummary& step) { return step.increments_not_converged > 0; });
  if (shares.lost > limit::numerical_dissipation)
    warn(fmt::format("numerical dissipation takes {:.1f} % of {} ({} reduce it", shares.lost, what,
                     is_motion ? "impacts; releases): a smaller dt or smaller elements"
                               : "increments that close a gap, parts that stop): more static increments"));
  if (shares.gained > limit::energy_gain)
    warn(fmt::format("the numerical energy gain is {:.2f} % of {}: take {}", shares.gained, what,
                     is_motion ? "a smaller dt or tolerance" : "more static increments"));
  // A mode that gathers them has little of the energy: spectra show it first.
  const double share = is_motion && is_looser(problem) && has_bands(result) ? 0.2 : 1.0;
  if (shares.open > share * limit::energy_imbalance)
    warn(fmt::format("the energy balance is open by {:.2f} % of {}: {}", shares.open, what,
                     has_missed ? "some increments have not converged" : cure_of_balance(problem, result, is_motion)));
}

void warn_of_losses(const Problem& problem, const RunResult& result) {
  const double lost = result.figures.numerical_dissipation.value(), gained = result.figures.energy_gain.value(),
               open = result.figures.energy_imbalance.value();
  if (problem.explicit_dynamics) {
    const double held = limit::penalty_energy_of(result.figures.penalty_error.value());
    if (held > limit::penalty_energy)
      warn(
          fmt::format("the penalty springs hold up to {:.1f} % of the energy: a larger 'penalty' of solver.explicit "
                      "reduces the overlap of the sides",
                      held));
    if (const double hourglass = result.figures.hourglass_energy.value_or(0.0); hourglass > limit::hourglass_energy)
      warn(fmt::format(
          "hourglass modes hold up to {:.1f} % of the energy: take smaller elements or integration = \"full\"",
          hourglass));
    if (open > limit::energy_imbalance)
      warn(fmt::format("the energy balance is open by {:.2f} %: take a smaller 'safety' of solver.explicit", open));
    return;
  }
  const bool has_motion = result.figures.energy_of_motion.has_value();
  warn_of_books(problem, result, {lost, gained, open}, has_motion);
  if (result.figures.static_imbalance)
    warn_of_books(problem, result,
                  {result.figures.static_dissipation.value(), result.figures.static_gain.value(),
                   *result.figures.static_imbalance},
                  false);
}

// An error in energy norm may be a lag that has added up.
std::string frequency_text(const std::optional<double>& error) {
  return error ? fmt::format(", {:.2g} % in its frequencies", *error) : "";
}

// The run's own estimates, where they are too large to build on.
void warn_of_errors(const Problem& problem, const RunResult& result) {
  const Figures& figures = result.figures;
  const double iteration = figures.iteration_error.value_or(0.0), still = figures.static_iteration_error.value_or(0.0);
  if (!problem.monolithic && !problem.explicit_dynamics && iteration > limit::iteration_error && result.converged)
    warn(fmt::format(
        "the tolerance {:g} leaves an error of about {:.2g} % (energy norm) in the shock: {:.1g} would leave 0.1 %",
        problem.solver.tolerance, iteration, 0.1 * problem.solver.tolerance / iteration));
  if (!problem.monolithic && !problem.explicit_dynamics && still > limit::iteration_error && result.converged)
    warn(
        fmt::format("the static tolerance {:g} leaves an error of about {:.2g} % (energy norm) in the static steps: "
                    "{:.1g} would leave 0.1 %",
                    problem.solver.static_tolerance, still, 0.1 * problem.solver.static_tolerance / still));
  if (const double e = figures.time_step_error.value_or(0.0); e > limit::discretisation_error)
    warn(fmt::format(
        "the time step leaves an error of about {:.2g} % (energy norm) in the shock, which moves at {:.3g} "
        "kHz on average{}: use a smaller dt{}",
        e, figures.mean_frequency.value() / 1e3, frequency_text(figures.step_frequency_error), doubt_of_bands(result)));
  const std::string in_shock = "in the shock" + frequency_text(figures.mesh_frequency_error);
  for (const auto& [error, text, of_bands] :
       {std::tuple{figures.mesh_error, in_shock, doubt_of_bands(result)},
        {figures.static_mesh_error, std::string("in the static steps"), std::string()}})
    if (const double e = error.value_or(0.0); e > limit::discretisation_error)
      warn(
          fmt::format("the mesh leaves an error of about {:.2g} % (energy norm) {}: use smaller cells; "
                      "'stress_error' shows where{}",
                      e, text, of_bands));
}

// Of the parts on both sides of a bolt's interface the least that is known.
std::optional<double> least_yield(const Problem& problem, const std::string& bolt) {
  std::optional<double> least;
  for (const InterfacePtr& interface : problem.interfaces)
    if (interface->name == bolt)
      for (const SubstructurePtr& part : {interface->side_1.part, interface->side_2.part})
        if (const auto& yield = part->yield; yield && (!least || *yield < *least)) least = *yield;
  return least;
}

void warn_of_overtightened(const Problem& problem, const BoltSummary& bolt) {
  const std::optional<double> yield = least_yield(problem, bolt.name);
  const double stress = bolt.area > 0.0 ? bolt.tightened / bolt.area : 0.0;
  if (stress > yield.value_or(limit::bolt_stress))
    warn(fmt::format("bolt '{}' is tightened to {:.4g} N, {:.4g} MPa on its {:.4g} mm^2, and {}", bolt.name,
                     bolt.tightened, stress / 1e6, bolt.area * 1e6,
                     yield ? fmt::format("its parts yield at {:.4g} MPa", *yield / 1e6)
                           : fmt::format("no bolt bears more than {:.4g} MPa", limit::bolt_stress / 1e6)));
}

// Does a contact that a bolt clamps use all of its friction?
bool slides_under(const Problem& problem, const RunResult& result, const std::string& bolt) {
  constexpr double all = 0.99;
  const auto slides = [&](const InterfacePtr& contact) {
    for (const ContactSummary& told : result.contacts)
      for (const ContactStep& step : told.steps)
        if (told.name == contact->name && step.friction_used.value_or(0.0) > all) return true;
    return false;
  };
  for (const StepPtr& step : problem.steps)
    for (const LoadPtr& load : step->loads)
      for (const Effect& effect : load->effects())
        if (const Tightening* by = tightening(effect);
            by && by->rating && by->on->name == bolt &&
            std::any_of(by->rating->joint.begin(), by->rating->joint.end(), slides))
          return true;
  return false;
}

void warn_of_margins(const Problem& problem, const RunResult& result, const BoltSummary& bolt) {
  if (!bolt.margins) return;
  const bool slides = slides_under(problem, result, bolt.name);
  constexpr double used_up = 1e-3;  // friction and contact carry no more than that
  std::string negative;
  double least = 0.0;
  for (const auto& [against, margin] : {std::pair("proof", std::optional(bolt.margins->against_proof(bolt.tightened))),
                                        {"slip", bolt.margins->slip},
                                        {"separation", bolt.margins->against_separation()}})
    if (margin && *margin < used_up) {
      const bool is_bounded = against == std::string("slip") && slides;
      negative +=
          fmt::format("{}{} {:.2f}{}", negative.empty() ? "" : ", ", against, *margin,
                      is_bounded ? " or less (the joint slides: it carries no more shear than its friction)" : "");
      least = std::min(least, *margin);
    }
  if (!negative.empty())
    warn(fmt::format("bolt '{}' has {}: {}", bolt.name, least < 0.0 ? "negative margins" : "no margin left", negative),
         {"margins of bolts", -least, "'" + bolt.name + "'"});
}

// A shortening that a preload has found has no range of its own.
void warn_of_bolts(const Problem& problem, const RunResult& result) {
  for (const BoltSummary& bolt : result.bolts) {
    warn_of_overtightened(problem, bolt);
    warn_of_margins(problem, result, bolt);
  }
  for (const BoltSummary& bolt : result.bolts)
    if (std::abs(bolt.shortening) > limit::bolt_shortening)
      warn(fmt::format(
          "bolt '{}' is shortened by {:.3g} mm for its preload: is the force, or a gap, a thousand times too large?",
          bolt.name, bolt.shortening * 1e3));
  for (const BoltSummary& bolt : result.bolts)
    if (!bolt.loss() && bolt.target.value_or(bolt.tightened) > 0.0)
      warn(
          fmt::format("bolt '{}' is tightened to {:.4g} N, and up to {:.4g} N go through it: less than a tenth of that "
                      "is its own, so no loss is given; was a unit forgotten, or is the joint open?",
                      bolt.name, bolt.tightened, bolt.largest()));
}

}  // namespace

void warn_of_run(const Problem& problem, const RunResult& result, const std::filesystem::path& kept) {
  for (const std::string& warning : result.warnings) warn(warning);
  warn_of_missed(problem, result, kept);
  warn_of_losses(problem, result);
  warn_of_errors(problem, result);
  for (const OutputPtr& output : problem.outputs)
    for (const std::string& warning : result.findings_of(*output).warnings) warn(warning);
  warn_of_bolts(problem, result);
}

}  // namespace dygita
