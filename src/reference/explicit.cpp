#include "reference/explicit.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "base/clock.hpp"
#include "base/log.hpp"
#include "base/progress.hpp"
#include "reference/explicit_run.hpp"
#include "reference/monolithic.hpp"
#include "step/step_ends.hpp"
#include "step/stopped_run.hpp"

namespace dygita {

namespace {

// Energies go on where one explicit step follows another: the pieces know the full stiffness only.
void go_on(const Energies& before, bool is_first_dynamic, Energies& energies) {
  energies.strain = before.strain;
  if (is_first_dynamic) return;
  energies.scheme = before.scheme + before.kinetic - energies.kinetic;
}

class Runner {
 public:
  Runner(const Problem& problem, Observer& observer) : problem_(problem), observer_(observer) {
    const auto start = Clock::now();
    surfaces_ = make_surfaces(problem);
    bodies_ = make_bodies(problem, surfaces_);
    state_ = initial_state(problem, surfaces_);
    figures_.seconds["assemble"] = seconds_since(start);
  }

  SolverFigures run() {
    MonolithicSteps steps(problem_, {}, surfaces_, bodies_);
    for (const StepPtr& step : problem_.steps) {
      if (interrupt_requested() || figures_.stopped_by) break;
      if (step->is_static) {
        steps.run(*step, state_, observer_, figures_);
        memory_ = {};
      } else {
        run_step(*step);
      }
    }
    figures_.interrupted = figures_.stopped_by || interrupt_requested();
    return std::move(figures_);
  }

 private:
  void run_step(const Step& step);
  void note(const Step& step, const ExplicitRun& run);

  const Problem& problem_;
  Observer& observer_;
  std::vector<Surface> surfaces_;
  std::vector<Body> bodies_;
  State state_;
  SolverFigures figures_;
  ExplicitMemory memory_;
  std::unique_ptr<InternalForce> internal_;
};

void Runner::run_step(const Step& step) {
  auto start = Clock::now();
  if (!internal_) internal_ = std::make_unique<InternalForce>(bodies_, *problem_.explicit_dynamics);
  StepModel model = make_assembled_model(problem_, step, surfaces_, bodies_, state_);
  const Energies before = state_.energies;
  const bool is_first_dynamic = !state_.has_moved;
  start_step(model, state_);
  if (memory_.internal.size() > 0) go_on(before, is_first_dynamic, state_.energies);
  ExplicitRun run(model, bodies_, *internal_, memory_, state_, observer_);
  note(step, run);
  figures_.seconds["set up"] += seconds_since(start);
  start = Clock::now();
  figures_.stopped_by = run_as_far_as_it_goes(run, figures_);
  if (!figures_.stopped_by) {
    run.finish(memory_);
    end_step(model, state_);
  }
  figures_.steps.push_back(run.figures());
  figures_.steps.back().seconds = seconds_since(start);
  figures_.free.push_back(model.what_is_free());
  figures_.seconds["substeps and output"] += seconds_since(start);
  std::optional<double>& hourglass = figures_.own.hourglass_energy;
  hourglass = std::max(hourglass.value_or(0.0), 100.0 * run.hourglass_share());
}

void Runner::note(const Step& step, const ExplicitRun& run) {
  say(fmt::format("  step '{}': {} explicit substeps of {:.4g} us in each dt, critical {:.4g} us", step.name,
                  run.n_substeps(), 1e6 * step.dt / run.n_substeps(), 1e6 * run.critical()));
  OwnFigures& own = figures_.own;
  own.substeps = std::max(own.substeps.value_or(0.0), static_cast<double>(run.n_substeps()));
  own.critical_step = std::min(own.critical_step.value_or(run.critical()), run.critical());
  figures_.n_dofs = internal_->n_dofs();
  figures_.factor_bytes = std::max(figures_.factor_bytes, run.bytes());
}

// Answers nobody.
struct Blind : Observer {
  void begin_step(const Instant&) override {}
  void accept(const Instant&) override {}
};

}  // namespace

SolverFigures solve_explicit(const Problem& problem, Observer& observer) {
  CHECK(problem.explicit_dynamics, "the problem asks for another solver");
  prepare_thread();
  return Runner(problem, observer).run();
}

ExplicitSize predict_explicit(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces,
                              const std::vector<Body>& bodies, const State& start) {
  InternalForce internal(bodies, *problem.explicit_dynamics);
  StepModel model = make_assembled_model(problem, step, surfaces, bodies, start);
  State state = start;
  start_step(model, state);
  Blind blind;
  const ExplicitRun run(model, bodies, internal, {}, state, blind);
  return {run.n_substeps(), run.critical(), run.bytes()};
}

}  // namespace dygita
