#include "latin/iteration.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "base/log.hpp"

namespace dygita {

Iteration::Iteration(StepData& step, const Vec& k)
    : step_(step), stages_(step, k), told_(step), constant_(step, stages_), usual_(&constant_) {
  if (step.files.start_from)
    warm_start_.emplace(OwnFields{step.files.start_from, static_cast<size_t>(step.settings.i_step), &step.model.near},
                        step.weight, InterfaceSums(step.model));
  const auto add = [&](std::unique_ptr<Strategy> strategy) {
    if (strategy) strategies_.push_back(std::move(strategy));
  };
  add(balance_ties(*this, k));
  add(iterate_roughly(*this));
  add(iterate_in_full(*this));
  add(iterate_in_one_system(*this));
  add(seat_bolts(*this));
  add(iterate_part_by_part(*this));
  std::unique_ptr<LooseParts> loose = LooseParts::of(*this);
  loose_ = loose.get();
  add(std::move(loose));
  if (TangentIteration* const system = stages_.system()) {
    told_.watch(*system);
    usual_ = &tangents_.emplace(step, stages_, *system, loose_);
  }
}

bool Iteration::predict(int increment) {
  if (!warm_start_) return false;
  const bool has_start = warm_start_->predict(increment, step_.own(step_.at.q));
  if (!has_start && increment == 0 && step_.files.start_from->n_increments(step_.settings.i_step) > 0)
    warn(
        fmt::format("step '{}': the initial case does not match (different interfaces, pieces or increments): the "
                    "iteration starts from scratch",
                    step_.model.step->name));
  return has_start;
}

bool Iteration::corrects(int n) const {
  return n > 0 &&
         std::any_of(strategies_.begin(), strategies_.end(), [](const auto& strategy) { return strategy->corrects(); });
}

void Iteration::correct() {
  for (const auto& strategy : strategies_) strategy->correct();
}

void Iteration::after_local_stage() {
  for (const auto& strategy : strategies_) strategy->after_local_stage();
}

void Iteration::note(const Outcome& outcome, Best& best) {
  ++best.iterations;
  if (!(outcome.eta < best.outcome.eta)) return;
  best.outcome = outcome;
  best.q = step_.at.q;
}

// Reached, lost, or not to be reached any more.
bool Iteration::is_over(int n, const Goal& goal, Persistence& persistence, const Best& best,
                        const Outcome& outcome) const {
  const bool is_lost = goal.furthest > 0.0 && step_.model.n_q() > 0 && !(step_.largest_velocity() <= goal.furthest);
  return outcome.eta <= goal.tolerance || is_lost || persistence.ends(n + 1, best.outcome.eta);
}

}  // namespace dygita
