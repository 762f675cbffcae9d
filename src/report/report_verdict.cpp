// What a reader must know first: is the run good, by which figures, and every warning.
#include <cmath>

#include "base/log.hpp"
#include "report/html.hpp"
#include "report/report_parts.hpp"
#include "report/svg_text.hpp"
#include "report/units.hpp"
#include "result/limits.hpp"

namespace dygita {

namespace {

struct Card {
  std::string name, value, note;
  bool is_fine = true;
};

std::string percent(double value) { return value >= 0.0 && value < 0.01 ? "< 0.01\u00a0%" : with_unit(value, "%", 2); }

std::string card_html(const Card& card) {
  return fmt::format("<div class=\"card {}\"><small>{}</small><b>{}</b><small>{}</small></div>\n",
                     card.is_fine ? "fine" : "poor", escaped(card.name), escaped(card.value), escaped(card.note));
}

std::string counted(double n, const std::string& what) {
  return fmt::format("{:.0f} {}{}", n, what, n == 1.0 ? "" : "s");
}

std::string steps_that_missed(const Json& record) {
  std::string missed;
  for (const Json& step : record.at("steps"))
    if (number(step, "increments_not_converged") > 0)
      missed += fmt::format("{}{} of the {} of step '{}' (worst indicator {})", missed.empty() ? "" : ", ",
                            number(step, "increments_not_converged"), counted(number(step, "increments"), "increment"),
                            text(step, "name"), plain_number(number(step, "worst_indicator"), 2));
  return missed;
}

std::string tolerances(const Json& record) {
  const Json& solver = record.at("solver");
  if (!std::isfinite(number(solver, "tolerance"))) return "";
  std::string result = plain_number(number(solver, "tolerance"), 2);
  if (std::isfinite(number(solver, "static_tolerance")))
    result += " (static steps: " + plain_number(number(solver, "static_tolerance"), 2) + ")";
  return result;
}

std::string verdict_text(const Json& record) {
  const std::string verdict = text(record, "verdict"), tolerance = tolerances(record);
  double increments = 0.0, asked = 0.0;
  for (const Json& step : record.at("steps")) {
    increments += number(step, "increments");
    const double of_step = number(step, "asked_increments");
    asked += std::isfinite(of_step) ? of_step : number(step, "increments");
  }
  if (verdict == "interrupted")
    return fmt::format(
               "Interrupted by the user: {} of {} increments were computed. Tables, figures and estimates end there.",
               increments, asked) +
           (steps_that_missed(record).empty() ? "" : " Not converged: " + steps_that_missed(record) + ".");
  if (verdict == "converged")
    return fmt::format("Converged: {} reached {}.",
                       increments == 1.0 ? "the one increment" : fmt::format("all {} increments", increments),
                       tolerance.empty() ? "what the solver asks for" : "the tolerance of " + tolerance);
  return fmt::format(
      "NOT converged: {} stopped short of the tolerance{}. Do not rely on what follows these increments before they "
      "converge: more iterations, a smaller dt or more static increments.",
      steps_that_missed(record), tolerance.empty() ? "" : " of " + tolerance);
}

}  // namespace

std::string title_section(const RunFolder& run) {
  const Json& record = run.record();
  const Json solver = record.value("solver", Json::object()), deck = record.value("deck", Json::object()),
             program = record.value("program", Json::object());
  std::string under = "case " + text(record, "case");
  if (!text(deck, "path").empty()) under += " · deck " + text(deck, "path");
  under += " · solver " + text(solver, "name");
  if (!text(solver, "command_line").empty()) under += " (" + text(solver, "command_line") + ")";
  if (const double earlier = run.figure(&Figures::earlier_iterations); std::isfinite(earlier))
    under += fmt::format(" · continued from {:.0f} iterations", earlier);
  under += " · dygita " + text(program, "version");
  return "<h1>" + escaped(text(record, "problem")) + "</h1>\n<p class=\"under\">" + escaped(under) + "</p>\n";
}

std::string verdict_section(const RunFolder& run, const std::vector<std::string>& findings) {
  const Json& record = run.record();
  const bool is_good = text(record, "verdict") == "converged";
  std::string body =
      fmt::format("<p class=\"verdict {}\">{}</p>\n", is_good ? "good" : "bad", escaped(verdict_text(record)));

  const Json& steps = record.at("steps");
  const bool has_motion =
      std::any_of(steps.begin(), steps.end(), [](const Json& step) { return text(step, "kind") == "dynamic"; });
  std::vector<Card> cards;
  const auto add = [&](Figure figure, const char* name, const char* note, double limit) {
    const double value = run.figure(figure);
    if (std::isfinite(value))
      cards.push_back({name, percent(value), note, value <= limit});
    else if (run.has_figure(figure))
      cards.push_back({name, "not a number", note, false});
  };
  add(&Figures::energy_imbalance, "energy balance closes within", "of the largest energy", limit::energy_imbalance);
  add(&Figures::numerical_dissipation, "numerical dissipation",
      has_motion ? "impacts; lower with dt and mesh" : "gaps that close, yielding; lower with more increments",
      limit::numerical_dissipation);
  add(&Figures::iteration_error, "iteration error", "estimate, of the shock", limit::iteration_error);
  add(&Figures::penalty_error, "penalty error", "estimate, of the shock",
      limit::penalty_error_of(limit::penalty_energy));
  add(&Figures::time_step_error, "time step error", "estimate, of the shock", limit::discretisation_error);
  add(&Figures::mesh_error, "mesh error", "estimate, of the shock", limit::discretisation_error);
  add(&Figures::static_iteration_error, "iteration error", "estimate, of static steps", limit::iteration_error);
  add(&Figures::static_mesh_error, "mesh error", "estimate, of static steps", limit::discretisation_error);
  if (!cards.empty()) {
    body += "<div class=\"cards\">\n";
    for (const Card& card : cards) body += card_html(card);
    body += "</div>\n";
    body += html::paragraph(
        "Green: below the limit at which a run warns. Errors are in the energy norm: a force or a displacement is "
        "usually better, an "
        "acceleration worse.");
  }
  body += html::list(findings);
  std::vector<std::string> warnings;
  if (record.contains("warnings"))
    for (const Json& warning : record["warnings"])
      if (warning.is_string()) warnings.push_back(warning.get<std::string>());
  if (warnings.empty()) return html::section("Verdict", body + html::paragraph("No warnings."));
  return html::section("Verdict", body + html::heading(counted(static_cast<double>(warnings.size()), "warning")) +
                                      html::list(warnings, "warnings"));
}

}  // namespace dygita
