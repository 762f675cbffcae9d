// Windows of several time steps, as the paper has the whole interval: each iteration sweeps all of a window.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "latin/step_run.hpp"

namespace dygita {

StepRun::Start StepRun::remember() const {
  Start start{{}, local_};
  for (const int i : model_.here) start.pieces.push_back(model_.pieces[i]->state());
  return start;
}

void StepRun::go_back(const Start& start) {
  for (size_t i = 0; i < start.pieces.size(); ++i) model_.pieces[model_.here[i]]->restore(start.pieces[i]);
  local_ = start.local;
}

// Both stages of every time step, each from the end of the one before: from data q their images, and the worst outcome.
// Nothing is kept but those.
Outcome StepRun::sweep(int first, std::vector<Vec>& q, std::vector<Vec>& image) {
  const Indicator before = indicator_;
  Outcome worst{0.0};
  for (size_t i = 0; i < q.size(); ++i) {
    const int increment = first + static_cast<int>(i);
    begin_increment(increment, i == 0);
    linear_stage(q[i], at_.velocity, true);
    const Outcome outcome = indicator_.measure(local_stage(at_.velocity, q[i], image[i], true));
    indicator_.accept(outcome);
    worst.eta = std::max(worst.eta, outcome.eta);
    worst.size = std::max(worst.size, outcome.size);
    check_finite(outcome, increment);
    finish_increment(q[i]);
    local_.accept();
  }
  indicator_ = before;
  return worst;
}

// The same with one message to each neighbour and one sum over all for the window: what the pieces go through from one
// time step to the next needs nothing of the laws, which follow once the answers of all time steps are there.
Outcome StepRun::sweep_at_once(int first, std::vector<Vec>& q, std::vector<Vec>& image) {
  const Indicator before = indicator_;
  std::vector<Vec> velocity(q.size(), at_.velocity);
  std::vector<std::vector<double>> motions;
  std::vector<double*> passed;
  for (size_t i = 0; i < q.size(); ++i) {
    motions.push_back(begin_pieces(first + static_cast<int>(i)));
    if (i == 0) local_.begin(first, motions[i], true);
    linear_stage(q[i], velocity[i]);
    finish_increment(q[i]);
    passed.insert(passed.end(), {q[i].data(), velocity[i].data()});
  }
  model_.near.exchange(passed);
  std::vector<InterfaceSums::ToCome> distances;
  for (size_t i = 0; i < q.size(); ++i) {
    if (i > 0) local_.begin(first + static_cast<int>(i), motions[i], false);
    local_.run_inner(velocity[i], q[i], image[i]);
    local_.run_outer(velocity[i], q[i], image[i]);
    local_.accept();
    distances.push_back(local_.distance_sums(velocity[i], q[i], image[i]));
  }
  const int n_each = distances.front().n;
  const std::vector<double> sums =
      window_sums_.add(n_each * static_cast<int>(q.size()), [&](Eigen::Index at, Eigen::Index n, double* to) {
        for (const InterfaceSums::ToCome& distance : distances) distance.share(at, n, to), to += n_each;
      });
  Outcome worst{0.0};
  for (size_t i = 0; i < q.size(); ++i) {
    const Outcome outcome = indicator_.measure(LocalStage::distance_of(sums.data() + n_each * i));
    indicator_.accept(outcome);
    worst.eta = std::max(worst.eta, outcome.eta);
    worst.size = std::max(worst.size, outcome.size);
    check_finite(outcome, first + static_cast<int>(i));
  }
  indicator_ = before;
  return worst;
}

// Forces on held sides that move are the laws' answer, which their pieces wait for.
bool StepRun::sweeps_at_once() const {
  return !model_.problem->solver.plain && !assembled_ &&
         std::none_of(model_.pieces.begin(), model_.pieces.end(),
                      [](const auto& piece) { return piece->has_motions(); });
}

// A window longer than waves take to cross a substructure and back may send its fields away, further in each iteration.
// Where that ends nothing is an answer. grown: the fields, of the largest of the first iterations; ends: no more
// iterations.
void StepRun::check_window(std::pair<int, int> steps, int n, const Outcome& worst, double grown, bool ends) const {
  constexpr double most_grown = 1e6, least_answer = 1e-2;  // of the indicator
  const bool is_lost = grown > most_grown;
  if (!is_lost && !(ends && worst.eta > least_answer)) return;
  throw NumericalError(fmt::format(
      "step '{}', time steps {} to {}, which 'window' iterates together: {}\n    omit 'window' to solve each time step "
      "separately, or use a shorter one{}",
      model_.step->name, steps.first + 1, steps.second,
      is_lost
          ? fmt::format("the iteration has diverged: after {} iterations motions and forces are {:.0e} times those "
                        "of the first",
                        n, grown)
          : fmt::format("the iteration has not approached a solution: the indicator is {:.2g} after {}", worst.eta, n),
      is_lost ? "" : ", or more 'max_iterations'"));
}

void StepRun::solve_window(int first, int last) {
  const int n_steps = last - first;
  if (leads(n_steps)) return replay_window(first, last);
  const Eigen::Index n_own = model_.near.n_own();
  const OwnFields fields{files_.start_from, static_cast<size_t>(settings_.i_step), &model_.near};
  const Start start = remember();
  std::vector<Vec> q(n_steps, at_.q), image(n_steps);
  bool has_start = files_.start_from != nullptr;
  Vec kept;
  for (int i = 0; i < n_steps && files_.start_from; ++i) {
    const bool is_kept = fields.read(static_cast<size_t>(first + i), n_own, kept);
    if (is_kept) own(q[i]) = kept;
    has_start &= is_kept;
  }
  const Goal goal = goal_of(has_start);
  Vec all(n_steps * n_own), all_image(all.size());
  const StepSettings::Acceleration& asked = settings_.of_window;
  Anderson anderson(asked.depth, asked.n_problems, asked.relaxation, weight_.replicate(n_steps, 1),
                    InterfaceSums(model_, n_steps));
  Persistence persistence(goal.limit);
  const bool at_once = sweeps_at_once();
  double usual = indicator_.largest();  // W, of fields before the iteration may have sent them anywhere
  for (int n = 1;; ++n) {
    const Outcome worst = at_once ? sweep_at_once(first, q, image) : sweep(first, q, image);
    go_back(start);
    constexpr int early = 3;
    if (n <= early) usual = std::max(usual, worst.size);
    const bool is_solved = worst.eta <= goal.tolerance, ends = !is_solved && persistence.ends(n, worst.eta);
    if (n_steps > 1) check_window({first, last}, n, worst, std::sqrt(worst.size / usual), ends);
    if (is_solved || ends) {
      std::optional<Missed> missed;
      if (worst.eta > settings_.tolerance) missed = persistence.missed(first, settings_.tolerance);
      if (missed) note_missed(*missed);
      if (files_.trail) leave_window(q, n, worst.eta, missed);
      for (int i = 0; i < n_steps; ++i) replay(first + i, q[i], i == 0, n, worst.eta);
      return;
    }
    for (int i = 0; i < n_steps; ++i) {
      all.segment(i * n_own, n_own) = own(q[i]);
      all_image.segment(i * n_own, n_own) = own(image[i]);
    }
    anderson.advance(all, all_image);
    for (int i = 0; i < n_steps; ++i) own(q[i]) = all.segment(i * n_own, n_own);
  }
}

// A time step of the last sweep once more, this time shown.
void StepRun::replay(int increment, const Vec& q, bool starts_window, int iterations, double eta) {
  begin_increment(increment, starts_window);
  at_.q = q;
  linear_stage(at_.q, at_.velocity, true);
  at_.sums = local_stage(at_.velocity, at_.q, at_.image, true);
  indicator_.accept(indicator_.measure(at_.sums));
  finish_increment(at_.q);
  accept_increment(increment, iterations, eta);
}

}  // namespace dygita
