// What a reader must know first: what the run shows, how sure it is, and every warning.
#include <algorithm>
#include <cmath>

#include "base/log.hpp"
#include "drawing/svg_text.hpp"
#include "drawing/units.hpp"
#include "report/findings.hpp"
#include "report/html.hpp"
#include "report/report_parts.hpp"
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
  if (steps_that_missed(record).empty())
    return "NOT to be relied on: the energy balance is open, although every increment has converged. Use a smaller "
           "tolerance or smaller increments; if that does not close it, please report the deck.";
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

// A figure, if the run has it: fine up to `good`, poor beyond `limit`.
struct JudgedFigure {
  Figure figure;
  const char *name, *note;
  double good, limit;
};

// Static steps of a run with motion are mostly in order: only what matters has a card.
void add_static_books(const RunFolder& run, std::vector<Card>& cards) {
  const JudgedFigure of_statics[] = {
      {&Figures::static_imbalance, "energy balance, static", "of the static steps", 0.0, limit::energy_imbalance},
      {&Figures::static_dissipation, "numerical dissipation, static", "gaps that close; lower with more increments",
       0.0, limit::numerical_dissipation},
      {&Figures::static_gain, "numerical energy gain, static", "of the static steps", 0.0, limit::energy_gain}};
  for (const JudgedFigure& one : of_statics)
    if (run.has_figure(one.figure) && !(run.figure(one.figure) <= one.limit))
      cards.push_back({one.name,
                       std::isfinite(run.figure(one.figure)) ? percent(run.figure(one.figure)) : "not a number",
                       one.note, Grade::poor});
}

// How sure it is.
std::vector<Card> trust_of(const RunFolder& run) {
  const Json& steps = run.record().at("steps");
  const bool has_motion =
      std::any_of(steps.begin(), steps.end(), [](const Json& step) { return text(step, "kind") == "dynamic"; });
  const char* shock = "estimate, of the shock";
  const char* still = "estimate, of static steps";
  const double penalty = limit::penalty_error_of(limit::penalty_energy);
  const char* whose =
      run.has_figure(&Figures::energy_of_motion) ? "of the energy of the motion" : "of the largest energy";
  const JudgedFigure all[] = {
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
  for (const JudgedFigure& one : all) {
    if (!run.has_figure(one.figure)) continue;
    const double value = run.figure(one.figure);
    const Grade grade = value <= one.good ? Grade::fine : value <= one.limit ? Grade::fair : Grade::poor;
    cards.push_back({one.name, std::isfinite(value) ? percent(value) : "not a number", one.note, grade});
  }
  // A gain is mostly none: only one that matters has a card.
  if (const double gain = run.figure(&Figures::energy_gain); gain > limit::energy_gain)
    cards.push_back({"numerical energy gain", percent(gain), whose, Grade::poor});
  add_static_books(run, cards);
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

namespace {

std::string tiles(const std::vector<Card>& cards) {
  if (cards.empty()) return "";
  std::string body = "<div class=\"cards\">\n";
  for (const Card& card : cards) body += card_html(card);
  return body + "</div>\n";
}

std::string meaning_of_colors() {
  return fmt::format(
      "Green: fine. Amber: to be kept in mind (a mesh or time step error above {:g} %, a specification that is met by "
      "less than the spectrum is uncertain or not judged over all of it, a preload of which less than {:.0f} % is "
      "left, "
      "a contact that slides or parts as a whole). Red: beyond the limit at which a run warns, a specification "
      "exceeded, "
      "a yield reached, a bolt that goes slack or has lost half. Errors of iteration, time step and mesh are in the "
      "energy norm, in which lags add up: they choose tolerance, dt and mesh. What to report of a frequency is its own "
      "error, of a stress or a force that of amplitudes (of static steps the mesh error), of a spectrum its band.",
      limit::good_discretisation, 100.0 * limit::good_preload_kept);
}

// By how much what is told is off, by the run's own estimate.
std::string told_of_trust(const RunFolder& run, const std::vector<Card>& trust) {
  std::string text;
  const double moving = run.figure(&Figures::mesh_amplitude_error), still = run.figure(&Figures::static_mesh_error);
  if (const double error = std::isfinite(moving) ? moving : still; std::isfinite(error))
    text = "Forces and stresses are uncertain by about " + percent(error) + ", by the run's own estimate.";
  std::string beyond;
  for (const Card& card : trust)
    if (card.grade == Grade::poor) beyond += (beyond.empty() ? "" : ", ") + card.name + " " + card.value;
  if (!beyond.empty())
    text += (text.empty() ? "" : " ") + ("Beyond the limits of what can be relied on: " + beyond + ".");
  return text;
}

Grade worst_of(const std::vector<Card>& cards) {
  Grade worst = Grade::fine;
  for (const Card& card : cards) worst = std::max(worst, card.grade);
  return worst;
}

}  // namespace

std::string verdict_section(const RunFolder& run, const ReportRequest& request) {
  const Json& record = run.record();
  const bool has_converged = text(record, "verdict") == "converged";
  const std::vector<Card> trust = trust_of(run);
  std::vector<Card> shown;
  std::string words;
  for (const Finding& finding : findings_of(run, request)) {
    if (!finding.sentence.empty()) words += (words.empty() ? "" : " ") + finding.sentence;
    shown.insert(shown.end(), finding.cards.begin(), finding.cards.end());
  }
  for (Card& card : shown) doubt(card, record);
  const std::string doubts = told_of_trust(run, trust), how_it_ended = verdict_text(record);
  // How the run ended comes first where it is no good news, last where it is.
  std::string body;
  for (const std::string& part : {has_converged ? "" : how_it_ended, words, doubts, has_converged ? how_it_ended : ""})
    if (!part.empty()) body += (body.empty() ? "" : "<br/>\n") + escaped(part);
  const Grade worst = std::max(worst_of(shown), worst_of(trust));
  static constexpr const char* styles[] = {"good", "fair", "bad"};
  body = fmt::format("<p class=\"verdict {}\">{}</p>\n",
                     styles[has_converged ? static_cast<int>(worst) : static_cast<int>(Grade::poor)], body);
  body += tiles(shown);
  if (!trust.empty()) body += html::heading("How sure it is") + tiles(trust);
  if (!shown.empty() || !trust.empty())
    body += html::folded("What the colours mean", html::paragraph(meaning_of_colors()));
  return html::section("Verdict", body + warnings_part(record));
}

}  // namespace dygita
