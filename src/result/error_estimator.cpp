#include "result/error_estimator.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fem/mass.hpp"
#include "fem/stress_error.hpp"

namespace dygita {

namespace {

constexpr int n_samples = 5;  // of the stress error, a dynamic step: each costs about a time step

// Energies (J) of the stress error of all substructures, of those of linear cells alone, and the strain energy of the
// same displacements.
struct StressEnergies {
  double error = 0.0, of_linear = 0.0, strain = 0.0;
};

StressEnergies stress_energies(const Instant& instant, const std::vector<Points>* start) {
  StressEnergies energies;
  const Cut& cut = *instant.model.cut;
  for (size_t i = 0; i < instant.model.problem->substructures.size(); ++i) {
    const int part = static_cast<int>(i);
    const Substructure& body = *instant.model.problem->substructures[i];
    Points u = instant.displacement(part);
    if (start) u -= (*start)[i];
    const double error = stress_error(*body.mesh, body.material, u).energy;
    energies.error += error;
    if (!has_consistent_mass(*body.mesh)) energies.of_linear += error;
    for (int p = cut.first(part); p < cut.first(part) + cut.n_pieces(part); ++p) {
      const Points own = cut.on_piece(p, u);
      const Points force = instant.model.pieces[p]->elastic_force(own);
      energies.strain +=
          0.5 * Eigen::Map<const Vec>(own.data(), own.size()).dot(Eigen::Map<const Vec>(force.data(), force.size()));
    }
  }
  return energies;
}

// Masses (kg) and velocities (m/s) of all unknowns, in one order throughout a step.
Vec all_masses(const Instant& instant) {
  std::vector<Vec> parts;
  for (const auto& piece : instant.model.pieces)
    parts.push_back(instant.fields ? Vec(piece->node_masses().replicate(1, 3).transpose().reshaped())
                                   : piece->unknown_masses());
  Vec all(0);
  for (const Vec& part : parts) {
    all.conservativeResize(all.size() + part.size());
    all.tail(part.size()) = part;
  }
  return all;
}

Points all_directions(const Instant& instant) {
  std::vector<Points> parts;
  Eigen::Index n = 0;
  for (const auto& piece : instant.model.pieces) {
    parts.push_back(instant.fields ? Points(Mat3::Identity().replicate(1, piece->node_masses().size()))
                                   : piece->unknown_directions());
    n += parts.back().cols();
  }
  Points all(3, n);
  n = 0;
  for (const Points& part : parts) {
    all.middleCols(n, part.cols()) = part;
    n += part.cols();
  }
  return all;
}

double ratio(double energy, double of) { return of > 0.0 ? std::sqrt(std::max(0.0, energy) / of) : 0.0; }

}  // namespace

void OctaveBank::add(size_t i_octave, const Vec& velocity) {
  if (i_octave == octaves_.size()) octaves_.emplace_back();
  Octave& octave = octaves_[i_octave];
  std::vector<Vec>& last = octave.last;
  if (last.size() == 3) {
    // The third difference passes what turns by a right angle a sample, the middle of the octave, with the factor
    // 2^(3/2).
    constexpr double quarter = std::numbers::pi / 2, gain = 2.0 * std::numbers::sqrt2;
    double sum = 0.0;
    for (Eigen::Index i = 0; i < velocity.size(); ++i) {
      const double difference = velocity[i] - last[2][i] - 3.0 * (last[0][i] - last[1][i]);
      sum += mass_[i] * difference * difference;
    }
    const double content = std::sqrt(sum) / gain, steps = std::exp2(i_octave);
    octave.content = std::max(octave.content, content);
    const double turned = is_tuned_ ? std::pow(quarter / steps, 5) / 80.0 : std::pow(quarter / steps, 3) / 12.0;
    octave.phase += steps * turned * content;
  }
  // Every other sample, smoothed, goes to the octave below.
  if (octave.n_samples++ % 2 == 1 && last.size() >= 2) {
    const Vec smooth = 0.25 * (velocity + 2.0 * last[0] + last[1]);
    Vec mine = velocity;
    last.insert(last.begin(), std::move(mine));
    if (last.size() > 3) last.pop_back();
    add(i_octave + 1, smooth);  // may move the octaves: nothing of this one is used after it
    return;
  }
  last.insert(last.begin(), velocity);
  if (last.size() > 3) last.pop_back();
}

double OctaveBank::phase_error(double factor) const {
  double sum = 0.0;
  for (const Octave& octave : octaves_)
    sum += std::pow(std::min(factor * octave.phase, std::numbers::sqrt2 * octave.content), 2);
  return std::sqrt(sum);
}

// Relative to the assembly's motion as a whole, which bends no cell and turns no phase (eq. Q0).
void ErrorEstimator::take_velocities(const Instant& instant) {
  Eigen::Index n = 0;
  for (size_t i = 0; i < instant.model.pieces.size(); ++i) {
    if (instant.fields) {
      const Points velocity = instant.velocity(static_cast<int>(i));
      velocity_.segment(n, velocity.size()) = velocity.reshaped();
      n += velocity.size();
      continue;
    }
    const Vec& velocity = instant.model.pieces[i]->state().v;
    velocity_.segment(n, velocity.size()) = velocity;
    n += velocity.size();
  }
  const Vec3 carried = carried_->at(instant, [&] { return Vec3(directions_ * mass_.cwiseProduct(velocity_)); });
  if (!carried.isZero(0.0)) velocity_.noalias() -= directions_.transpose() * carried;
  kinetic_now_ = 0.5 * velocity_.dot(mass_.cwiseProduct(velocity_));
}

void ErrorEstimator::begin_step(const Instant& start) {
  if (bank_) {
    const Estimate so_far = dynamic_steps();
    before_ = so_far.time_step * std::sqrt(energy());
    bank_.reset();
  }
  still_ = {start.state.energies.loads, start.state.energies.balance()};
  if (start.is_static()) return;
  mass_ = all_masses(start);
  directions_ = all_directions(start);
  carried_.emplace(start);
  velocity_.resize(mass_.size());
  velocity_old_.resize(0);
  bank_.emplace(mass_, start.model.is_tuned());
  dt_ = start.interval();
  total_mass_ = 0.0;
  for (const auto& piece : start.model.pieces) total_mass_ += piece->node_masses().sum();
  start_.clear();
  for (size_t i = 0; i < start.model.problem->substructures.size(); ++i)
    start_.push_back(start.displacement(static_cast<int>(i)));
}

// What increments leave adds up along a static path: friction keeps it. It is held against the work that the step's own
// loads do, since what an earlier step has stored says nothing of this one; and it is no less than what the energy
// balance misses in the step (eq. Q9).
void ErrorEstimator::accept_static(const Instant& instant) {
  const Energies& energies = instant.state.energies;
  static_.interface_energy += instant.interface_energy;
  still_.left += std::sqrt(std::max(0.0, instant.interface_energy));
  still_.work = std::max(still_.work, std::abs(energies.loads - still_.loads));
  still_.missing = std::max(still_.missing, std::abs(energies.balance() - still_.balance));
  if (instant.increment + 1 < instant.model.step->n_increments()) return;
  if (const double work = std::max(still_.work, 1e-8 * energies.strain); work > 0.0)
    static_.iteration = std::max({static_.iteration, still_.left / std::sqrt(work), still_.missing / work});
  const StressEnergies energies_now = stress_energies(instant, nullptr);
  static_.mesh = std::max(static_.mesh, ratio(energies_now.error, energies_now.strain));
}

void ErrorEstimator::sample_stress(const Instant& instant) {
  const auto [error, of_linear, strain] = stress_energies(instant, &start_);
  stress_energy_ = std::max(stress_energy_, error);
  stress_sum_ += of_linear;
  strain_sum_ += strain;
  shock_energy_ = std::max(shock_energy_, kinetic_now_ + strain);
  ++n_stress_;
}

void ErrorEstimator::accept(const Instant& instant) {
  if (instant.is_static()) return accept_static(instant);
  // Central differences of n substeps turn a motion by (w dt / n)^2 / 24 too much.
  phase_factor_ = instant.fields ? 0.5 / std::pow(std::max(1, instant.iterations), 2) : instant.model.phase_factor();
  dynamic_.interface_energy += instant.interface_energy;
  const Energies& energies = instant.state.energies;
  take_velocities(instant);
  kinetic_ = std::max(kinetic_, kinetic_now_);
  stored_ = std::max(stored_, energies.kinetic + energies.strain);
  if (velocity_old_.size() > 0) {
    for (Eigen::Index i = 0; i < velocity_.size(); ++i)
      rate_ += mass_[i] * std::pow((velocity_[i] - velocity_old_[i]) / dt_, 2);
    ++n_rates_;
  }
  bank_->add(velocity_);
  velocity_old_ = velocity_;
  const long all = instant.model.step->n_increments(), i = instant.increment + 1;
  if ((i * n_samples) / all != ((i - 1) * n_samples) / all) sample_stress(instant);
}

ErrorEstimator::Estimate ErrorEstimator::dynamic_steps() const {
  Estimate estimate = dynamic_;
  const double energy = this->energy();
  if (energy <= 0.0) return estimate;
  const double root = std::sqrt(energy);
  estimate.velocity = total_mass_ > 0.0 ? root / std::sqrt(total_mass_) : 0.0;
  estimate.iteration = std::sqrt(dynamic_.interface_energy) / root;
  estimate.time_step = (before_ + (bank_ ? bank_->phase_error(phase_factor_) : 0.0)) / root;
  if (n_stress_ == 0 || n_rates_ == 0 || strain_sum_ <= 0.0) return estimate;
  // Rayleigh's quotient of the accelerations: blind to rigid motion and to what was stressed before.
  const double frequency2 = (rate_ / static_cast<double>(n_rates_)) / (2.0 * strain_sum_ / n_stress_);
  estimate.mean_frequency = std::sqrt(frequency2) / (2 * std::numbers::pi);
  // Linear cells of length h leave (k h)^2 / 12 of the strain energy in the stress error, and turn a wave by w dt (k
  // h)^2 / 24 too little. Cells of order two turn it by (k h)^4 / 1440 alone.
  const double turned = frequency2 > 0.0 ? 6.0 * stress_sum_ / strain_sum_ / (frequency2 * dt_ * dt_) : 0.0;
  const double phase = bank_ ? bank_->phase_error(turned) / root : 0.0;
  estimate.mesh = std::hypot(phase, ratio(stress_energy_, energy));
  return estimate;
}

}  // namespace dygita
