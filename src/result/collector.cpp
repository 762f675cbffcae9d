#include "result/collector.hpp"

#include <algorithm>
#include <cmath>

#include "result/limits.hpp"
#include "result/spectra.hpp"
#include "result/spectrum_band.hpp"
#include "result/spectrum_field.hpp"

namespace dygita {

Collector::~Collector() = default;

Collector::Collector(const Problem& problem, FrameSink sink)
    : problem_(problem), sink_(std::move(sink)), bolts_(problem) {
  for (const OutputPtr& output : problem.outputs) {
    switch (output->kind) {
      case OutputKind::history:
        samplers_[output.get()] = make_history_sampler(problem, *output);
        break;
      case OutputKind::resultant:
        samplers_[output.get()] = make_resultant_sampler(problem, *output);
        break;
      case OutputKind::joint:
        samplers_[output.get()] = make_joint_sampler(problem, *output);
        break;
      case OutputKind::energy:
        samplers_[output.get()] = make_energy_sampler();
        break;
      case OutputKind::loop:
        samplers_[output.get()] = make_loop_sampler(problem, *output);
        break;
      case OutputKind::superelement:
        samplers_[output.get()] = make_superelement_sampler(problem, *output);
        break;
      case OutputKind::vtk:
        motion_ = std::make_shared<FollowedMotion>();
        break;
      case OutputKind::srs_field:
        fields_[output.get()] = std::make_unique<SpectrumField>(problem, *output);
        break;
      case OutputKind::srs:
      case OutputKind::attenuation:
        break;
    }
  }
  convergence_.names = {"time", "iterations", "indicator", "converged"};
  convergence_.units = {"s", "", "", ""};
  convergence_.columns.resize(4);
}

void Collector::begin_step(const Instant& start) {
  for (auto& [output, sampler] : samplers_) sampler->begin_step(start);
  if (motion_) motion_->begin_step(start);
  errors_.begin_step(start);
  bolts_.begin_step(start);
  extremes_.before_springs = start.state.energies.scheme;
  if (start.i_step == 0) maybe_frame(start);
}

void Collector::accept(const Instant& instant) {
  if (motion_) motion_->accept(instant);
  errors_.accept(instant);
  bolts_.accept(instant);
  for (auto& [output, sampler] : samplers_) sampler->accept(instant);
  for (auto& [output, field] : fields_) field->accept(instant);
  const double row[] = {instant.time(), static_cast<double>(instant.iterations), instant.indicator,
                        instant.converged ? 1.0 : 0.0};
  for (int i = 0; i < 4; ++i) convergence_.columns[i].push_back(row[i]);
  convergence_.step.push_back(instant.i_step);
  watch(instant);
  maybe_frame(instant);
}

void Collector::maybe_frame(const Instant& instant) {
  for (const OutputPtr& output : problem_.outputs) {
    if (output->kind != OutputKind::vtk || !sink_) continue;
    const int n = instant.model.step->n_increments(), frames = std::min(output->frames, n), i = instant.increment + 1;
    // Evenly over the step, its last increment always.
    if (i > 0 && (i * static_cast<long>(frames)) / n == ((i - 1) * static_cast<long>(frames)) / n) continue;
    Frame frame = make_frame(instant, *output, *motion_);
    frame.label_time = label_time(instant);
    sink_(frame);
  }
}

// Static increments take a hundredth of the dynamic time each, so that frames follow one another; the first dynamic
// step starts at zero.
double Collector::label_time(const Instant& instant) const {
  double dynamic = 0.0;
  for (const StepPtr& step : problem_.steps)
    if (!step->is_static) dynamic += step->duration;
  const double unit = dynamic > 0.0 ? dynamic / 100.0 : 1.0;
  int before_dynamic = 0, so_far = 0;
  bool seen_dynamic = false;
  for (size_t i = 0; i < problem_.steps.size(); ++i) {
    const Step& step = *problem_.steps[i];
    seen_dynamic |= !step.is_static;
    if (!step.is_static) continue;
    if (!seen_dynamic) before_dynamic += step.increments;
    if (static_cast<int>(i) < instant.i_step) so_far += step.increments;
    if (static_cast<int>(i) == instant.i_step) so_far += instant.increment + 1;
  }
  return instant.time() + unit * (so_far - (seen_dynamic ? before_dynamic : 0));
}

void Collector::watch(const Instant& instant) {
  const Energies& e = instant.state.energies;
  extremes_.energy = std::max({extremes_.energy, e.start, e.kinetic + e.strain + std::abs(e.loads)});
  extremes_.imbalance = std::max(extremes_.imbalance, std::abs(e.balance()));
  extremes_.scheme_loss = std::max(extremes_.scheme_loss, e.scheme);
  extremes_.scheme_gain = std::max(extremes_.scheme_gain, -e.scheme);
  if (instant.fields) extremes_.springs = std::max(extremes_.springs, e.scheme - extremes_.before_springs);
  for (size_t s = 0; s < instant.model.surfaces->size(); ++s) {
    if (!(*instant.model.surfaces)[s].declared_law().shown().gap) continue;
    for (const LawState& p : instant.state.surfaces[s].points)
      extremes_.penetration = std::max(extremes_.penetration, -p.gap);
  }
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
  }
}

void add_bands(const ErrorEstimator& errors, const Problem& problem, RunResult& result) {
  for (const OutputPtr& output : problem.outputs) {
    if (output->kind != OutputKind::srs || problem.explicit_dynamics) continue;
    Table band = spectrum_band(result.tables.at(output.get()), output->srs.quantity, errors.dynamic_steps());
    if (band.n_rows() == 0) continue;
    result.bands[output.get()] = std::move(band);
  }
}

}  // namespace

void Collector::finish(RunResult& result) {
  for (auto& [output, sampler] : samplers_) {
    sampler->summarise(result);
    result.tables[output] = sampler->take();
  }
  for (const OutputPtr& output : problem_.outputs) {
    const auto of = [&](const OutputPtr& history) -> const Table& { return result.tables.at(history.get()); };
    if (output->kind == OutputKind::srs)
      result.tables[output.get()] = spectrum_table(problem_, *output, of(output->of));
    if (output->kind == OutputKind::attenuation)
      result.tables[output.get()] = attenuation_table(problem_, *output, of(output->of), of(output->leaving));
  }
  for (auto& [output, field] : fields_) {
    result.fields[output] = field->frames();
    result.tables[output] = field->table(result.fields[output]);
  }
  result.convergence = std::move(convergence_);
  result.bolts = bolts_.take();
  add_bands(errors_, problem_, result);
  const double percent = extremes_.energy > 0.0 ? 100.0 / extremes_.energy : 0.0;
  result.figures.largest_energy = extremes_.energy;
  result.figures.energy_imbalance = percent * extremes_.imbalance;
  result.figures.numerical_dissipation = percent * extremes_.scheme_loss;
  result.figures.energy_gain = percent * extremes_.scheme_gain;
  result.figures.largest_penetration = extremes_.penetration;
  add_error_figures(errors_, problem_, result);
  // What the springs of a penalty hold is what the sides overlap: its interfaces' constitutive-relation error.
  if (problem_.explicit_dynamics) result.figures.penalty_error = limit::penalty_error_of(percent * extremes_.springs);
}

}  // namespace dygita
