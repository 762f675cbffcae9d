// output.attenuation: shock attenuation across a joint, the ratio of the spectra before and behind it by band.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/log.hpp"
#include "model/joint_path.hpp"
#include "model/refusal.hpp"
#include "recording/output_table.hpp"
#include "recording/placed.hpp"
#include "recording/recorder.hpp"
#include "recording/spectra.hpp"

namespace dygita {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// Rows of the spectrum in each band: centre (Hz), first and last row + 1. A band is kept if the spectrum goes through
// all of it; a spectrum of less than one band is one.
struct Band {
  double centre;
  size_t first, end;
};

std::vector<Band> bands_of(const std::vector<double>& frequency, const SrsSettings& settings, int per_octave) {
  std::vector<Band> bands;
  const double width = std::exp2(1.0 / per_octave);
  for (int b = 0;; ++b) {
    const double low = settings.from * std::exp2(static_cast<double>(b) / per_octave);
    if (low * width > settings.to * (1.0 + 1e-9)) break;
    Band band{low * std::sqrt(width), frequency.size(), 0};
    for (size_t i = 0; i < frequency.size(); ++i) {
      if (frequency[i] < low * (1.0 - 1e-9) || frequency[i] > low * width * (1.0 + 1e-9)) continue;
      band.first = std::min(band.first, i);
      band.end = i + 1;
    }
    if (band.end > band.first) bands.push_back(band);
  }
  if (bands.empty() && !frequency.empty())
    bands.push_back({std::sqrt(settings.from * settings.to), 0, frequency.size()});
  return bands;
}

// Mean in dB over the band's frequencies.
double level(const std::vector<double>& maximax, const Band& band) {
  double sum = 0.0;
  for (size_t i = band.first; i < band.end; ++i) sum += std::log(maximax[i]);
  return std::exp(sum / static_cast<double>(band.end - band.first));
}

class AttenuationOutput final : public Output {
 public:
  explicit AttenuationOutput(const ModelArguments& a)
      : Output(a),
        entering_(a.output("entering")),
        leaving_(a.output("leaving")),
        srs_(srs_settings(a)),
        bands_(a.integer("bands")) {
    if (a.has("joints")) n_joints_ = a.integer("joints");
    srs_.watches_end = true;
  }

  // What enters and what leaves are compared axis by axis.
  void check(const Problem& problem) const override {
    const std::string who = known_as();
    const std::string hint = "'entering' and 'leaving' take output.history of quantity 'acceleration'";
    bool has_direction[2] = {false, false};
    for (const auto& [i, key, of] : {std::tuple{0, "entering", entering_}, {1, "leaving", leaving_}}) {
      if (!of) check::fail(problem, origin, fmt::format("{} has no '{}'", who, key), hint);
      check::listed(problem, fmt::format("{} has '{}' of output", who, key), *of, problem.outputs, "outputs");
      const std::optional<HistoryKind> history = of->history();
      if (!history || history->quantity != "acceleration")
        check::fail(
            problem, origin,
            fmt::format("{}: '{}' is {}{}", who, key, of->known_as(), history ? ", a " + history->quantity : ""), hint);
      has_direction[i] = history->has_direction;
    }
    if (has_direction[0] != has_direction[1])
      check::fail(problem, origin, who + ": one of 'entering' and 'leaving' has a direction, the other has none",
                  "both with a direction, or both without for x, y and z");
    check_spectrum(problem, *this, srs_);
  }

  Columns columns() const override {
    Columns columns = {{"frequency", "Hz"}};
    for (const std::string& axis : axes()) {
      columns.push_back({"entering" + axis, spectrum_unit(srs_)});
      columns.push_back({"leaving" + axis, spectrum_unit(srs_)});
      columns.push_back({"ratio" + axis, "dB"});
    }
    return columns;
  }

  Notes record(const Table&, const Findings& findings) const override {
    Notes notes = {{"entering", entering_->name}, {"leaving", leaving_->name}};
    for (const auto& [of, value] : findings.values) {
      if (of == "rule" || of == "distance")
        notes.push_back({of, value});
      else
        notes.push_back({of, static_cast<int>(value)});
    }
    return notes;
  }

  void hollow(const Table&, Findings& findings) const override {
    findings.values = {{"bonds", 0.0}, {"distance", 0.0}, {"isolators", 0.0}, {"joints", 0.0}, {"rule", 0.0}};
  }

  std::vector<StudyFigure> study_figures() const override {
    std::vector<StudyFigure> figures;
    for (const std::string& axis : axes()) figures.push_back({"ratio" + axis, StudyFigure::Of::mean});
    return figures;
  }

  std::unique_ptr<Recorder> recorder(const Problem&, const FrameSink&) const override { return nullptr; }
  std::optional<double> highest_frequency() const override { return srs_.to; }

  // Band by band the level of both spectra and their ratio in dB, leaving over entering, NaN along an axis into which a
  // millionth of the strongest axis' level enters at most; the band's frequency is its centre (Hz). Bands that the
  // spectra do not fill are left out; less than one is a band of its own.
  void conclude(const RunEnd& end, Table& table, Findings& findings) const override {
    constexpr double nothing = 1e-6;  // of the level along the strongest axis
    table = empty_table(columns());
    std::vector<double> strongest;
    findings.warnings.clear();
    const JointPath path = path_in(end.problem);
    findings.values = {{"bonds", path.bonded},
                       {"distance", path.distance},
                       {"isolators", path.isolators},
                       {"joints", path.bolted},
                       {"rule", path.is_connected ? path.rule() : not_a_number}};
    for (size_t axis = 0; axis < axes().size(); ++axis) {
      const Srs in = spectrum_of(end.problem, srs_, end.result.tables.at(entering_.get()), axis + 1);
      const Srs out = spectrum_of(end.problem, srs_, end.result.tables.at(leaving_.get()), axis + 1);
      doubt_ends(end, {&in, &out}, axis, findings);
      const std::vector<Band> bands = bands_of(in.frequency, srs_, bands_);
      strongest.resize(bands.size(), 0.0);
      for (size_t b = 0; b < bands.size(); ++b) {
        if (axis == 0) table.columns[0].push_back(bands[b].centre);
        table.columns[3 * axis + 1].push_back(level(in.maximax, bands[b]));
        table.columns[3 * axis + 2].push_back(level(out.maximax, bands[b]));
        strongest[b] = std::max(strongest[b], table.columns[3 * axis + 1].back());
      }
    }
    for (size_t i = 1; i < table.columns.size(); i += 3)
      for (size_t b = 0; b < strongest.size(); ++b) {
        const double in = table.columns[i][b], out = table.columns[i + 1][b];
        table.columns[i + 2].push_back(in > nothing * strongest[b] ? 20.0 * std::log10(out / in) : not_a_number);
      }
    if (table.n_rows() > 0)
      findings.lines = {summary(table, judged_by(end.problem, end.result.tables.at(entering_.get())), path)};
  }

 private:
  // Between the places of the histories, with the number of joints that the deck gives.
  JointPath path_in(const Problem& problem) const {
    const auto place = [](const Output& of) {
      const auto* placed = dynamic_cast<const Placed*>(&of);
      const std::optional<FaceOrRegion> found = placed ? place_of(placed->places().front()) : std::nullopt;
      CHECK(found, "an acceleration has no place");
      return *found;
    };
    JointPath path = joint_path(problem, place(*entering_), place(*leaving_));
    if (n_joints_) path.bolted = *n_joints_, path.bonded = path.isolators = 0, path.is_connected = true;
    return path;
  }

  // Of the columns' names.
  std::vector<std::string> axes() const {
    const std::optional<HistoryKind> history = entering_->history();
    return history && history->has_direction ? std::vector<std::string>{""}
                                             : std::vector<std::string>{"_x", "_y", "_z"};
  }

  // Of the spectra that enter and that leave along an axis.
  void doubt_ends(const RunEnd& end, const std::array<const Srs*, 2>& spectra, size_t axis, Findings& findings) const {
    for (const auto& [of, srs] : {std::pair{entering_, spectra[0]}, {leaving_, spectra[1]}}) {
      if (of->is_prescribed(end.problem)) continue;
      const Table& history = end.result.tables.at(of.get());
      const std::string along = axes()[axis].empty() ? "" : " along " + axes()[axis].substr(1);
      for (const std::string& doubt : doubts_of_end(
               fmt::format("attenuation '{}': the spectrum of '{}'{}", name, of->name, along), *srs,
               srs->ending.maximax, judged_by(end.problem, history), end_of_record(end.problem, history, axis + 1)))
        findings.warnings.push_back(doubt);
    }
  }

  // Mean ratio of each axis over the bands that the record allows to judge, the lowest and the highest, beside the rule
  // of thumb.
  std::string summary(const Table& table, const FrequencyRange& judged, const JointPath& path) const {
    const std::vector<double>& centres = table.columns[0];
    const auto n_judged = std::count_if(centres.begin(), centres.end(), [&](double f) { return judged.holds(f); });
    if (n_judged == 0)
      return fmt::format(
          "attenuation '{}': no band lies between {:.4g} Hz, 1/record length, and {:.4g} Hz, half the "
          "sampling rate",
          name, judged.from, judged.to);
    std::string text;
    for (const std::string& axis : axes()) {
      const std::vector<double>& ratio = table.column("ratio" + axis);
      double sum = 0.0, n = 0.0, lowest = 0.0, highest = 0.0, lowest_at = 0.0, highest_at = 0.0;
      for (size_t i = 0; i < ratio.size(); ++i) {
        if (!std::isfinite(ratio[i]) || !judged.holds(centres[i])) continue;
        const double at = centres[i] / 1e3;
        if (n == 0.0 || ratio[i] < lowest) lowest = ratio[i], lowest_at = at;
        if (n == 0.0 || ratio[i] > highest) highest = ratio[i], highest_at = at;
        sum += ratio[i];
        n += 1.0;
      }
      text += text.empty() ? "" : "; ";
      if (!axis.empty()) text += axis.substr(1) + " ";
      const bool leaves_none = std::any_of(ratio.begin(), ratio.end(), [](double x) { return std::isinf(x); });
      text += n == 0.0 ? std::string(leaves_none ? "no output" : "no input")
                       : fmt::format("{:+.1f} dB ({:+.1f} at {:.3g} kHz, {:+.1f} at {:.3g} kHz)", sum / n, lowest,
                                     lowest_at, highest, highest_at);
    }
    return fmt::format(
        "attenuation '{}', mean of {} bands{} (lowest, highest): {}; {}", name, n_judged,
        n_judged < static_cast<long>(centres.size())
            ? fmt::format(", those from {:.4g} to {:.4g} Hz that the record holds", judged.from, judged.to)
            : "",
        text,
        path.is_connected ? fmt::format("rule of thumb for {}: {:+.1f} dB", path.text(), path.rule())
                          : "no interfaces lead from one to the other");
  }

  OutputPtr entering_, leaving_;  // histories
  SrsSettings srs_;
  int bands_;                    // an octave
  std::optional<int> n_joints_;  // bolted, on the way, for the rule of thumb; none: those of the model
};

}  // namespace

namespace outputs {
OutputEntry attenuation() { return {"attenuation", new_output<AttenuationOutput>, {Display::As::attenuation, "", 0}}; }
}  // namespace outputs

}  // namespace dygita
