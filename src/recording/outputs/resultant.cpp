// output.resultant: the force through an interface or a support (manual, instants and means).
#include <algorithm>

#include "model/places.hpp"
#include "model/refusal.hpp"
#include "recording/output_table.hpp"
#include "recording/recorder.hpp"
#include "watch/surface_sums.hpp"

namespace dygita {

namespace {

class ResultantRecorder : public TableRecorder {
 public:
  ResultantRecorder(const Columns& columns, const Problem& problem, const std::vector<Target>& on)
      : TableRecorder(columns), problem_(problem), on_(on) {}

  void accept(const Instant& instant) override {
    const Resultant r = resultant(instant, problem_, on_);
    add_row(instant, mean_time(instant), {r.normal, r.shear, r.force[0], r.force[1], r.force[2]});
  }

 private:
  const Problem& problem_;
  const std::vector<Target>& on_;
};

class ResultantOutput final : public Output {
 public:
  explicit ResultantOutput(const ModelArguments& a) : Output(a), on_(a.targets("on")) {}

  void check(const Problem& problem) const override {
    check::is_on(problem, *this, on_, [](const Target& target) {
      return place_of(target) ? "output.resultant takes an interface or a support" : "";
    });
  }

  void doubt(const Problem& problem) const override {
    for (const Target& target : on_) {
      const auto* support = std::get_if<SupportPtr>(&target);
      if (support && std::any_of((*support)->on.begin(), (*support)->on.end(),
                                 [](const FaceOrRegion& on) { return std::holds_alternative<Region>(on); }))
        check::doubt(problem, origin,
                     known_as() + ": " + describe(**support) +
                         " is on a region, which has no normal: 'normal' is 0 and 'shear' is the total force; use a "
                         "face, or x, y, z");
    }
  }

  Columns columns() const override {
    return {{"time", "s"}, {"normal", "N"}, {"shear", "N"}, {"x", "N"}, {"y", "N"}, {"z", "N"}};
  }

  Notes record(const Table&, const Findings&) const override {
    Notes notes;
    note_targets(on_, notes);
    return notes;
  }

  std::vector<StudyFigure> study_figures() const override {
    return {{"normal", StudyFigure::Of::largest}, {"shear", StudyFigure::Of::largest}};
  }

  std::unique_ptr<Recorder> recorder(const Problem& problem, const FrameSink&) const override {
    return std::make_unique<ResultantRecorder>(columns(), problem, on_);
  }

 private:
  std::vector<Target> on_;
};

}  // namespace

namespace outputs {
// Normal and shear are drawn, not the components.
OutputEntry resultant() { return {"resultant", new_output<ResultantOutput>, {Display::As::curves, "force", 2}}; }
}  // namespace outputs

}  // namespace dygita
