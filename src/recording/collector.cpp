#include "recording/collector.hpp"

#include <algorithm>
#include <cmath>

#include "base/task.hpp"
#include "law/law.hpp"
#include "recording/recorder.hpp"
#include "result/limits.hpp"
#include "watch/overloaded_joints.hpp"

namespace dygita {

Collector::~Collector() = default;

Collector::Collector(const Problem& problem, PartWatch& parts, const FrameSink& sink)
    : problem_(problem), parts_(parts), bolts_(problem) {
  for (const OutputPtr& output : problem.outputs)
    if (auto recorder = output->recorder(problem, sink)) recorders_.emplace_back(output.get(), std::move(recorder));
  convergence_.names = {"time", "iterations", "indicator", "converged"};
  convergence_.units = {"s", "", "", ""};
  convergence_.columns.resize(4);
}

void Collector::begin_step(const Instant& start) {
  for (auto& [output, recorder] : recorders_) recorder->begin_step(start);
  bolts_.begin_step(start);
  before_springs_ = start.state.energies.scheme;
}

void Collector::accept(const Instant& instant) {
  bolts_.accept(instant);
  for (auto& [output, recorder] : recorders_) recorder->accept(instant);
  const double row[] = {instant.time(), static_cast<double>(instant.iterations), instant.indicator,
                        instant.converged ? 1.0 : 0.0};
  convergence_.whole_or_none([&] {
    for (int i = 0; i < 4; ++i) convergence_.columns[i].push_back(row[i]);
    convergence_.step.push_back(instant.i_step);
  });
  missed_ += !instant.converged;
  if (!instant.is_static()) missed_in_motion_ = missed_;
  if (instant.is_static() && !instant.converged && !is_overloaded(instant.i_step)) note_overload(instant);
  watch(instant);
}

bool Collector::is_overloaded(int i_step) const {
  return std::find(overloaded_.begin(), overloaded_.end(), i_step) != overloaded_.end();
}

// The first increment of a step that says it is enough: the same load grows in those that follow.
void Collector::note_overload(const Instant& instant) {
  const std::vector<std::string> lines = overloaded_joints(instant);
  if (!lines.empty()) overloaded_.push_back(instant.i_step);
  warnings_.insert(warnings_.end(), lines.begin(), lines.end());
}

// What the rest is held against, J. Of static steps all that is stored, and dissipated in them, which is what was given
// as far as the balance closes. Of a motion what is in it: where it starts from a strained state, its own strain energy
// is that of the displacements since, at the instants where that is known; the change of the whole would be mostly the
// work of forces that were there before.
double Collector::energy_of(const Instant& instant) const {
  const Energies& e = instant.state.energies;
  const double dissipated = e.friction + e.plastic + e.damping + e.scheme -
                            (before_.friction + before_.plastic + before_.damping + before_.scheme);
  if (!instant.is_static() && before_.strain > 0.0)
    return e.kinetic + std::max(0.0, dissipated) + parts_.errors().strain_of_motion().value_or(0.0);
  return std::max(e.held() + dissipated, std::abs(e.start + e.loads - before_.start - before_.loads));
}

void Collector::watch(const Instant& instant) {
  const Energies& e = instant.state.energies;
  if (kind_ != instant.is_static()) {
    if (kind_) books(*kind_).end(parts_.errors().energy_at_rest());
    kind_ = instant.is_static();
    before_ = last_;
  }
  last_ = e;
  // The top of the report's chart: all that is stored and dissipated.
  const double accounted = e.held() + e.friction + e.plastic + e.damping + e.scheme;
  largest_energy_ = std::max({largest_energy_, accounted, std::abs(e.start + e.loads)});
  EnergyBooks& now = books(instant.is_static());
  // A motion of next to nothing beside what is stored is what the tolerance has left.
  constexpr double left_by_tolerance = 1e-7;
  now.energy = std::max({now.energy, energy_of(instant), left_by_tolerance * before_.strain});
  now.imbalance = std::max(now.imbalance, std::abs(e.balance() - before_.balance()));
  now.loss = std::max(now.loss, e.scheme - before_.scheme);
  constexpr double much = 1e-3;
  joints_give_ = joints_give_ || (!instant.is_static() &&
                                  e.friction + e.plastic - before_.friction - before_.plastic > much * now.energy);
  now.gain = std::max(now.gain, before_.scheme - e.scheme);
  if (instant.fields) now.springs = std::max(now.springs, e.scheme - before_springs_);
}

void EnergyBooks::end(double at_rest) {
  // Where nothing is stored but the balance is open (an iteration that has run away), it is open altogether.
  const double percent = energy > at_rest ? 100.0 / energy : imbalance > at_rest ? 100.0 / imbalance : 0.0;
  worst_imbalance = std::max(worst_imbalance, percent * imbalance);
  most_lost = std::max(most_lost, percent * loss);
  most_gained = std::max(most_gained, percent * gain);
  most_in_springs = std::max(most_in_springs, percent * springs);
  largest = std::max(largest, energy);
  energy = imbalance = loss = gain = springs = 0.0;
}

void Collector::finish_books(RunResult& result) {
  if (kind_) books(*kind_).end(parts_.errors().energy_at_rest());
  const auto has = [&](bool is_static) {
    return std::any_of(problem_.steps.begin(), problem_.steps.end(),
                       [&](const StepPtr& s) { return s->is_static == is_static; });
  };
  Figures& figures = result.figures;
  const EnergyBooks& told = books(!has(false));
  figures.largest_energy = largest_energy_;
  figures.energy_imbalance = told.worst_imbalance;
  figures.numerical_dissipation = told.most_lost;
  figures.energy_gain = told.most_gained;
  // What the springs of a penalty hold is what the sides overlap: its interfaces' constitutive-relation error.
  if (problem_.explicit_dynamics) figures.penalty_error = limit::penalty_error_of(of_motion_.most_in_springs);
  if (!has(false)) return;
  figures.energy_of_motion = of_motion_.largest;
  if (!has(true)) return;
  figures.static_imbalance = of_statics_.worst_imbalance;
  figures.static_dissipation = of_statics_.most_lost;
  figures.static_gain = of_statics_.most_gained;
}

namespace {

void add_error_figures(const ErrorEstimator& errors, const Problem& problem, RunResult& result) {
  const auto has = [&](bool is_static) {
    return std::any_of(problem.steps.begin(), problem.steps.end(),
                       [&](const StepPtr& s) { return s->is_static == is_static; });
  };
  if (has(true)) {
    const ErrorEstimator::Estimate e = errors.static_steps();
    result.figures.static_iteration_error = 100 * e.iteration;
    result.figures.static_mesh_error = 100 * e.mesh;
    result.figures.static_interface_error = e.interface_energy;
  }
  if (has(false)) {
    const ErrorEstimator::Estimate e = errors.dynamic_steps();
    if (result.interrupted && e.mesh == 0.0) return;  // stopped before anything was sampled
    if (!problem.explicit_dynamics) result.figures.iteration_error = 100 * e.iteration;
    result.figures.time_step_error = 100 * e.time_step;
    result.figures.mesh_error = 100 * e.mesh;
    if (!problem.explicit_dynamics) result.figures.interface_error = e.interface_energy;
    result.figures.mean_frequency = e.mean_frequency;
    result.figures.step_frequency_error = 100 * e.step_frequency;
    result.figures.mesh_frequency_error = 100 * e.mesh_frequency;
    result.figures.mesh_amplitude_error = 100 * e.mesh_amplitude;
  }
}

}  // namespace

// Those that are made of others' tables come after them.
void Collector::finish_outputs(RunResult& result) {
  Task task("outputs", static_cast<int>(recorders_.size() + problem_.outputs.size()), Task::Interrupts::wait);
  for (auto& [output, recorder] : recorders_) {
    task.tell(output->known_as());
    Table table;
    recorder->finish(table, result.findings[output]);
    if (!output->columns().empty()) result.tables[output] = std::move(table);
    task.done(output->known_as());
  }
  RunEnd end{problem_, result, parts_.errors().dynamic_steps(), parts_.errors().static_steps()};
  end.errors.imbalance = of_motion_.imbalance_so_far(parts_.errors().energy_at_rest());
  end.errors.joints_change = joints_give_ || contacts_change(problem_, result.contacts);
  for (const OutputPtr& output : problem_.outputs) {
    task.done(output->known_as());
    if (output->columns().empty()) continue;
    Table& table = result.tables[output.get()];
    Findings& findings = result.findings[output.get()];
    output->conclude(end, table, findings);
    // Spectra and what is made of them rest on the motion and all before it, the rest of a table on its rows.
    table.mark(missed_in_motion_ == 0);
    const bool has_converged = std::find(table.converged.begin(), table.converged.end(), 0.0) == table.converged.end();
    findings.band.mark(has_converged);
    for (auto& [name, part] : findings.parts) part.mark(has_converged);
  }
}

void Collector::finish(RunResult& result) {
  result.contacts = parts_.contacts().take();
  finish_outputs(result);
  result.convergence = std::move(convergence_);
  result.bolts = bolts_.take();
  result.warnings = std::move(warnings_);
  result.overloaded_steps = std::move(overloaded_);
  parts_.motion().finish(result);
  parts_.turned().finish(problem_, result);
  parts_.gaps().finish(result);
  parts_.contacts().tell(result);
  result.stresses = parts_.stresses().take();
  // What is not a number stays.
  for (const PartStress& stress : result.stresses) {
    std::optional<double>& worst = stress.is_index ? result.figures.failure_index : result.figures.yield_margin;
    const double value = stress.is_index ? stress.largest : stress.margin();
    if (!worst || std::isnan(value) || (stress.is_index ? value > *worst : value < *worst)) worst = value;
  }
  finish_books(result);
  add_error_figures(parts_.errors(), problem_, result);
}

}  // namespace dygita
