// output.modes: natural frequencies and shapes about the end of a step.
#include <algorithm>
#include <limits>
#include <map>

#include "base/log.hpp"
#include "base/names.hpp"
#include "model/effects.hpp"
#include "model/load.hpp"
#include "model/mode_forces.hpp"
#include "model/places.hpp"
#include "model/refusal.hpp"
#include "recording/output_table.hpp"
#include "recording/recorder.hpp"
#include "reduction/lumped_inertia.hpp"
#include "reduction/normal_modes.hpp"

namespace dygita {

namespace {

constexpr const char* directions_of_modes[] = {"x", "y", "z", "about_x", "about_y", "about_z"};

std::string frequencies_text(const NormalModes& modes) {
  constexpr int most = 8;
  const int first = std::min(modes.n_free, modes.n()), n = modes.n() - first;
  std::string text;
  for (int i = 0; i < std::min(most, n); ++i) text += fmt::format(" {:.5g}", modes.frequencies[first + i]);
  return text + (n > most ? " ... Hz" : " Hz");
}

std::string line_of_modes(const std::string& name, const NormalModes& modes) {
  std::string line = fmt::format("modes '{}': {} about ", name, modes.n()) +
                     (modes.about.empty() ? "the unloaded assembly" : "the end of step '" + modes.about + "'");
  if (modes.n_free > 0)
    line += fmt::format(", {} motion{} at 0 Hz, which nothing resists", modes.n_free, modes.n_free == 1 ? "" : "s");
  if (modes.n() > modes.n_free) line += ";" + frequencies_text(modes);
  if (modes.n() > 0)
    line += fmt::format("; effective masses {:.1f}, {:.1f}, {:.1f} % of {:.4g} kg along x, y, z", 100 * modes.share(0),
                        100 * modes.share(1), 100 * modes.share(2), modes.mass);
  if (modes.n_tied + modes.n_normal + modes.n_open > 0)
    line += fmt::format("; contact points: {} tied, {} along their normal, {} open", modes.n_tied, modes.n_normal,
                        modes.n_open);
  return line + (modes.missed > 0 ? fmt::format("; NOT CONVERGED: {} increments up to there", modes.missed) : "");
}

// A frame a mode, whose time is its frequency (Hz): increasing, those that are equal a little apart.
std::vector<Frame> frames_of_modes(const Problem& problem, const NormalModes& modes) {
  constexpr double apart = 1e-9;
  std::vector<Frame> frames(static_cast<size_t>(modes.n()));
  double last = 0.0;
  for (int m = 0; m < modes.n(); ++m) {
    Frame& frame = frames[static_cast<size_t>(m)];
    last = m == 0 ? modes.frequencies[0] : std::max({modes.frequencies[m], (1.0 + apart) * last, last + apart});
    frame.time = modes.frequencies[m];
    frame.label_time = last;
    frame.step = modes.about;
    frame.converged = modes.missed == 0;
    frame.missed = modes.missed;
    for (size_t p = 0; p < problem.substructures.size(); ++p) {
      const int first = modes.first_node[p], n = modes.first_node[p + 1] - first;
      frame.parts.push_back(
          {problem.substructures[p].get(), modes.shapes.col(m).segment(3 * first, 3 * n).reshaped(3, n), {}});
    }
  }
  return frames;
}

std::map<std::string, double> values_of(const NormalModes& modes) {
  std::map<std::string, double> values = {{"free_motions", modes.n_free}, {"mass", modes.mass}};
  for (int d = 0; d < 3; ++d) values[std::string("inertia_") + directions_of_modes[d]] = modes.moments[d];
  for (int d = 0; d < 6; ++d) values[std::string("share_") + directions_of_modes[d]] = modes.share(d);
  return values;
}

// What later steps of the run take of the modes.
struct ForLater {
  bool is_expected = false, is_alone = true;  // a run goes, on one process
  NormalModesPtr modes;
  std::vector<const Substructure*> parts;
  std::vector<Mat> mass_times_shapes;  // kg, of each part: 3 x its nodes rows, a column a mode
};

class ModesRecorder : public TableRecorder {
 public:
  // step: about whose end; null: about the unloaded assembly.
  ModesRecorder(const Columns& columns, const Problem& problem, const ModesRequest& request, const Step* step,
                ForLater& later)
      : TableRecorder(columns),
        problem_(problem),
        request_(request),
        later_(later),
        i_step_(step ? index_of(problem.steps, step) : -1) {
    doubt_lumped_inertia(problem);
    later_ = ForLater();
    later_.is_expected = true;
  }

  void begin_step(const Instant& start) override {
    if (i_step_ < 0 && start.i_step == 0) make(start, "");
  }

  void accept(const Instant& instant) override {
    missed_ += !instant.converged;
    if (instant.i_step == i_step_ && instant.increment + 1 == instant.model.step->n_increments())
      make(instant, instant.model.step->name);
  }

  void finish(Table& table, Findings& findings) override {
    if (modes_) {
      tell(findings);
    } else {
      findings.lines = {fmt::format("modes '{}': NOT MADE", request_.name)};
    }
    TableRecorder::finish(table, findings);
    if (modes_) table.mark(modes_->missed == 0);
  }

 private:
  // What is wrong with them does not stop a run that has other outputs: it is said, and nothing is written.
  void make(const Instant& instant, const std::string& about) {
    try {
      const LinearAssembly assembly = linearise(instant, request_.ties_sliding);
      auto modes = std::make_shared<NormalModes>(normal_modes(assembly, problem_, request_));
      modes->about = about;
      modes->missed = missed_;
      modes_ = std::move(modes);
      keep_for_later(instant, assembly);
    } catch (const InputError& error) {
      warn(error.what());
    } catch (const NumericalError& error) {
      warn(error.what());
    }
  }

  void keep_for_later(const Instant& instant, const LinearAssembly& assembly) {
    later_.modes = modes_;
    later_.is_alone = instant.distant == nullptr;
    later_.parts.clear();
    later_.mass_times_shapes.clear();
    for (size_t p = 0; p < problem_.substructures.size(); ++p) {
      const int first = modes_->first_node[p], n = modes_->first_node[p + 1] - first;
      later_.parts.push_back(problem_.substructures[p].get());
      later_.mass_times_shapes.emplace_back(assembly.nodal_masses[p] * modes_->shapes.middleRows(3 * first, 3 * n));
    }
  }

  void tell(Findings& findings) {
    for (int m = 0; m < modes_->n(); ++m) {
      std::vector<double> row = {modes_->frequencies[m], m + 1.0, modes_->damping_ratios[m],
                                 modes_->generalised_masses[m]};
      for (int d = 0; d < 6; ++d) row.push_back(modes_->participation(m, d));
      for (int d = 0; d < 6; ++d) row.push_back(modes_->effective_masses(m, d));
      add_values(row);
    }
    findings.values = values_of(*modes_);
    findings.model = modes_;
    findings.lines = {line_of_modes(request_.name, *modes_)};
    findings.frames = frames_of_modes(problem_, *modes_);
  }

  const Problem& problem_;
  const ModesRequest& request_;
  ForLater& later_;
  const int i_step_;
  int missed_ = 0;  // increments so far that have not converged
  NormalModesPtr modes_;
};

ModesRequest modes_request(const ModelArguments& a) {
  if (a.has("up_to") && a.has("n"))
    throw InputError("'n' and 'up_to' exclude each other: how many, or all up to a frequency");
  ModesRequest request{a.text("name"), a.origin()};
  request.up_to = a.number_or("up_to", 0.0);
  if (!a.has("up_to")) request.n = a.has("n") ? a.integer("n") : 10;
  request.ties_sliding = a.text("sliding") == "tied";
  return request;
}

class ModesOutput final : public Output, public ModeShapes {
 public:
  explicit ModesOutput(const ModelArguments& a) : Output(a), request_(modes_request(a)), after_(a.step("after")) {}

  void check(const Problem& problem) const override {
    const std::string who = known_as();
    check::files_are_free(problem, *this, {".pvd"});
    if (name == problem.name || name == "interfaces")
      check::fail(problem, origin, who + " would overwrite " + name + ".pvd",
                  "the problem's own name and 'interfaces' are those of the run's frames");
    if (after_) check::listed(problem, who + " is made after step", *after_, problem.steps, "steps");
    check_number(problem);
    for (const SupportPtr& support : supports_of(problem, *about(problem)))
      if (support->kind->absorbs())
        check::fail(problem, origin,
                    who + ": " + describe(*support) + " is a non-reflecting boundary in step '" + about(problem)->name +
                        "', which has no natural frequencies",
                    "give the step its own 'supports', without it");
  }

  // A grip that a load moves is let go of.
  void doubt(const Problem& problem) const override {
    const Step& step = *about(problem);
    for (const LoadPtr& load : step.loads)
      for (const Effect& effect : load->effects())
        if (std::holds_alternative<PrescribedMotion>(effect))
          return check::doubt(problem, origin,
                              known_as() + ": what " + load->path + " moves in step '" + step.name +
                                  "' is free in the modes, which supports alone hold");
  }

  Columns columns() const override {
    Columns columns = {{"frequency", "Hz"}, {"number", ""}, {"damping", ""}, {"generalised_mass", "kg"}};
    for (int d = 0; d < 6; ++d)
      columns.push_back({std::string("participation_") + directions_of_modes[d], d < 3 ? "" : "m"});
    for (int d = 0; d < 6; ++d)
      columns.push_back({std::string("effective_") + directions_of_modes[d], d < 3 ? "kg" : "kg m^2"});
    return columns;
  }

  Notes record(const Table&, const Findings& findings) const override {
    Notes notes = {{"sliding", std::string(request_.ties_sliding ? "tied" : "free")}};
    const auto* found = std::any_cast<NormalModesPtr>(&findings.model);
    if (!found) return notes;
    const NormalModes& modes = **found;
    if (!modes.about.empty()) notes.push_back({"after", modes.about});
    notes.push_back({"free_motions", modes.n_free});
    notes.push_back({"mass", modes.mass});
    notes.push_back({"centre", std::vector<double>{modes.centre[0], modes.centre[1], modes.centre[2]}});
    notes.push_back({"inertia", std::vector<double>{modes.moments[0], modes.moments[1], modes.moments[2]}});
    std::vector<double> shares;
    for (int d = 0; d < 6; ++d) shares.push_back(modes.share(d));
    notes.push_back({"shares", shares});
    notes.push_back(
        {"contact_points", Notes{{"tied", modes.n_tied}, {"normal", modes.n_normal}, {"open", modes.n_open}}});
    return notes;
  }

  std::vector<StudyFigure> study_figures() const override { return {{"frequency", StudyFigure::Of::lowest}}; }

  void hollow(const Table&, Findings& findings) const override {
    NormalModes none;
    none.effective_masses = Mat::Zero(0, 6);
    findings.values = values_of(none);
    for (auto& [key, value] : findings.values) value = std::numeric_limits<double>::quiet_NaN();
  }

  std::unique_ptr<Recorder> recorder(const Problem& problem, const FrameSink&) const override {
    return std::make_unique<ModesRecorder>(columns(), problem, request_, step_about(problem, after_), *later_);
  }

  Points shape(const Substructure& part, int number) const override {
    const int p = place_of(part, number);
    if (p < 0) return Points::Zero(3, part.mesh->n_nodes());
    const NormalModes& modes = *later_->modes;
    const int first = modes.first_node[static_cast<size_t>(p)], n = part.mesh->n_nodes();
    return modes.shapes.col(number - 1).segment(3 * first, 3 * n).reshaped(3, n);
  }
  Points mass_times_shape(const Substructure& part, int number) const override {
    const int p = place_of(part, number);
    if (p < 0) return Points::Zero(3, part.mesh->n_nodes());
    return later_->mass_times_shapes[static_cast<size_t>(p)].col(number - 1).reshaped(3, part.mesh->n_nodes());
  }
  double generalised_mass(int number) const override { return later_->modes->generalised_masses[number - 1]; }
  double frequency(int number) const override { return later_->modes->frequencies[number - 1]; }
  double damping_ratio(int number) const override { return later_->modes->damping_ratios[number - 1]; }

 private:
  // Of a part in what is kept; -1 before a run.
  int place_of(const Substructure& part, int number) const {
    if (!later_->is_expected) return -1;
    if (!later_->is_alone)
      throw InputError(origin, known_as() + ": one process alone loads parts in the shape of a mode");
    if (!later_->modes)
      throw NumericalError(known_as() + ": a step asks for mode " + std::to_string(number) +
                           " before there is one; likely cause: the step comes before the end of that about which the "
                           "modes are, or they could not be computed");
    if (number > later_->modes->n())
      throw NumericalError(known_as() + fmt::format(": a step asks for mode {} of {}", number, later_->modes->n()));
    const auto at = std::find(later_->parts.begin(), later_->parts.end(), &part);
    return at == later_->parts.end() ? -1 : static_cast<int>(at - later_->parts.begin());
  }

  // What would else be found when the steps have been solved.
  void check_number(const Problem& problem) const {
    int n_nodes = 0;
    for (const SubstructurePtr& part : problem.substructures) n_nodes += part->mesh->n_nodes();
    if (request_.n > 3 * n_nodes)
      check::fail(
          problem, origin,
          known_as() + fmt::format(": {} modes are asked for, and the parts have {} unknowns", request_.n, 3 * n_nodes),
          "take a smaller 'n'");
  }

  // Whose supports hold.
  const Step* about(const Problem& problem) const {
    const Step* step = step_about(problem, after_);
    return step ? step : problem.steps.front().get();
  }

  ModesRequest request_;
  StepPtr after_;
  std::unique_ptr<ForLater> later_ = std::make_unique<ForLater>();
};

}  // namespace

namespace outputs {
OutputEntry modes() { return {"modes", new_output<ModesOutput>, {Display::As::modes, "", 0}}; }
}  // namespace outputs

}  // namespace dygita
