// The whole assembly at once (manual, "The monolithic reference"), readable top to bottom.
#include "reference/monolithic.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "base/aside.hpp"
#include "base/clock.hpp"
#include "base/progress.hpp"
#include "reference/interface_newton.hpp"
#include "reference/merged_assembly.hpp"
#include "reference/preload_newton.hpp"
#include "step/finite_energies.hpp"
#include "step/loose_motions.hpp"
#include "step/step_ends.hpp"
#include "step/stopped_run.hpp"

namespace dygita {

namespace {

class MonolithicRun {
 public:
  // before: the factor of the step before, or null.
  MonolithicRun(const Problem& problem, const MonolithicSettings& settings, StepModel& model, State& state,
                Observer& observer, const std::shared_ptr<const AssemblyFactor>& before)
      : model_(model),
        state_(state),
        start_time_(state.time),
        observer_(observer),
        i_step_(index_of(problem.steps, model.step)),
        increment_{model.scheme},
        assembly_(model, before),
        rows_(model, assembly_),
        newton_(rows_, settings) {
    start_step(model, state);
    const std::vector<PortMotion> motions = port_motions(model, state);
    for (const Point& point : model.exchange.points) records_.push_back(start_point(model, point, state, motions));
    preload_ =
        std::make_unique<PreloadNewton>(rows_, records_, std::max(10 * settings.tolerance, 1e-12), settings.plain);
    if (model.scheme.is_static) loose_.emplace(model);
    energy_.resize(model.pieces.size());
    observer_.begin_step(instant(-1, {}));
  }

  void run();
  void add_to(SolverFigures& figures) const;
  const StepFigures& figures() const { return figures_; }
  const std::shared_ptr<const AssemblyFactor>& factor() const { return assembly_.factor(); }

 private:
  void solve_increment(int increment);
  void begin_increment(int increment);
  void finish_increment();
  void leave_loose_parts(InterfaceNewton::Outcome& outcome);
  void accept_increment(int increment, const InterfaceNewton::Outcome& outcome);
  Vec3 side_displacement(const Point& point, int first, int end, const std::vector<Points>& displacement) const;
  Vec3 jump(const Point& point, const std::vector<Points>& displacement) const;
  Instant instant(int increment, const InterfaceNewton::Outcome& outcome) const {
    return {model_,
            state_,
            i_step_,
            increment,
            outcome.iterations,
            outcome.residual,
            outcome.converged,
            model_.scheme.dt * outcome.distance};
  }

  StepModel& model_;
  State& state_;
  const double start_time_;  // s
  Observer& observer_;
  int i_step_;
  Increment increment_;
  MergedAssembly assembly_;
  InterfaceRows rows_;
  InterfaceNewton newton_;
  std::unique_ptr<PreloadNewton> preload_;
  std::vector<PointRecord> records_;
  std::optional<LooseMotions> loose_;  // of a static step
  std::vector<IncrementEnergy> energy_;
  std::vector<Vec3> port_force_;
  StepFigures figures_;
  double gap_difference_ = 0.0;
  struct {
    double forward = 0.0, newton = 0.0, backward = 0.0, accept = 0.0, output = 0.0;
  } seconds_;
};

// Mean of the tied copies on a side of a point, in its frame; a held copy decides.
Vec3 MonolithicRun::side_displacement(const Point& point, int first, int end,
                                      const std::vector<Points>& displacement) const {
  Vec3 place = Vec3::Zero();
  for (int d = 0; d < 3; ++d) {
    double sum = 0.0;
    for (int p = first; p < end; ++p) {
      const Port& port = model_.exchange.ports[p];
      const double u = point.frame.col(d).dot(port.motion(displacement[port.part]));
      if (port.is_held[d]) {
        sum = u * (end - first);
        break;
      }
      sum += u;
    }
    if (end > first) place[d] = sum / (end - first);
  }
  return place;
}

Vec3 MonolithicRun::jump(const Point& point, const std::vector<Points>& displacement) const {
  const Vec3 side_1 = side_displacement(point, point.first_port, point.first_port_2, displacement);
  if (point.is_wall) return -side_1;
  return side_displacement(point, point.first_port_2, point.end_port, displacement) - side_1;
}

// Right-hand side of the assembly, and all that an increment changes on the interfaces before any force is known.
void MonolithicRun::begin_increment(int increment) {
  const std::vector<double> motions = model_.motion_velocities(increment);
  model_.loads->evaluate(increment);
  std::vector<Points> displacement;
  for (size_t i = 0; i < model_.pieces.size(); ++i) {
    displacement.push_back(model_.pieces[i]->displacement());
    model_.pieces[i]->begin(model_.external_force(static_cast<int>(i), state_), motions, 0.0);
  }
  for (size_t i = 0; i < records_.size(); ++i) {
    const Point& point = model_.exchange.points[i];
    if (!point.law) continue;
    const Vec3 apart = jump(point, displacement);
    begin_point(model_, point, apart, increment, records_[i]);
    const double moved = side_displacement(point, point.first_port, point.first_port_2, displacement).norm();
    give_rates(model_, point, motions, apart.norm() + moved, records_[i]);
  }
  assembly_.begin(motions, displacement);
}

// Where loose parts are is known by springs across the law rows alone, which carry them along: they rest, as far as
// nothing is in their way there (manual, loose parts).
void MonolithicRun::leave_loose_parts(InterfaceNewton::Outcome& outcome) {
  assembly_.finish(newton_.reduced_force());
  std::vector<Points> moved;
  for (const auto& piece : model_.pieces) moved.push_back(piece->velocity());
  std::vector<int> point_of(model_.exchange.ports.size());
  for (size_t i = 0; i < model_.exchange.points.size(); ++i)
    for (int p = model_.exchange.points[i].first_port; p < model_.exchange.points[i].end_port; ++p)
      point_of[static_cast<size_t>(p)] = static_cast<int>(i);
  // What the tolerance leaves of forces holds nothing.
  const double least = std::pow(newton_.settings().tolerance, 2) * rows_.largest();
  const std::vector<Vec3> motions =
      loose_->find({[&](int i) {
                      const auto at = static_cast<size_t>(i);
                      return links(model_.exchange.points[at], records_[at], least);
                    },
                    [&](int p, int d) {
                      const Port& port = model_.exchange.ports[static_cast<size_t>(p)];
                      const Point& point =
                          model_.exchange.points[static_cast<size_t>(point_of[static_cast<size_t>(p)])];
                      return point.frame.col(d).dot(port.motion(moved[static_cast<size_t>(port.part)]));
                    },
                    [&](int i) {
                      const Point& point = model_.exchange.points[static_cast<size_t>(i)];
                      return gap_of(point, records_[static_cast<size_t>(i)], increment_);
                    }});
  if (motions.empty()) return;
  const Vec found = newton_.reduced_force();
  const std::vector<PointRecord> records = records_;
  for (size_t i = 0; i < records_.size(); ++i) {
    const Point& point = model_.exchange.points[i];
    if (!point.law) continue;
    Vec3 change = -motions[static_cast<size_t>(point.first_port)];
    if (!point.is_wall) change += motions[static_cast<size_t>(point.first_port_2)];
    for (int d = 0; d < 3; ++d)
      if (const int row = assembly_.row(i, d); row >= 0)
        newton_.reduced_force()[row] += assembly_.softening()[row] * change[d];  // the same force
  }
  const InterfaceNewton::Outcome at_rest = newton_.solve(records_, increment_);
  const int n_iterations = outcome.iterations + at_rest.iterations;
  if (at_rest.converged) {
    outcome = at_rest;
  } else {
    newton_.reduced_force() = found;
    records_ = records;
  }
  outcome.iterations = n_iterations;
}

// Velocities of the whole assembly, then every substructure's own update with the forces that act on it.
void MonolithicRun::finish_increment() {
  assembly_.finish(newton_.reduced_force());
  std::vector<Vec3> point_force;
  for (const PointRecord& record : records_) point_force.push_back(record.force);
  port_force_ = assembly_.port_forces(point_force);
  Vec q = Vec::Zero(model_.n_q());
  std::vector<Points> held;
  for (const SubstructurePtr& part : model_.problem->substructures)
    held.emplace_back(Points::Zero(3, part->mesh->n_nodes()));
  for (const Point& point : model_.exchange.points)
    for (int p = point.first_port; p < point.end_port; ++p) {
      const Port& port = model_.exchange.ports[p];
      if (port.trace) port.trace->spread(port.point, point.frame * port_force_[p], held[port.part]);
      for (int d = 0; d < 3; ++d) {
        if (const int i = model_.unknown(port, d); i >= 0) q[i] = port_force_[p][d];
        if (port.is_held[d] && !port.trace) held[port.part].col(port.node) += port_force_[p][d] * point.frame.col(d);
      }
    }
  for (size_t i = 0; i < model_.pieces.size(); ++i) {
    Piece& piece = *model_.pieces[i];
    energy_[i] = piece.finish(q.segment(model_.offset[i], piece.n_rows()), piece.has_motions() ? &held[i] : nullptr);
  }
}

void MonolithicRun::accept_increment(int increment, const InterfaceNewton::Outcome& outcome) {
  std::vector<Points> displacement;
  if (std::any_of(records_.begin(), records_.end(), [](const PointRecord& record) { return record.is_released; }))
    for (const auto& piece : model_.pieces) displacement.push_back(piece->displacement());
  for (size_t i = 0; i < records_.size(); ++i) {
    const Point& point = model_.exchange.points[i];
    if (!point.law) continue;
    PointRecord& record = records_[i];
    const LawState end = end_of_point(point, record, increment_);
    gap_difference_ = std::max(gap_difference_, gap_difference(point, record));
    // What has been released moves as its sides do, not as its law has it.
    const Vec3 force = working_force(record.law, end, increment_),
               motion = record.is_released ? Vec3(jump(point, displacement) - record.trial.jump)
                                           : motion_of(record.law, end, increment_);
    book_work(point, record, end, increment_, -force.dot(motion), state_);
    record.law = end;
    show_point(point, record, state_);
  }
  show_ties(model_, records_, port_force_, state_);
  Energies& energies = state_.energies;
  book_increment(energy_, energies);
  rows_.raise_floor(energies.held() + std::abs(energies.loads), model_.scheme.dt);
  if (!increment_.is_static) state_.time = start_time_ + (increment + 1) * increment_.dt;
  check_energies(model_, state_, energy_, increment);
  ++figures_.increments;
  figures_.iterations += outcome.iterations;
  figures_.worst_indicator = std::max(figures_.worst_indicator, outcome.residual);
  if (!outcome.converged) ++figures_.not_converged;
}

void MonolithicRun::solve_increment(int increment) {
  auto start = Clock::now();
  const auto lap = [&](double& sum) {
    sum += seconds_since(start);
    start = Clock::now();
  };
  begin_increment(increment);
  lap(seconds_.forward);
  InterfaceNewton::Outcome outcome = preload_->solve(newton_, records_, increment_, increment);
  if (interrupt_requested() && !outcome.converged) return;  // an increment that was left half solved does not count
  if (loose_ && outcome.converged) leave_loose_parts(outcome);
  lap(seconds_.newton);
  finish_increment();
  model_.mean.take_off(model_.pieces, model_.here);
  lap(seconds_.backward);
  accept_increment(increment, outcome);
  lap(seconds_.accept);
  observer_.accept(instant(increment, outcome));
  lap(seconds_.output);
}

void MonolithicRun::run() {
  const int n = model_.step->n_increments();
  Progress progress(model_.step->name, n);
  for (int i = 0; i < n && !interrupt_requested(); ++i) {
    solve_increment(i);
    progress.update(i + 1,
                    fmt::format("{:.1f} iterations per increment", static_cast<double>(figures_.iterations) / (i + 1)));
  }
}

void MonolithicRun::add_to(SolverFigures& figures) const {
  figures.n_dofs = 0;
  double bytes = assembly_.bytes();
  for (const SubstructurePtr& part : model_.problem->substructures) figures.n_dofs += 3 * part->mesh->n_nodes();
  for (const auto& piece : model_.pieces) bytes += piece->figures().bytes;
  figures.factor_bytes = std::max(figures.factor_bytes, bytes);
  figures.n_interface_unknowns = assembly_.n_rows();
  figures.gap_difference = std::max(figures.gap_difference, gap_difference_);
  figures.seconds["forward"] += seconds_.forward;
  figures.seconds["newton"] += seconds_.newton;
  figures.seconds["backward"] += seconds_.backward;
  figures.seconds["laws and energies"] += seconds_.accept;
  figures.seconds["output"] += seconds_.output;
}

}  // namespace

void MonolithicSteps::run(const Step& step, State& state, Observer& observer, SolverFigures& figures) {
  auto start = Clock::now();
  std::optional<MayBeAbandoned> until_it_runs(std::in_place);
  StepModel model = make_assembled_model(problem_, step, surfaces_, bodies_, state);
  MonolithicRun run(problem_, settings_, model, state, observer, factor_);
  factor_ = run.factor();
  until_it_runs.reset();
  figures.seconds["factor"] += seconds_since(start);
  start = Clock::now();
  figures.stopped_by = run_as_far_as_it_goes(run, figures);
  if (!figures.stopped_by) end_step(model, state);
  figures.steps.push_back(run.figures());
  figures.steps.back().seconds = seconds_since(start);
  figures.free.push_back(model.what_is_free());
  run.add_to(figures);
}

SolverFigures solve_monolithic(const Problem& problem, Observer& observer) {
  CHECK(problem.monolithic, "the problem asks for another solver");
  SolverFigures figures;
  prepare_thread();
  auto start = Clock::now();
  const std::vector<Surface> surfaces = make_surfaces(problem);
  const std::vector<Body> bodies = make_bodies(problem, surfaces);
  State state = initial_state(problem, surfaces);
  figures.seconds["assemble"] = seconds_since(start);
  MonolithicSteps steps(problem, *problem.monolithic, surfaces, bodies);
  for (const StepPtr& step : problem.steps) {
    if (interrupt_requested() || figures.stopped_by) break;
    try {
      steps.run(*step, state, observer, figures);
    } catch (const Abandoned&) {  // before the step has begun
    }
  }
  figures.interrupted = figures.stopped_by || interrupt_requested();
  return figures;
}

}  // namespace dygita
