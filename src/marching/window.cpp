// Windows of several time steps, as the paper has the whole interval: each iteration sweeps all of a window.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "marching/increments.hpp"

namespace dygita {

namespace {

class Windows final : public Increments {
 public:
  Windows(Iteration& iteration, StepBooks& books)
      : step_(iteration.step()), stages_(iteration.stages()), books_(books), follow_(iteration), sums_(step_.model) {}
  void solve(int first, int last) override;

 private:
  struct Start {
    std::vector<PieceState> pieces;
    LocalStage local;
  };
  void check_window(std::pair<int, int> steps, int n, const Outcome& worst, double grown, bool ends) const;
  Outcome sweep(int first, std::vector<Vec>& q, std::vector<Vec>& image);
  Outcome sweep_at_once(int first, std::vector<Vec>& q, std::vector<Vec>& image);
  bool sweeps_at_once() const;
  void replay(int increment, const Vec& q, bool starts_window, int iterations, double eta);
  void replay_all(int first, int last);
  Start remember() const;
  void go_back(const Start& start);

  StepData& step_;
  Stages& stages_;
  StepBooks& books_;
  Follow follow_;
  InterfaceSums sums_;
};

Windows::Start Windows::remember() const {
  Start start{{}, step_.local};
  for (const int i : step_.model.here) start.pieces.push_back(step_.model.pieces[i]->state());
  return start;
}

void Windows::go_back(const Start& start) {
  for (size_t i = 0; i < start.pieces.size(); ++i) step_.model.pieces[step_.model.here[i]]->restore(start.pieces[i]);
  step_.local = start.local;
}

// Both stages of every time step, each from the end of the one before: from data q their images, and the worst outcome.
// Nothing is kept but those.
Outcome Windows::sweep(int first, std::vector<Vec>& q, std::vector<Vec>& image) {
  const Indicator before = step_.indicator;
  Outcome worst{0.0};
  for (size_t i = 0; i < q.size(); ++i) {
    const int increment = first + static_cast<int>(i);
    stages_.begin_increment(increment, i == 0);
    stages_.linear_stage(q[i], step_.at.velocity, true);
    const Outcome outcome = step_.indicator.measure(stages_.local_stage(step_.at.velocity, q[i], image[i], true));
    step_.indicator.accept(outcome);
    worst.eta = std::max(worst.eta, outcome.eta);
    worst.size = std::max(worst.size, outcome.size);
    step_.check_finite(outcome, increment);
    stages_.finish_increment(q[i]);
    step_.local.accept();
  }
  step_.indicator = before;
  return worst;
}

// The same with one message to each neighbour and one sum over all for the window: what the pieces go through from one
// time step to the next needs nothing of the laws, which follow once the answers of all time steps are there.
Outcome Windows::sweep_at_once(int first, std::vector<Vec>& q, std::vector<Vec>& image) {
  const Indicator before = step_.indicator;
  std::vector<Vec> velocity(q.size(), step_.at.velocity);
  std::vector<std::vector<double>> motions;
  std::vector<double*> passed;
  for (size_t i = 0; i < q.size(); ++i) {
    motions.push_back(stages_.begin_pieces(first + static_cast<int>(i)));
    if (i == 0) step_.local.begin(first, motions[i], true);
    stages_.linear_stage(q[i], velocity[i]);
    stages_.finish_increment(q[i]);
    passed.insert(passed.end(), {q[i].data(), velocity[i].data()});
  }
  step_.model.near.exchange(passed);
  std::vector<InterfaceSums::ToCome> distances;
  for (size_t i = 0; i < q.size(); ++i) {
    if (i > 0) step_.local.begin(first + static_cast<int>(i), motions[i], false);
    step_.local.run_inner(velocity[i], q[i], image[i]);
    step_.local.run_outer(velocity[i], q[i], image[i]);
    step_.local.accept();
    distances.push_back(step_.local.distance_sums(velocity[i], q[i], image[i]));
  }
  const int n_each = distances.front().n;
  const std::vector<double> sums =
      sums_.add(n_each * static_cast<int>(q.size()), [&](Eigen::Index at, Eigen::Index n, double* to) {
        for (const InterfaceSums::ToCome& distance : distances) distance.share(at, n, to), to += n_each;
      });
  Outcome worst{0.0};
  for (size_t i = 0; i < q.size(); ++i) {
    const Outcome outcome = step_.indicator.measure(LocalStage::distance_of(sums.data() + n_each * i));
    step_.indicator.accept(outcome);
    worst.eta = std::max(worst.eta, outcome.eta);
    worst.size = std::max(worst.size, outcome.size);
    step_.check_finite(outcome, first + static_cast<int>(i));
  }
  step_.indicator = before;
  return worst;
}

// Forces on held sides that move are the laws' answer, which their pieces wait for.
bool Windows::sweeps_at_once() const {
  return !step_.model.problem->solver.plain && std::none_of(step_.model.pieces.begin(), step_.model.pieces.end(),
                                                            [](const auto& piece) { return piece->has_motions(); });
}

// A window longer than waves take to cross a substructure and back may send its fields away, further in each iteration.
// Where that ends nothing is an answer. grown: the fields, of the largest of the first iterations; ends: no more
// iterations.
void Windows::check_window(std::pair<int, int> steps, int n, const Outcome& worst, double grown, bool ends) const {
  constexpr double most_grown = 1e6, least_answer = 1e-2;  // of the indicator
  const bool is_lost = grown > most_grown;
  if (!is_lost && !(ends && worst.eta > least_answer)) return;
  throw NumericalError(fmt::format(
      "step '{}', time steps {} to {}, which 'window' iterates together: {}\n    omit 'window' to solve each time step "
      "separately, or use a shorter one{}",
      step_.model.step->name, steps.first + 1, steps.second,
      is_lost
          ? fmt::format("the iteration has diverged: after {} iterations motions and forces are {:.0e} times those "
                        "of the first",
                        n, grown)
          : fmt::format("the iteration has not approached a solution: the indicator is {:.2g} after {}", worst.eta, n),
      is_lost ? "" : ", or more 'max_iterations'"));
}

void Windows::solve(int first, int last) {
  const int n_steps = last - first;
  if (follow_.leads(n_steps)) return replay_all(first, last);
  const Eigen::Index n_own = step_.model.near.n_own();
  const OwnFields fields{step_.files.start_from, static_cast<size_t>(step_.settings.i_step), &step_.model.near};
  const Start start = remember();
  std::vector<Vec> q(n_steps, step_.at.q), image(n_steps);
  bool has_start = step_.files.start_from != nullptr;
  Vec kept;
  for (int i = 0; i < n_steps && step_.files.start_from; ++i) {
    const bool is_kept = fields.read(static_cast<size_t>(first + i), n_own, kept);
    if (is_kept) step_.own(q[i]) = kept;
    has_start &= is_kept;
  }
  const Goal goal = step_.goal(has_start);
  Vec all(n_steps * n_own), all_image(all.size());
  const StepSettings::Acceleration& asked = step_.settings.of_window;
  Anderson anderson(asked.depth, asked.n_problems, asked.relaxation, step_.weight.replicate(n_steps, 1),
                    InterfaceSums(step_.model, n_steps));
  Persistence persistence(goal.limit);
  const bool at_once = sweeps_at_once();
  double usual = step_.indicator.largest();  // W, of fields before the iteration may have sent them anywhere
  for (int n = 1;; ++n) {
    const Outcome worst = at_once ? sweep_at_once(first, q, image) : sweep(first, q, image);
    go_back(start);
    constexpr int early = 3;
    if (n <= early) usual = std::max(usual, worst.size);
    const bool is_solved = worst.eta <= goal.tolerance, ends = !is_solved && persistence.ends(n, worst.eta);
    if (n_steps > 1) check_window({first, last}, n, worst, std::sqrt(worst.size / usual), ends);
    if (is_solved || ends) {
      std::optional<Missed> missed;
      if (worst.eta > step_.settings.tolerance) missed = persistence.missed(first, step_.settings.tolerance);
      if (missed) books_.note_missed(*missed);
      if (follow_.leaves()) follow_.leave_window(q, n, worst.eta, missed);
      for (int i = 0; i < n_steps; ++i) replay(first + i, q[i], i == 0, n, worst.eta);
      return;
    }
    for (int i = 0; i < n_steps; ++i) {
      all.segment(i * n_own, n_own) = step_.own(q[i]);
      all_image.segment(i * n_own, n_own) = step_.own(image[i]);
    }
    anderson.advance(all, all_image);
    for (int i = 0; i < n_steps; ++i) step_.own(q[i]) = all.segment(i * n_own, n_own);
  }
}

// A time step of the last sweep once more, this time shown.
void Windows::replay(int increment, const Vec& q, bool starts_window, int iterations, double eta) {
  stages_.begin_increment(increment, starts_window);
  step_.at.q = q;
  stages_.answer();
  step_.indicator.accept(step_.indicator.measure(step_.at.sums));
  stages_.finish_increment(step_.at.q);
  books_.accept_increment(increment, iterations, eta);
}

void Windows::replay_all(int first, int last) {
  for (int i = first; i < last; ++i) {
    const TrailEntry entry = follow_.take_entry();
    if (entry.missed) books_.note_missed(*entry.missed);
    replay(i, entry.q, i == first, entry.iterations, entry.eta);
  }
}

}  // namespace

std::unique_ptr<Increments> windows(Iteration& iteration, StepBooks& books) {
  return std::make_unique<Windows>(iteration, books);
}

}  // namespace dygita
