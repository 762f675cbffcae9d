// output.ringdown: frequency and damping of a vibration that decays freely, against its amplitude (manual, eq. D20).
#include "signal/ringdown.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/log.hpp"
#include "model/refusal.hpp"
#include "recording/output_table.hpp"
#include "recording/recorder.hpp"
#include "recording/spectra.hpp"

namespace dygita {

namespace {

class RingdownOutput final : public Output {
 public:
  explicit RingdownOutput(const ModelArguments& a)
      : Output(a),
        of_(a.output("of")),
        modes_(a.output("mode")),
        number_(a.has("number") ? a.integer("number") : 0),
        step_(a.step("step")),
        from_(a.number("from")) {
    if (a.has("band")) band_ = {a.numbers("band")[0], a.numbers("band")[1]};
    if (modes_ && !band_.empty()) throw InputError("'band' and 'mode' are mutually exclusive: omit one");
    if (!band_.empty() && (band_[0] >= band_[1] || band_[1] > 3.0 * band_[0]))
      throw InputError(
          fmt::format("'band' = {{ {:g}, {:g} }} Hz: it requires a second frequency above the first, and at "
                      "most three times as high",
                      band_[0], band_[1]));
  }

  void check(const Problem& problem) const override {
    const std::string who = known_as();
    const std::string hint = "'of' takes an output.history with one column, such as one with a 'direction'";
    check::listed(problem, who + " is of output", *of_, problem.outputs, "outputs");
    if (!of_->history() || of_->columns().size() != 2)
      check::fail(problem, origin, who + " is of " + of_->known_as() + ", which has more than one column", hint);
    if (modes_) check::listed(problem, who + " is of", *modes_, problem.outputs, "outputs");
    if (step_) {
      check::listed(problem, who + " is of step", *step_, problem.steps, "steps");
      if (step_->is_static)
        check::fail(problem, origin, who + ": step '" + step_->name + "' is static", "a ring-down takes time");
    }
    const Step* step = step_of(problem);
    if (!step)
      check::fail(problem, origin, who + ": the problem has no dynamic step", "a ring-down requires a dynamic step");
    if (from_ >= step->duration)
      check::fail(problem, origin,
                  fmt::format("{}: 'from' = {:g} s is not within the {:g} s of step '{}'", who, from_, step->duration,
                              step->name));
    if (!band_.empty()) check_band(problem, *step);
  }

  void doubt(const Problem& problem) const override {
    constexpr double least = 20.0;  // time steps a period: the scheme's phase lag is then 0.8 %
    const Step& step = *step_of(problem);
    if (!band_.empty() && step.dt * band_[1] * least > 1.0)
      check::doubt(problem, origin,
                   fmt::format("{}: step '{}' has {:.3g} time steps a period at {:g} Hz: the time scheme makes the "
                               "frequency too low by about {:.2g} %; use dt = {:.2g} s or less",
                               known_as(), step.name, 1.0 / (step.dt * band_[1]), band_[1],
                               100.0 * std::pow(2.0 * std::numbers::pi * band_[1] * step.dt, 2) / 12.0,
                               1.0 / (least * band_[1])));
  }

  Columns columns() const override {
    const std::string unit = of_ && of_->columns().size() == 2 ? of_->columns()[1].unit : "";
    return {{"time", "s"}, {"amplitude", unit}, {"frequency", "Hz"}, {"damping", ""}};
  }

  Notes record(const Table&, const Findings&) const override {
    Notes notes = {{"of", of_->name}};
    if (modes_) notes.push_back({"mode", number_});
    if (!band_.empty()) notes.push_back({"band", band_});
    return notes;
  }

  std::vector<StudyFigure> study_figures() const override {
    return {{"frequency", StudyFigure::Of::mean}, {"damping", StudyFigure::Of::mean}};
  }
  std::unique_ptr<Recorder> recorder(const Problem&, const FrameSink&) const override { return nullptr; }
  std::optional<double> highest_frequency() const override {
    return band_.empty() ? std::nullopt : std::optional<double>(band_[1]);
  }

  void conclude(const RunEnd& end, Table& table, Findings& findings) const override {
    table = empty_table(columns());
    std::vector<double> band = band_;
    if (modes_ && !band_of_mode(end.result.tables.at(modes_.get()), band)) {
      findings.lines = {fmt::format("ring-down '{}': NOT MADE: mode {} is at 0 Hz or was not found", name, number_)};
      return;
    }
    const Ringdown found = ring_down(record_of(end), band[0], band[1]);
    if (found.time.empty()) {
      findings.lines = {
          fmt::format("ring-down '{}': NOT MADE: nothing vibrates between {:.5g} and {:.5g} Hz, or what does outside "
                      "is stronger, or the "
                      "record is shorter than {:.3g} s",
                      name, band[0], band[1], 2.0 * ringdown_window(band[0], band[1]))};
      return;
    }
    table.columns = {found.time, found.amplitude, found.frequency, found.damping};
    tell(found, end.errors.iteration, findings);
  }

 private:
  // The one asked for, else the last dynamic one; null: there is none.
  const Step* step_of(const Problem& problem) const {
    if (step_) return step_.get();
    const auto last = std::find_if(problem.steps.rbegin(), problem.steps.rend(),
                                   [](const StepPtr& step) { return !step->is_static; });
    return last == problem.steps.rend() ? nullptr : last->get();
  }

  void check_band(const Problem& problem, const Step& step) const {
    if (2.0 * band_[1] * step.dt >= 1.0)
      check::fail(problem, origin,
                  fmt::format("{}: 'band' ends at {:g} Hz, above half the sampling rate of step '{}', {:g} Hz",
                              known_as(), band_[1], step.name, 0.5 / step.dt));
    const double needed = 2.0 * ringdown_window(band_[0], band_[1]);
    if (from_ + needed >= step.duration)
      check::fail(problem, origin,
                  fmt::format("{}: a band of {:g} Hz requires {:.3g} s of free vibration, step '{}' has {:.3g}",
                              known_as(), band_[1] - band_[0], needed, step.name, step.duration - from_),
                  "widen 'band', to three times its first frequency at most, or use a longer step");
  }

  // Half of the way to the nearest other frequency, a third of its own at most: Hz. False: there is no such mode.
  bool band_of_mode(const Table& modes, std::vector<double>& band) const {
    const std::vector<double>& all = modes.column("frequency");
    if (number_ > static_cast<int>(all.size())) return false;
    const double own = all[static_cast<size_t>(number_ - 1)];
    if (!(own > 0.0)) return false;
    constexpr double same = 1e-3;  // modes of one frequency, as the two bendings of a square bar, ring down together
    double reach = 0.5 * own;
    for (const double other : all)
      if (const double way = std::abs(other - own); way > same * own) reach = std::min(reach, 0.5 * way);
    band = {own - reach, own + reach};
    return true;
  }

  EvenStretch record_of(const RunEnd& end) const {
    const Step* const step = step_of(end.problem);
    const Table& history = end.result.tables.at(of_.get());
    EvenStretch record{0.0, step->dt, {}};
    double begins = 0.0;  // time does not advance in static steps
    for (const StepPtr& before : end.problem.steps) {
      if (before.get() == step) break;
      begins += before->is_static ? 0.0 : before->duration;
    }
    for (size_t i = 0; i < history.step.size(); ++i) {
      if (end.problem.steps[static_cast<size_t>(history.step[i])].get() != step) continue;
      if (history.columns[0][i] < begins + from_) continue;
      if (record.values.empty()) record.start = history.columns[0][i];
      record.values.push_back(history.columns[1][i]);
    }
    return record;
  }

  // iteration: error of the motion, in parts of its largest.
  void tell(const Ringdown& found, double iteration, Findings& findings) const {
    const std::string unit = columns()[1].unit;
    const auto at = [&](size_t i) {
      return fmt::format("{:.5g} Hz and {:.3g} % of critical damping at {:.4g} {}", found.frequency[i],
                         100.0 * found.damping[i], found.amplitude[i], unit);
    };
    // What an iteration leaves is a part of the first amplitude, and of small ones a larger part: a percent at a
    // hundred times it, as far as a linear mass on a bushing shows.
    constexpr double visible = 100.0;
    const auto seen = [&](double amplitude) { return amplitude >= visible * iteration * found.amplitude.front(); };
    size_t last = found.time.size() - 1;
    while (last > 0 && !seen(found.amplitude[last])) --last;
    findings.lines = {fmt::format("ring-down '{}': {}", name, at(0)) + (last > 0 ? ", " + at(last) : "")};
    if (last + 1 < found.time.size())
      findings.lines[0] += fmt::format(
          "; rows below {:.2g} {} are uncertain, since iterations leave {:.2g} % of the first amplitude: tighten the "
          "tolerance",
          visible * iteration * found.amplitude.front(), unit, 100.0 * iteration);
    const auto least = std::min_element(found.damping.begin(), found.damping.end());
    constexpr double rounding = -1e-4;
    if (*least < rounding)
      findings.warnings = {fmt::format(
          "ring-down '{}' grows at {:.4g} s, by {:.2g} % of critical damping: a load still acts, or another vibration "
          "lies in its band; use 'from' to leave the forced part out, or a narrower 'band'",
          name, found.time[static_cast<size_t>(least - found.damping.begin())], -100.0 * *least)};
  }

  OutputPtr of_, modes_;
  int number_;
  StepPtr step_;
  double from_;               // s
  std::vector<double> band_;  // Hz; empty: of the mode
};

}  // namespace

namespace outputs {
OutputEntry ringdown() { return {"ringdown", new_output<RingdownOutput>, {Display::As::amplitude, "", 0}}; }
}  // namespace outputs

}  // namespace dygita
