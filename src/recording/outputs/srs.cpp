// output.srs: the shock response spectrum of a history, with its band and what it is held against.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/log.hpp"
#include "base/names.hpp"
#include "estimates/spectrum_band.hpp"
#include "model/refusal.hpp"
#include "recording/output_table.hpp"
#include "recording/recorder.hpp"
#include "recording/spectra.hpp"
#include "result/limits.hpp"
#include "signal/unit.hpp"

namespace dygita {

namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

const char* quantity_text(SrsQuantity quantity) {
  switch (quantity) {
    case SrsQuantity::relative_displacement:
      return "relative displacement";
    case SrsQuantity::pseudo_velocity:
      return "pseudo-velocity";
    case SrsQuantity::absolute_acceleration:
      break;
  }
  return "acceleration";
}

class SrsOutput final : public Output {
 public:
  explicit SrsOutput(const ModelArguments& a)
      : Output(a),
        of_(a.output("of")),
        srs_(srs_settings(a)),
        specification_(a.specification("specification")),
        margin_(a.number_or("margin", 0.0)),
        judged_(a.has("judge") ? a.text("judge") : "maximax") {
    srs_.watches_end = true;
    if (specification_ && srs_.quantity != SrsQuantity::absolute_acceleration)
      throw InputError("a 'specification' requires absolute acceleration: omit 'quantity'");
  }

  // A spectrum is of one absolute acceleration over dynamic steps.
  void check(const Problem& problem) const override {
    const std::string who = known_as();
    const std::string hint = "'of' takes an output.history of quantity 'acceleration' with a 'direction'";
    if (!of_) check::fail(problem, origin, who + " has no 'of'", hint);
    check::listed(problem, who + " is of output", *of_, problem.outputs, "outputs");
    const std::optional<HistoryKind> history = of_->history();
    if (!history) check::fail(problem, origin, who + " is of " + of_->known_as(), hint);
    if (history->quantity != "acceleration")
      check::fail(problem, origin, who + " is of " + of_->known_as() + ", a " + history->quantity, hint);
    if (!history->has_direction)
      check::fail(problem, origin, who + " is of " + of_->known_as() + ", which has no direction", hint);
    check::names_are_free(problem, *this, {"_band"});
    check_spectrum(problem, *this, srs_);
  }

  Columns columns() const override {
    Columns columns = {{"frequency", "Hz"}};
    for (const char* spectrum : spectrum_names) columns.push_back({spectrum, spectrum_unit(srs_)});
    return columns;
  }

  Notes record(const Table& table, const Findings& findings) const override {
    Notes notes = {{"of", of_->name}, {"quantity", quantity_text(srs_.quantity)}, {"q_factor", srs_.q_factor}};
    if (judged_ != "maximax") notes.push_back({"judge", judged_});
    if (srs_.taper > 0.0) notes.push_back({"taper", srs_.taper});
    if (findings.band.n_rows() > 0) notes.push_back({"band", file_name_of(name) + "_band.csv"});
    if (!specification_) return notes;
    Notes against = {
        {"source", specification_->source}, {"frequency", specification_->frequency}, {"level", specification_->level}};
    if (margin_ > 0.0) against.push_back({"margin", margin_});
    if (const Exceedance worst = exceedance(table, findings); worst.is_known)
      against.push_back({"exceedance", Notes{{"decibels", worst.decibels}, {"frequency", worst.frequency}}});
    const FrequencyRange judged = judged_range(findings);
    against.push_back({"judged", std::vector<double>{judged.from, judged.to}});
    notes.push_back({"specification", std::move(against)});
    return notes;
  }

  std::vector<StudyFigure> study_figures() const override { return {{"maximax", StudyFigure::Of::largest}}; }
  std::unique_ptr<Recorder> recorder(const Problem&, const FrameSink&) const override { return nullptr; }
  std::optional<double> highest_frequency() const override { return srs_.to; }

  void conclude(const RunEnd& end, Table& table, Findings& findings) const override {
    const Table& history = end.result.tables.at(of_.get());
    const FrequencyRange judged = judged_by(end.problem, history);
    findings.values = {{"judged_from", judged.from}, {"judged_to", judged.to}};
    Srs srs = spectrum_of(end.problem, srs_, history, 1);
    if (judged_ == "primary") srs.ending.grows.assign(srs.frequency.size(), true);  // nothing else moves it
    table = {};
    if (!srs.frequency.empty()) {
      table = empty_table(columns());
      table.columns = {srs.frequency, srs.maximax, srs.positive, srs.negative, srs.primary, srs.residual};
      if (!of_->is_prescribed(end.problem)) {  // what is prescribed has no error, and ends as the deck says
        const std::vector<double>& record = judged_ == "primary" ? srs.ending.primary : srs.ending.maximax;
        // A run that is stopped before anything was sampled knows nothing of its mesh.
        const bool is_known = !end.result.interrupted || end.errors.mesh > 0.0;
        if (!end.problem.explicit_dynamics && is_known)
          findings.band = spectrum_band(table, srs_.quantity, errors_seen(end), record, judged_.c_str());
        findings.model =
            doubts_of_end("spectrum '" + name + "'", srs, record, judged, end_of_record(end.problem, history, 1));
      }
    }
    tell(table, findings);
  }

  void hollow(const Table&, Findings& findings) const override {
    for (const char* value : {"judged_from", "judged_to"}) findings.values[value] = not_known;
    if (specification_)
      for (const char* value : {"exceedance", "exceedance_at"}) findings.values[value] = not_known;
  }

  bool settles() const override { return true; }
  double settle(const Table& before, const Table& table, Findings& findings) const override {
    if (findings.band.n_rows() > 0) take_iteration_from(table, before, findings.band, judged_.c_str());
    tell(table, findings);
    return largest_move(table, before);
  }

 private:
  // Everything, where nobody has concluded it.
  static FrequencyRange judged_range(const Findings& findings) {
    const auto from = findings.values.find("judged_from"), to = findings.values.find("judged_to");
    return from == findings.values.end() ? FrequencyRange{} : FrequencyRange{from->second, to->second};
  }

  // Of the part that it is of, the one of most doubt where it is of several.
  ErrorEstimator::Estimate errors_seen(const RunEnd& end) const {
    ErrorEstimator::Estimate errors = end.errors;
    if (const auto* seen = std::any_cast<SeenParts>(&end.result.findings_of(*of_).model))
      for (const int part : seen->parts)
        if (static_cast<size_t>(part) < errors.parts.size() &&
            errors.parts[static_cast<size_t>(part)].imbalance > errors.seen.imbalance)
          errors.seen = errors.parts[static_cast<size_t>(part)];
    return errors;
  }

  Exceedance exceedance(const Table& table, const Findings& findings) const {
    if (!specification_ || table.n_rows() == 0) return {};
    return largest_exceedance(*specification_, table.columns.front(), table.column(judged_), judged_range(findings));
  }

  void tell(const Table& table, Findings& findings) const {
    findings.figures.clear();
    findings.lines.clear();
    const auto* doubts = std::any_cast<std::vector<std::string>>(&findings.model);  // those of the record's end
    findings.warnings = doubts ? *doubts : std::vector<std::string>();
    if (findings.band.n_rows() > 0) tell_band(findings);
    if (specification_ && table.n_rows() > 0) tell_specification(table, findings);
  }

  void tell_specification(const Table& table, Findings& findings) const {
    const Exceedance worst = exceedance(table, findings);
    findings.values["exceedance"] = worst.is_known ? worst.decibels : not_known;
    findings.values["exceedance_at"] = worst.is_known ? worst.frequency : not_known;
    if (!worst.is_known) {
      findings.warnings.push_back(
          fmt::format("spectrum '{}' is not compared with its specification ({:.4g} to {:.4g} Hz): they have no common "
                      "frequency between {:.4g} Hz, 1/record length, and {:.4g} Hz, half the sampling rate",
                      name, specification_->frequency.front(), specification_->frequency.back(),
                      findings.values["judged_from"], findings.values["judged_to"]));
      return;
    }
    findings.figures["largest exceedance of the specification of '" + name + "' [dB]"] = worst.decibels;
    findings.figures["frequency of the largest exceedance of '" + name + "' [Hz]"] = worst.frequency;
    const double asked = specification_->level_at(worst.frequency);
    findings.lines.push_back(
        fmt::format("spectrum '{}': {:.1f} dB {} its specification at {:.4g} Hz: {:.4g} g, asked {:.4g} g{}{}{}", name,
                    std::abs(worst.decibels), worst.decibels > 0.0 ? "above" : "below", worst.frequency,
                    asked * std::pow(10.0, worst.decibels / 20.0) / standard_gravity, asked / standard_gravity,
                    margin_ > 0.0 ? fmt::format(" and {:g} dB of margin", margin_) : "",
                    not_judged(table, findings, worst), not_covered(table)));
  }

  // What the specification asks beyond the frequencies of the spectrum.
  std::string not_covered(const Table& table) const {
    constexpr double same = 1.0 + 1e-6;
    const std::vector<double>&f = table.columns.front(), &asked = specification_->frequency;
    std::string text;
    if (asked.front() * same < f.front()) text += fmt::format(" from {:.4g} to {:.4g} Hz", asked.front(), f.front());
    if (asked.back() > f.back() * same)
      text += fmt::format("{} from {:.4g} to {:.4g} Hz", text.empty() ? "" : " and", f.back(), asked.back());
    return text.empty() ? "" : "; the spectrum has no frequency" + text + ", where the specification continues";
  }

  // Where the spectrum reads worse than in the range that is judged: ", judged from 1667 Hz on; at 500 Hz, ...".
  std::string not_judged(const Table& table, const Findings& findings, const Exceedance& worst) const {
    const Exceedance all = largest_exceedance(*specification_, table.columns.front(), table.column(judged_));
    if (all.decibels <= worst.decibels) return "";
    const FrequencyRange judged = judged_range(findings);
    return fmt::format(
        "; judged between {:.4g} Hz, 1/record length, and {:.4g} Hz, half the sampling rate: outside, at "
        "{:.4g} Hz, it reads {:.1f} dB {}, which this record cannot resolve",
        judged.from, judged.to, all.frequency, std::abs(all.decibels), all.decibels > 0.0 ? "above" : "below");
  }

  void tell_band(Findings& findings) const {
    const auto mean = [&](const std::string& column) { return mean_band(findings.band, column); };
    for (size_t i = 1; i < findings.band.names.size(); ++i) {
      const std::string& column = findings.band.names[i];
      findings.figures["spectrum '" + name + "', mean band, " + column + " [dB]"] = mean(column);
    }
    findings.lines.push_back(
        fmt::format("spectrum '{}': iteration leaves about {:.2g} dB, time step {:.2g} dB, mesh {:.2g} dB, the end of "
                    "the record {:.2g} dB (mean over its frequencies)",
                    name, mean("iteration"), mean("time_step"), mean("mesh"), mean("record")));
    if (const double all = mean_error_band(findings.band); all > limit::spectrum_band)
      findings.warnings.push_back(
          fmt::format("spectrum '{}' is uncertain by about {:.2g} dB (mean over its frequencies, by the run's own "
                      "estimate): the signal there is comparable to the discretisation error",
                      name, all));
  }

  OutputPtr of_;
  SrsSettings srs_;
  std::shared_ptr<const Specification> specification_;
  double margin_;       // dB, to be kept below it
  std::string judged_;  // the column that is held against it, and that the band is of
};

}  // namespace

namespace outputs {
OutputEntry srs() { return {"srs", new_output<SrsOutput>, {Display::As::spectrum, "", 0}}; }
}  // namespace outputs

}  // namespace dygita
