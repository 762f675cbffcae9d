// The dynamic LATIN method, readable top to bottom (manual, chapter "Method").
//
// The only unknown that is iterated is q = F_hat + k W_hat on the interfaces. The linear stage answers with V, F = q -
// k V of each substructure; the local stage answers with F_hat, W_hat of each interface point; they agree when the step
// is solved.
#include "latin/latin.hpp"

#include <spdlog/fmt/fmt.h>

#include <chrono>
#include <cmath>

#include "base/log.hpp"
#include "base/progress.hpp"
#include "latin/anderson.hpp"
#include "latin/indicator.hpp"
#include "latin/local_stage.hpp"
#include "latin/search_direction.hpp"
#include "latin/step_run.hpp"

namespace dygita {

// Linear stage: velocities at the interfaces for data q, every substructure by itself.
void StepRun::linear_stage() {
  const Stopwatch watch(seconds_.interface);
  for_each_piece([&](Piece& piece, int i) {
    piece.interface_velocity(q_.segment(model_.offset[i], piece.n_rows()),
                             velocity_.segment(model_.offset[i], piece.n_rows()));
  });
}

// Balance of tied substructures against their rigid motions; velocities stay the answer to q.
void StepRun::coarse_correction() {
  if (coarse_.is_empty()) return;
  const Stopwatch watch(seconds_.interface);
  coarse_.correct(q_, velocity_);
}

// Local stage: the law at every interface point; image_ = F_hat + k W_hat.
IndicatorSums StepRun::local_stage() {
  const Stopwatch watch(seconds_.local);
  return sums_ = local_.run(velocity_, q_, image_);
}

// Right-hand sides of an increment, and all that it changes on the interfaces before any iteration.
void StepRun::begin_increment(int increment, bool starts_window) {
  const Stopwatch watch(seconds_.forward);
  motions_ = model_.motion_velocities(increment);
  model_.loads->evaluate(increment);
  const double quiet = indicator_.quiet(is_going_on_ ? round_off() : tolerance_);
  for_each_group([&](const std::vector<int>& members) {
    for (const int i : members) model_.pieces[i]->begin(model_.piece_force(i, state_), motions_, quiet);
    Piece::forward(group(members));
  });
  local_.begin(increment, motions_, starts_window);
}

// Interiors of an increment for the q at hand.
void StepRun::finish_increment() {
  const Stopwatch watch(seconds_.backward);
  for_each_group([&](const std::vector<int>& members) {
    Piece::backward(group(members));
    for (const int i : members) {
      Piece& piece = *model_.pieces[i];
      const Points held = piece.has_motions() ? local_.held_force(i) : Points();
      energy_[i] = piece.finish(q_.segment(model_.offset[i], piece.n_rows()), piece.has_motions() ? &held : nullptr);
    }
  });
}

// Both stages in turn, until the goal is reached; q_best: the data that came closest. Adds the iterations to n.
Outcome StepRun::iterate(int increment, const Goal& goal, Vec& q_best, int& n) {
  anderson_.begin();
  Outcome best;
  for (int i = 0;; ++i) {
    linear_stage();
    if (i > 0) coarse_correction();  // what is in balance to the tolerance is left as it is
    const Outcome outcome = indicator_.measure(local_stage());
    ++n;
    check_finite(outcome, increment);
    if (outcome.eta < best.eta) {
      best = outcome;
      q_best = q_;
    }
    if (outcome.eta <= goal.tolerance || i + 1 >= goal.most || is_lost()) return best;
    const Stopwatch watch(seconds_.accelerate);
    anderson_.advance(q_, image_);
  }
}

// One time step: forward once, iterate on the interfaces alone, backward once.
void StepRun::solve_increment(int increment) {
  begin_increment(increment, true);
  const bool has_start = warm_start_.predict(increment, q_) && start_from_;
  if (start_from_ && !has_start && increment == 0 && start_from_->n_increments(i_step_) > 0)
    warn(
        fmt::format("step '{}': nothing of the case to start from fits (other interfaces, another number of pieces or "
                    "of increments): the "
                    "iteration starts from scratch",
                    model_.step->name));
  if (local_.has_preloads()) keep_start();
  const Goal goal = goal_of(has_start);
  Vec q_best = q_;
  int n = 0;
  Outcome best = iterate(increment, goal, q_best, n);
  if (best.eta > tolerance_ && local_.has_preloads()) best = seat_bolts(increment, q_best, n);
  anderson_.end(q_, image_, best.eta <= goal.tolerance);
  if (best.eta <= goal.tolerance) {
    if (n > 1 && !coarse_.is_empty()) linear_stage();  // the pieces have not heard of the last correction
  } else {                                             // not there: the best there was is what is shown
    q_ = q_best;
    linear_stage();
    local_stage();
  }
  indicator_.accept(best);
  finish_increment();
  accept_increment(increment, n, best.eta);
}

// A window of several steps, as the paper has the whole interval: each iteration sweeps all of it.
void StepRun::solve_window(int first, int last) {
  const int n_steps = last - first;
  const Start start = remember();
  std::vector<Vec> q(n_steps, q_), image(n_steps);
  bool has_start = start_from_ != nullptr;
  for (int i = 0; i < n_steps && start_from_; ++i) has_start &= start_from_->read(i_step_, first + i, q_.size(), q[i]);
  const Goal goal = goal_of(has_start);
  Vec all(n_steps * q_.size()), all_image(all.size());
  Anderson anderson(window_depth_, 0, window_relaxation_, weight_.replicate(n_steps, 1));
  for (int n = 1;; ++n) {
    const Indicator before = indicator_;
    Outcome worst{0.0};
    for (int i = 0; i < n_steps; ++i) {
      begin_increment(first + i, i == 0);
      q_ = q[i];
      linear_stage();
      const Outcome outcome = indicator_.measure(local_stage());
      image[i] = image_;
      indicator_.accept(outcome);
      worst.eta = std::max(worst.eta, outcome.eta);
      check_finite(outcome, first + i);
      finish_increment();
      local_.accept(nullptr);
    }
    indicator_ = before;
    go_back(start);
    if (worst.eta <= goal.tolerance || n >= goal.most) {
      for (int i = 0; i < n_steps; ++i) replay(first + i, q[i], i == 0, n, worst.eta);
      return;
    }
    for (int i = 0; i < n_steps; ++i) {
      all.segment(i * q_.size(), q_.size()) = q[i];
      all_image.segment(i * q_.size(), q_.size()) = image[i];
    }
    anderson.advance(all, all_image);
    for (int i = 0; i < n_steps; ++i) q[i] = all.segment(i * q_.size(), q_.size());
  }
}

// The last sweep of a window once more, this time shown.
void StepRun::replay(int increment, const Vec& q, bool starts_window, int iterations, double eta) {
  begin_increment(increment, starts_window);
  q_ = q;
  linear_stage();
  indicator_.accept(indicator_.measure(local_stage()));
  finish_increment();
  accept_increment(increment, iterations, eta);
}

void StepRun::run() {
  const int n = model_.step->n_increments();
  Progress progress(model_.step->name, n);
  for (int i = 0; i < n && !interrupt_requested(); i += window_) {
    const int last = std::min(i + window_, n);
    if (window_ == 1)
      solve_increment(i);
    else
      solve_window(i, last);
    progress.update(last, describe_progress());
  }
}

SolverFigures solve(const Problem& problem, Observer& observer, const InterfaceFields* start_from) {
  using clock = std::chrono::steady_clock;
  const auto seconds_since = [](clock::time_point t) {
    return std::chrono::duration<double>(clock::now() - t).count();
  };
  SolverFigures figures;
  auto kept = std::make_shared<InterfaceFields>(problem.solver.history_memory);
  prepare_thread();
  auto start = clock::now();
  const std::vector<Surface> surfaces = make_surfaces(problem);
  const CutPtr cut = make_cut(problem);
  const std::vector<Body> bodies = make_bodies(problem, surfaces, *cut);
  figures.pieces = cut->counts();
  State state = initial_state(problem, surfaces);
  figures.seconds["assemble"] = seconds_since(start);
  for (const StepPtr& step : problem.steps) {
    if (interrupt_requested()) break;
    start = clock::now();
    StepModel model = make_step_model(problem, *step, surfaces, bodies, state, cut);
    if (interrupt_requested()) break;  // the factorisation may have taken long
    StepRun run(problem, model, state, observer, start_from, *kept);
    figures.seconds["factor"] += seconds_since(start);
    start = clock::now();
    run.run();
    run.leave_state();
    figures.steps.push_back(run.figures());
    figures.steps.back().seconds = seconds_since(start);
    run.add_to(figures);
  }
  figures.interface_fields = kept;
  figures.own.fields_in_memory = kept->memory_bytes() / 1e6;
  figures.own.fields_in_file = kept->file_bytes() / 1e6;
  figures.own.substitutions = static_cast<double>(figures.n_solved);
  figures.own.substitutions_spared = static_cast<double>(figures.n_spared);
  figures.own.pieces_in_full = figures.n_in_full;
  figures.own.shared_factors = figures.n_equal;
  figures.interrupted = interrupt_requested();
  return figures;
}

}  // namespace dygita
