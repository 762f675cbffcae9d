// output.superelement: the assembly condensed about the end of a step.
#include <map>
#include <set>

#include "base/log.hpp"
#include "base/names.hpp"
#include "model/places.hpp"
#include "model/refusal.hpp"
#include "numerics/dense.hpp"
#include "recording/output_table.hpp"
#include "recording/recorder.hpp"
#include "reduction/craig_bampton.hpp"
#include "reduction/lumped_inertia.hpp"
#include "reduction/superelement_files.hpp"

namespace dygita {

namespace {

std::string line_of(const std::string& name, const Superelement& element) {
  const size_t n_modes = static_cast<size_t>(element.fixed_frequencies.size());
  std::string line = fmt::format(
      "superelement '{}': {} interface rows and {} modes after step '{}', to be used up to {:.4g} Hz; natural "
      "frequencies",
      name, element.rows.size() - n_modes, n_modes, element.step, element.valid_to);
  int n = 0;
  for (;
       n < std::min<int>(8, static_cast<int>(element.frequencies.size())) && element.frequencies[n] <= element.valid_to;
       ++n)
    line += fmt::format(" {:.5g}", element.frequencies[n]);
  line += n == 0 ? " above that" : n < 8 ? " Hz, the others above that" : " ... Hz";
  return line + (element.missed > 0 ? "; " + unconverged_text(element) : "");
}

class SuperelementRecorder : public TableRecorder {
 public:
  SuperelementRecorder(const Columns& columns, const Problem& problem, const SuperelementRequest& request,
                       const Step* step)
      : TableRecorder(columns), problem_(problem), request_(request), i_step_(index_of(problem.steps, step)) {
    doubt_lumped_inertia(problem);
  }

  // What is wrong with it does not stop a run that has other outputs: it is said, and nothing is written.
  void accept(const Instant& instant) override {
    missed_ += !instant.converged;
    if (instant.i_step != i_step_ || instant.increment + 1 != instant.model.step->n_increments()) return;
    try {
      auto element =
          std::make_shared<Superelement>(condense(linearise(instant, request_.ties_sliding), problem_, request_));
      element->step = instant.model.step->name;
      element->missed = missed_;
      element_ = std::move(element);
    } catch (const InputError& error) {
      warn(error.what());
    } catch (const NumericalError& error) {
      warn(error.what());
    }
  }

  void finish(Table& table, Findings& findings) override {
    if (element_) {
      for (int i = 0; i < element_->frequencies.size(); ++i)
        add_values({element_->frequencies[i], element_->damping_ratios[i]});
      findings.model = element_;
      findings.files = [problem = problem_.name, request = request_, element = element_] {
        return superelement_files(problem, request, *element);
      };
    }
    findings.lines = {element_ ? line_of(request_.name, *element_)
                               : fmt::format("superelement '{}': NOT MADE", request_.name)};
    TableRecorder::finish(table, findings);
    if (element_) table.mark(element_->missed == 0);
  }

 private:
  const Problem& problem_;
  const SuperelementRequest& request_;
  const int i_step_;
  int missed_ = 0;  // increments so far that have not converged
  SuperelementPtr element_;
};

SuperelementRequest request_of(const ModelArguments& a) {
  static const std::map<std::string, FaceMotion> motions = {
      {"mean", FaceMotion::mean}, {"rigid", FaceMotion::rigid}, {"nodes", FaceMotion::nodes}};
  if (a.has("up_to") && a.has("modes"))
    throw InputError("'up_to' and 'modes' are mutually exclusive: modes are kept up to twice 'up_to'");
  SuperelementRequest request{a.text("name"), a.origin(), a.targets("on")};
  request.motion = motions.at(a.text("motion"));
  request.up_to = a.number_or("up_to", 0.0);
  request.modes = a.has("modes") ? a.integer("modes") : 0;
  request.ties_sliding = a.text("sliding") == "tied";
  request.as_dmig = a.text("format") == "dmig";
  return request;
}

// Do the nodes lie on a line, which does not turn about itself? A node alone does not count.
bool is_line(const FaceOrRegion& place) {
  constexpr double flat = 1e-12;  // of squares
  const std::vector<int> nodes = nodes_at(place);
  if (nodes.size() < 2) return false;
  const Points places = part_of(place).mesh->nodes(Eigen::all, nodes);
  const Points arms = places.colwise() - places.rowwise().mean();
  const Vec sizes = symmetric_eigen(arms * arms.transpose()).values;
  return sizes[1] <= flat * sizes[2];
}

// Of the faces, at the least: what supports hold has none, tied nodes of several parts have them together.
size_t least_unknowns(const Problem& problem, const Step& step, const std::vector<Target>& on) {
  std::map<const Substructure*, std::set<int>> held, joined, free;
  const auto add = [](const FaceOrRegion& place, auto& nodes) {
    const std::vector<int> own = nodes_at(place);
    nodes[&part_of(place)].insert(own.begin(), own.end());
  };
  for (const SupportPtr& support : supports_of(problem, step))
    for (const FaceOrRegion& place : support->on) add(place, held);
  for (const InterfacePtr& interface : problem.interfaces) {
    add(interface->side_1, joined);
    add(interface->side_2, joined);
  }
  for (const Target& target : on) add(*place_of(target), free);
  size_t n_free = 0, n_joined = 0;
  for (const auto& [part, nodes] : free) {
    size_t of_part = 0;
    for (const int node : nodes) {
      if (held[part].contains(node)) continue;
      ++(joined[part].contains(node) ? of_part : n_free);
    }
    n_joined = std::max(n_joined, of_part);
  }
  return 3 * (n_free + n_joined);
}

class SuperelementOutput final : public Output {
 public:
  explicit SuperelementOutput(const ModelArguments& a) : Output(a), request_(request_of(a)), after_(a.step("after")) {}

  // It is taken about the end of a step, with that step's supports.
  void check(const Problem& problem) const override {
    const std::string who = known_as();
    check::files_are_free(problem, *this,
                          {".json", ".md", "_mass.mtx", "_stiffness.mtx", "_damping.mtx", ".pch", "_points.csv"});
    check::is_on(problem, *this, request_.on, [](const Target& target) {
      return place_of(target) ? "" : "output.superelement takes faces or regions: where something is to be attached";
    });
    if (after_) check::listed(problem, who + " is made after step", *after_, problem.steps, "steps");
    const Step* step = step_about(problem, after_);
    if (!step)
      check::fail(problem, origin, who + ": the problem has no static step",
                  "it is linearised about the state after one; or name another step with 'after'");
    check_faces(problem, *step);
    for (const SubstructurePtr& part : problem.substructures)
      if (!part->mesh->inside->followers.empty())
        check::fail(
            problem, origin,
            who + ": superelement '" + part->name + "' has faces that move as a whole, which cannot be condensed again",
            "condense it with motion = \"nodes\"");
    for (const InterfacePtr& interface : problem.interfaces)
      if (interface->cyclic)
        check::fail(problem, origin,
                    who + ": " + describe(*interface) + " makes a sector of a ring, which is not condensed",
                    "condense the parts of the sector without it, and join the ring of superelements");
    for (const SubstructurePtr& part : problem.substructures)
      if (!part->material.damping.branches.empty())
        check::fail(problem, origin,
                    who + ": substructure '" + part->name + "' is of material '" + part->material.name +
                        "' with a 'damping_band', whose damping and stiffness change with frequency: constant matrices "
                        "cannot have it",
                    "take 'damping_frequency' for the superelement");
    for (const SupportPtr& support : supports_of(problem, *step))
      if (support->kind->absorbs())
        check::fail(problem, origin,
                    who + ": " + describe(*support) + " is a non-reflecting boundary in step '" + step->name +
                        "', which a superelement cannot represent",
                    "give the step its own 'supports' without it");
  }

  Columns columns() const override { return {{"frequency", "Hz"}, {"damping", ""}}; }

  Notes record(const Table&, const Findings&) const override {
    Notes notes;
    note_targets(request_.on, notes);
    return notes;
  }

  std::vector<StudyFigure> study_figures() const override { return {{"frequency", StudyFigure::Of::lowest}}; }

  std::unique_ptr<Recorder> recorder(const Problem& problem, const FrameSink&) const override {
    return std::make_unique<SuperelementRecorder>(columns(), problem, request_, step_about(problem, after_));
  }

 private:
  // What would else be found when the steps have been solved.
  void check_faces(const Problem& problem, const Step& step) const {
    const std::string who = known_as();
    if (const size_t n = least_unknowns(problem, step, request_.on); n > most_face_unknowns)
      check::fail(problem, origin,
                  who + fmt::format(": the faces of 'on' have {} unknowns or more, at most {} are allowed", n,
                                    most_face_unknowns),
                  "use smaller faces or larger cells there");
    for (const Target& target : request_.on)
      if (request_.motion == FaceMotion::rigid && is_line(*place_of(target)))
        check::fail(problem, origin,
                    who + ": the nodes of " + describe(target) +
                        " are collinear and cannot define rotation about their line: six rigid motions are required",
                    "take motion = \"nodes\", or use a face, or a region whose nodes are not collinear");
  }

  SuperelementRequest request_;
  StepPtr after_;
};

}  // namespace

namespace outputs {
OutputEntry superelement() {
  return {"superelement", new_output<SuperelementOutput>, {Display::As::frequencies, "", 0}};
}
}  // namespace outputs

}  // namespace dygita
