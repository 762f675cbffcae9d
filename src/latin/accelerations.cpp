// What improves V and the image within an iteration with constant search directions.
#include <algorithm>

#include "latin/coarse_correction.hpp"
#include "latin/iteration.hpp"
#include "step/joint_solves.hpp"

namespace dygita {

namespace {

// Balance of tied substructures against their rigid motions.
class BalanceTies final : public Strategy {
 public:
  BalanceTies(StepData& step, CoarseCorrection coarse) : step_(step), coarse_(std::move(coarse)) {}
  bool corrects() const override { return true; }
  void correct() override {
    const Stopwatch watch(step_.seconds.interface);
    if (step_.files.trail) step_.at.uncorrected = step_.at.q;
    coarse_.correct(step_.at.q, step_.at.velocity);
  }

 private:
  StepData& step_;
  CoarseCorrection coarse_;
};

// Both stages in turn from the fields at hand on, the pieces by their rough operators: the image then knows what came
// back from the neighbourhood of each point. Fields and indicator stay those of the last iteration.
class InnerIterations final : public Strategy {
 public:
  explicit InnerIterations(StepData& step) : step_(step) {}
  void after_local_stage() override {
    Iterate& at = step_.at;
    for (int n = 0; n < step_.settings.n_inner; ++n) {
      {
        const Stopwatch watch(step_.seconds.interface);
        velocity_.resize(at.velocity.size());
        answer();
      }
      const Stopwatch watch(step_.seconds.local);
      step_.model.near.exchange({velocity_.data()});
      step_.local.answer(velocity_, at.image, image_);
      at.image.swap(image_);
    }
  }

 private:
  void answer();

  StepData& step_;
  Vec velocity_, image_;
};

void InnerIterations::answer() {
  const Iterate& at = step_.at;
  if (joint::is_joint()) {  // all pieces are here
    joint::rough_changes(step_.model, at.image - at.q, velocity_);
    velocity_ += at.velocity;
    return;
  }
  step_.loops.for_each([&](Piece& piece, int i) {
    const int first = step_.model.near.start(i), n_rows = piece.n_rows();
    auto velocity = velocity_.segment(first, n_rows);
    piece.rough_change(at.image.segment(first, n_rows) - at.q.segment(first, n_rows), velocity);
    velocity += at.velocity.segment(first, n_rows);
  });
}

}  // namespace

std::unique_ptr<Strategy> balance_ties(Iteration& iteration, const Vec& k) {
  StepData& step = iteration.step();
  if (!step.settings.has_correction) return nullptr;
  std::shared_ptr<const CoarseCorrection>* const shared = step.files.coarse;
  std::shared_ptr<const CoarseCorrection> coarse = shared ? *shared : nullptr;
  if (!coarse || !coarse->serves(step.model, k)) coarse = std::make_shared<const CoarseCorrection>(step.model, k);
  if (shared && !*shared) *shared = coarse;
  if (coarse->is_empty()) return nullptr;
  return std::make_unique<BalanceTies>(step, *coarse);
}

std::unique_ptr<Strategy> iterate_roughly(Iteration& iteration) {
  StepData& step = iteration.step();
  if (!step.iterates_roughly) return nullptr;
  return std::make_unique<InnerIterations>(step);
}

}  // namespace dygita
