// What a reader must know first: is the run good, by which figures, and every warning.
#include <cmath>

#include "base/log.hpp"
#include "drawing/svg_text.hpp"
#include "drawing/units.hpp"
#include "report/html.hpp"
#include "report/report_parts.hpp"
#include "report/spectra.hpp"
#include "result/limits.hpp"

namespace dygita {

namespace {

std::string percent(double value) { return value >= 0.0 && value < 0.01 ? "< 0.01\u00a0%" : with_unit(value, "%", 2); }

std::string card_html(const Card& card) {
  static constexpr const char* names[] = {"fine", "fair", "poor"};
  return fmt::format("<div class=\"card {}\"><small>{}</small><b>{}</b><small>{}</small></div>\n",
                     names[static_cast<int>(card.grade)], escaped(card.name), escaped(card.value), escaped(card.note));
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
  const std::string stopped_by = text(record, "stopped_by");
  if (verdict == "interrupted")
    return (stopped_by.empty() ? "Interrupted by the user: " : "Stopped by an error (" + stopped_by + "): ") +
           fmt::format("{} of {} increments were computed. Tables, figures and estimates end there.", increments,
                       asked) +
           (steps_that_missed(record).empty() ? "" : " Not converged: " + steps_that_missed(record) + ".");
  if (verdict == "converged")
    return fmt::format("Converged: {} reached {}.",
                       increments == 1.0 ? "the one increment" : fmt::format("all {} increments", increments),
                       tolerance.empty() ? "what the solver asks for" : "the tolerance of " + tolerance);
  return fmt::format(
      "NOT converged: {} missed the tolerance{}. Do not rely on later results until these increments converge: use "
      "more iterations, a smaller dt or more static increments.",
      steps_that_missed(record), tolerance.empty() ? "" : " of " + tolerance);
}

// Of a run that has not converged a margin, or a specification that is met, is no good news.
void doubt(Card& card, const Json& record) {
  if (steps_that_missed(record).empty()) return;
  if (card.grade == Grade::fine) card.grade = Grade::fair;
  card.note += "; NOT CONVERGED";
}

// The smallest margin against yield.
void add_margin(const RunFolder& run, std::vector<Card>& cards) {
  const Json* least = nullptr;
  const Json parts = run.record().value("substructures", Json::array());
  const auto margin = [](const Json& part) { return number(part.at("stress"), "margin"); };
  for (const Json& part : parts)
    if (part.contains("stress") && number(part["stress"], "von_mises") != 0.0 &&
        (!least || !(margin(part) >= margin(*least))))
      least = &part;
  if (!least) return;
  const double value = margin(*least);
  cards.push_back({"smallest margin against yield",
                   std::isfinite(value) ? plain_number(100.0 * value, 3) + "\u00a0%" : "not a number",
                   "in '" + text(*least, "name") + "', yield / von Mises − 1",
                   value >= limit::yield_margin ? Grade::fine : Grade::poor});
  doubt(cards.back(), run.record());
}

// A figure, if the run has it: fine up to `good`, poor beyond `limit`.
struct Judged {
  Figure figure;
  const char *name, *note;
  double good, limit;
};

// Static steps of a run with motion are mostly in order: only what matters has a card.
void add_static_books(const RunFolder& run, std::vector<Card>& cards) {
  const Judged of_statics[] = {
      {&Figures::static_imbalance, "energy balance, static", "of the static steps", 0.0, limit::energy_imbalance},
      {&Figures::static_dissipation, "numerical dissipation, static", "gaps that close; lower with more increments",
       0.0, limit::numerical_dissipation},
      {&Figures::static_gain, "numerical energy gain, static", "of the static steps", 0.0, limit::energy_gain}};
  for (const Judged& one : of_statics)
    if (run.has_figure(one.figure) && !(run.figure(one.figure) <= one.limit))
      cards.push_back({one.name,
                       std::isfinite(run.figure(one.figure)) ? percent(run.figure(one.figure)) : "not a number",
                       one.note, Grade::poor});
}

std::vector<Card> cards_of(const RunFolder& run) {
  const Json& steps = run.record().at("steps");
  const bool has_motion =
      std::any_of(steps.begin(), steps.end(), [](const Json& step) { return text(step, "kind") == "dynamic"; });
  const char* shock = "estimate, of the shock";
  const char* still = "estimate, of static steps";
  const double penalty = limit::penalty_error_of(limit::penalty_energy);
  const char* whose =
      run.has_figure(&Figures::energy_of_motion) ? "of the energy of the motion" : "of the largest energy";
  const Judged all[] = {
      {&Figures::energy_imbalance, "energy balance closes within", whose, limit::energy_imbalance,
       limit::energy_imbalance},
      {&Figures::numerical_dissipation, "numerical dissipation",
       has_motion ? "impacts; lower with dt and mesh" : "gaps that close, yielding; lower with more increments",
       limit::numerical_dissipation, limit::numerical_dissipation},
      {&Figures::iteration_error, "iteration error", shock, limit::iteration_error, limit::iteration_error},
      {&Figures::penalty_error, "penalty error", shock, penalty, penalty},
      {&Figures::time_step_error, "time step error", shock, limit::good_discretisation, limit::discretisation_error},
      {&Figures::mesh_error, "mesh error", shock, limit::good_discretisation, limit::discretisation_error},
      {&Figures::step_frequency_error, "frequency error, time step", "estimate, to report", limit::good_frequency,
       limit::frequency_error},
      {&Figures::mesh_frequency_error, "frequency error, mesh", "estimate, to report", limit::good_frequency,
       limit::frequency_error},
      {&Figures::mesh_amplitude_error, "amplitude error, mesh", "estimate, to report", limit::good_discretisation,
       limit::discretisation_error},
      {&Figures::static_iteration_error, "iteration error", still, limit::iteration_error, limit::iteration_error},
      {&Figures::static_mesh_error, "mesh error", still, limit::good_discretisation, limit::discretisation_error}};
  std::vector<Card> cards;
  for (const Judged& one : all) {
    if (!run.has_figure(one.figure)) continue;
    const double value = run.figure(one.figure);
    const Grade grade = value <= one.good ? Grade::fine : value <= one.limit ? Grade::fair : Grade::poor;
    cards.push_back({one.name, std::isfinite(value) ? percent(value) : "not a number", one.note, grade});
  }
  // A gain is mostly none: only one that matters has a card.
  if (const double gain = run.figure(&Figures::energy_gain); gain > limit::energy_gain)
    cards.push_back({"numerical energy gain", percent(gain), whose, Grade::poor});
  add_static_books(run, cards);
  add_margin(run, cards);
  return cards;
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

std::string verdict_section(const RunFolder& run, const ReportRequest& request) {
  const Json& record = run.record();
  const bool is_good = text(record, "verdict") == "converged";
  std::string body =
      fmt::format("<p class=\"verdict {}\">{}</p>\n", is_good ? "good" : "bad", escaped(verdict_text(record)));

  std::vector<Card> cards = cards_of(run);
  std::vector<std::string> findings;
  for (const Spectrum& spectrum : spectra_of(run, request)) {
    if (!spectrum.specification) continue;
    SpectrumVerdict found = verdict_of(spectrum, TimeAxis(record.at("steps")).judged());
    doubt(found.card, record);
    cards.push_back(std::move(found.card));
    findings.push_back(std::move(found.sentence) +
                       (steps_that_missed(record).empty() ? "" : " The run has NOT CONVERGED."));
  }
  if (!cards.empty()) {
    body += "<div class=\"cards\">\n";
    for (const Card& card : cards) body += card_html(card);
    body += "</div>\n";
    body += html::paragraph(fmt::format(
        "Green: fine. Amber: caution (a mesh or time step error above {:g} %, a specification margin smaller than the "
        "uncertainty, or a specification not judged over its whole range). Red: beyond the warning limit of a run, a "
        "specification exceeded, a yield reached. Errors of iteration, time step and mesh are in the energy norm, in "
        "which phase lags accumulate: use them to choose tolerance, dt and mesh. Report the frequency error with a "
        "frequency, the amplitude error with a stress or force (in static steps the mesh error), and the band with a "
        "spectrum.",
        limit::good_discretisation));
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
