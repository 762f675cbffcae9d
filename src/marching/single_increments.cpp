// One time step: forward once, iterate on the interfaces alone, backward once.
#include "marching/increments.hpp"

namespace dygita {

namespace {

class SingleIncrements final : public Increments {
 public:
  SingleIncrements(Iteration& iteration, StepBooks& books)
      : iteration_(iteration), step_(iteration.step()), books_(books), follow_(iteration) {}
  void solve(int increment, int last) override;

 private:
  Iteration& iteration_;
  StepData& step_;
  StepBooks& books_;
  Follow follow_;
};

void SingleIncrements::solve(int increment, int /*last*/) {
  Stages& stages = iteration_.stages();
  Iterate& at = step_.at;
  iteration_.told().begin_increment();
  if (LooseParts* const loose = iteration_.loose_parts(); loose && increment > 0) loose->stop();
  stages.begin_increment(increment, true);
  const bool has_start = iteration_.predict(increment);
  if (has_start && stages.system()) {
    stages.linear_stage(at.q, at.velocity);
    at.is_answered = true;
  }
  const Best best = follow_.solve(increment, step_.goal(has_start), follow_.leads(1));
  stages.finish_increment(at.q);
  step_.model.mean.take_off(step_.model.pieces, step_.model.here);
  if (best.outcome.eta > step_.settings.tolerance) books_.note_missed(best.missed);
  books_.accept_increment(increment, best.iterations, best.outcome.eta);
}

}  // namespace

std::unique_ptr<Increments> single_increments(Iteration& iteration, StepBooks& books) {
  return std::make_unique<SingleIncrements>(iteration, books);
}

}  // namespace dygita
