// output.vtk: frames for ParaView, evenly over each step.
#include <algorithm>

#include "model/refusal.hpp"
#include "recording/output_table.hpp"
#include "recording/recorder.hpp"
#include "watch/frames.hpp"

namespace dygita {

namespace {

struct FrameRequest {
  int frames;  // a step
  std::vector<std::string> fields;
};

class FrameRecorder : public Recorder {
 public:
  FrameRecorder(const Problem& problem, const FrameRequest& request, FrameSink sink)
      : problem_(problem), request_(request), sink_(std::move(sink)) {}

  void begin_step(const Instant& start) override {
    motion_.begin_step(start);
    if (start.i_step == 0) give(start);
  }

  void accept(const Instant& instant) override {
    motion_.accept(instant);
    missed_ += !instant.converged;
    const int n = instant.model.step->n_increments(), i = instant.increment + 1;
    const long frames = std::min(request_.frames, n);
    // The step's last increment always.
    if ((i * frames) / n != ((i - 1) * frames) / n) give(instant);
  }

  void finish(Table&, Findings&) override {}

 private:
  void give(const Instant& instant) {
    Frame frame = make_frame(instant, request_.fields, motion_);
    frame.label_time = label_time(instant);
    frame.converged = instant.converged;
    frame.missed = missed_;
    sink_(frame);
  }

  // Static increments take a hundredth of the dynamic time each, so that frames follow one another; the first dynamic
  // step starts at zero.
  double label_time(const Instant& instant) const {
    double dynamic = 0.0;
    for (const StepPtr& step : problem_.steps)
      if (!step->is_static) dynamic += step->duration;
    const double unit = dynamic > 0.0 ? dynamic / 100.0 : 1.0;
    int before_dynamic = 0, so_far = 0;
    bool seen_dynamic = false;
    for (size_t i = 0; i < problem_.steps.size(); ++i) {
      const Step& step = *problem_.steps[i];
      seen_dynamic |= !step.is_static;
      if (!step.is_static) continue;
      if (!seen_dynamic) before_dynamic += step.increments;
      if (static_cast<int>(i) < instant.i_step) so_far += step.increments;
      if (static_cast<int>(i) == instant.i_step) so_far += instant.increment + 1;
    }
    return instant.time() + unit * (so_far - (seen_dynamic ? before_dynamic : 0));
  }

  const Problem& problem_;
  const FrameRequest& request_;
  FrameSink sink_;
  int missed_ = 0;  // increments so far that have not converged
  FollowedMotion motion_;
};

class VtkOutput final : public Output {
 public:
  explicit VtkOutput(const ModelArguments& a) : Output(a), request_{a.integer("frames"), a.texts("fields")} {}

  void check(const Problem& problem) const override {
    if (request_.frames < 1)
      check::fail(problem, origin,
                  "output.vtk: 'frames' = " + std::to_string(request_.frames) + ", at least 1 per step is needed");
    const auto asks = [&](const char* field) {
      return std::find(request_.fields.begin(), request_.fields.end(), field) != request_.fields.end();
    };
    const auto none = [&](const auto& has) {
      return std::none_of(problem.substructures.begin(), problem.substructures.end(),
                          [&](const SubstructurePtr& part) { return has(part->material); });
    };
    if (asks("failure_index") && none([](const Elastic& material) { return material.has_strength(); }))
      check::fail(problem, origin, "output.vtk: no material has a 'strength', of which a 'failure_index' would be");
    if (asks("material_stress") && none([](const Elastic& material) { return !material.is_isotropic(); }))
      check::fail(problem, origin, "output.vtk: no material has axes, along which a 'material_stress' would be");
  }

  Columns columns() const override { return {}; }
  Notes record(const Table&, const Findings&) const override {
    return {{"frames", request_.frames}, {"fields", request_.fields}};
  }
  std::vector<StudyFigure> study_figures() const override { return {}; }

  std::unique_ptr<Recorder> recorder(const Problem& problem, const FrameSink& sink) const override {
    return sink ? std::make_unique<FrameRecorder>(problem, request_, sink) : nullptr;
  }

 private:
  FrameRequest request_;
};

}  // namespace

namespace outputs {
OutputEntry vtk() { return {"vtk", new_output<VtkOutput>, {Display::As::nothing, "", 0}}; }
}  // namespace outputs

}  // namespace dygita
