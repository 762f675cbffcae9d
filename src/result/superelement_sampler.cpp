// The condensed assembly of an output.superelement, made when its step has ended.
#include "base/log.hpp"
#include "result/collector.hpp"
#include "result/craig_bampton.hpp"

namespace dygita {

namespace {

class SuperelementSampler : public Sampler {
 public:
  SuperelementSampler(const Problem& problem, const Output& output)
      : Sampler({{"frequency", "damping"}, {"Hz", ""}, {}, {}}), problem_(problem), output_(output) {
    for (size_t i = 0; i < problem.steps.size(); ++i)
      if (output.after ? problem.steps[i] == output.after : problem.steps[i]->is_static) i_step_ = static_cast<int>(i);
  }

  // What is wrong with it does not stop a run that has other outputs: it is said, and nothing is written.
  void accept(const Instant& instant) override {
    if (instant.i_step != i_step_ || instant.increment + 1 != instant.model.step->n_increments()) return;
    try {
      element_ = condense(linearise(instant, output_.superelement.ties_sliding), problem_, output_);
      element_->step = instant.model.step->name;
      element_->is_converged = instant.converged;
    } catch (const InputError& error) {
      warn(error.what());
    } catch (const NumericalError& error) {
      warn(error.what());
    }
  }

  void summarise(RunResult& result) override {
    if (!element_) return;
    for (int i = 0; i < element_->frequencies.size(); ++i)
      add_values({element_->frequencies[i], element_->damping_ratios[i]});
    result.superelements[&output_] = std::move(*element_);
  }

 private:
  const Problem& problem_;
  const Output& output_;
  int i_step_ = -1;
  std::optional<Superelement> element_;
};

}  // namespace

std::unique_ptr<Sampler> make_superelement_sampler(const Problem& problem, const Output& output) {
  return std::make_unique<SuperelementSampler>(problem, output);
}

}  // namespace dygita
