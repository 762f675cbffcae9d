#include "estimates/error_estimator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/parallel.hpp"
#include "estimates/mass_lag.hpp"
#include "model/extent.hpp"
#include "result/limits.hpp"
#include "watch/growth.hpp"

namespace dygita {

namespace {

// Of a dynamic step: of the stress error, which costs about a time step each, and of strain energies alone.
constexpr int n_samples = 5, n_strains = 25;

// Masses (kg) and directions of the unknowns of a piece, as velocities have them.
Vec masses_of(const Instant& instant, int piece) {
  const Piece& of = *instant.model.pieces[static_cast<size_t>(piece)];
  return instant.fields ? Vec(of.node_masses().replicate(1, 3).transpose().reshaped()) : of.unknown_masses();
}

Points directions_of(const Instant& instant, int piece) {
  const Piece& of = *instant.model.pieces[static_cast<size_t>(piece)];
  return instant.fields ? Points(Mat3::Identity().replicate(1, of.node_masses().size())) : of.unknown_directions();
}

Vec velocity_of(const Instant& instant, int piece) {
  if (instant.fields) return instant.velocity(piece).reshaped();
  const Piece& of = *instant.model.pieces[static_cast<size_t>(piece)];
  return of.is_explicit() ? Vec(of.velocity().reshaped()) : of.state().v;  // whose state is put together when asked for
}

// Of increments from 0 on.
bool is_regular(long i, long all) { return (i + 1) * n_samples / all != i * n_samples / all; }

// One in each of equal spans, placed by the golden section, so that they keep no step with the motion; the regular too.
bool is_sampled(long i, long all) {
  const long span = i * n_strains / all, first = (span * all + n_strains - 1) / n_strains,
             length = ((span + 1) * all + n_strains - 1) / n_strains - first;
  const double place = std::fmod(static_cast<double>(span + 1) * (std::numbers::phi - 1.0), 1.0);
  return i == first + static_cast<long>(place * static_cast<double>(length)) || is_regular(i, all);
}

double ratio(double energy, double of) { return of > 0.0 ? std::sqrt(std::max(0.0, energy) / of) : 0.0; }

}  // namespace

// Relative to the assembly's motion as a whole, which bends no cell and turns no phase (eq. Q0).
void ErrorEstimator::take_velocities(const Instant& instant) {
  const Cut& cut = *instant.model.cut;
  const bool asks_for_momentum = carried_->asks_for_momentum();
  const auto renew = [&](int i) {
    PieceMotion& own = pieces_[static_cast<size_t>(i)];
    own.velocity = velocity_of(instant, own.piece);
    if (asks_for_momentum) own.momentum.noalias() = own.directions * own.mass.cwiseProduct(own.velocity);
  };
  Eigen::Index n_unknowns = 0;
  for (const PieceMotion& own : pieces_) n_unknowns += own.velocity.size();
  const int threads_for_few = 1, n_threads = n_unknowns < 20000 ? threads_for_few : 0;
  if (asks_for_momentum) parallel_for(static_cast<int>(pieces_.size()), renew, Schedule::as_free, n_threads);
  size_t next = 0;  // of pieces_, whose order is that of the cut
  const auto momenta_of_all = [&] {
    next = 0;
    return of_all_pieces(cut, 3, [&](int, double* to) { std::copy_n(pieces_[next++].momentum.data(), 3, to); });
  };
  const Vec3 carried = carried_->at(instant, [&] {
    const std::vector<double> momenta = momenta_of_all();
    Vec3 sum = Vec3::Zero();
    for (size_t i = 0; i < momenta.size(); i += 3) sum += Eigen::Map<const Vec3>(&momenta[i]);
    return sum;
  });
  constexpr int width = OctaveSamples::most_octaves + 1;
  std::vector<std::array<double, width>> own_sums(pieces_.size());
  std::vector<int> n_octaves(pieces_.size());
  const auto take = [&](int i) {
    if (!asks_for_momentum) renew(i);
    PieceMotion& own = pieces_[static_cast<size_t>(i)];
    double* sums = own_sums[static_cast<size_t>(i)].data();
    if (!carried.isZero(0.0)) own.velocity.noalias() -= own.directions.transpose() * carried;
    const Vec momenta = own.mass.cwiseProduct(own.velocity);
    sums[0] = own.velocity.dot(momenta);
    if (!linked_.are_one()) own.momentum.noalias() = own.directions * momenta;
    n_octaves[static_cast<size_t>(i)] = own.octaves.add(own.mass, own.velocity, sums + 1);
  };
  parallel_for(static_cast<int>(pieces_.size()), take, Schedule::as_free, n_threads);
  const int n = 1 + n_octaves.front();
  next = 0;
  const std::vector<double> all =
      of_all_pieces(cut, n, [&](int, double* to) { std::copy_n(own_sums[next++].data(), n, to); });
  std::vector<double> sums(static_cast<size_t>(n), 0.0);
  for (size_t i = 0; i < all.size(); ++i) sums[i % sums.size()] += all[i];
  for (PartMotion& part : parts_) part.kinetic = 0.0;
  for (int i = 0; i < cut.n_pieces(); ++i)
    parts_[static_cast<size_t>(cut.piece(i).part)].kinetic += 0.5 * all[static_cast<size_t>(i * n)];
  kinetic_now_ = 0.5 * sums[0];
  if (!linked_.are_one()) kinetic_now_ -= linked_.energy_as_wholes(instant, momenta_of_all(), carried_->free());
  bank_->add(std::span(sums).subspan(1));
}

ErrorEstimator::ErrorEstimator(const Problem& problem, PartViews& views)
    : volume_(volumes(problem)), linked_(problem), views_(&views) {
  for (size_t i = 0; i < volume_.size(); ++i)
    at_rest_ += 0.5 * problem.substructures[i]->material.young() * std::pow(limit::strain_at_rest, 2) * volume_[i];
}

void ErrorEstimator::begin_step(const Instant& start) {
  if (bank_) {
    const Estimate so_far = dynamic_steps();
    before_ = so_far.time_step * std::sqrt(energy());
    bank_.reset();
  }
  pieces_.clear();
  start_.clear();
  find_free_surfaces(start);
  still_ = {start.state.energies.loads, start.state.energies.strain + start.state.energies.stored,
            start.state.energies.balance()};
  if (start.is_static()) return;
  for (int i = 0; i < start.model.cut->n_pieces(); ++i)
    if (start.model.cut->is_here(i)) pieces_.emplace_back().piece = i;
  parallel_for(static_cast<int>(pieces_.size()), [&](int i) {
    PieceMotion& own = pieces_[static_cast<size_t>(i)];
    own.mass = masses_of(start, own.piece);
    own.directions = directions_of(start, own.piece);
    own.start = strained_piece(start, own.piece);
    own.before = Points::Zero(3, own.start.cols());
  });
  carried_.emplace(start);
  linked_.begin_step(start);
  strain_at_stress_ = 0.0;
  springs_.begin(start.state.energies.stored);
  bank_.emplace(start.model.is_tuned());
  dt_ = start.interval();
  total_mass_ = 0.0;
  parts_.resize(start.model.problem->substructures.size());
  for (PartMotion& part : parts_) part.mass = 0.0;
  for (size_t i = 0; i < start.model.pieces.size(); ++i) {
    const double mass = start.model.pieces[i]->mass();
    total_mass_ += mass;
    parts_[static_cast<size_t>(start.model.cut->piece(static_cast<int>(i)).part)].mass += mass;
  }
  starts_strained_ = start.state.energies.strain > 0.0;
  lag_ = 0.0;
  for (const double own : of_all_pieces(*start.model.cut, 1, [&](int i, double*to) {
         *to = mass_lag(*start.model.pieces[static_cast<size_t>(i)], *start.model.cut->piece(i).body);
       }))
    lag_ += own / total_mass_;
  views_->take(start);
  for (size_t i = 0; i < start.model.problem->substructures.size(); ++i)
    start_.push_back(without_growth(views_->field(static_cast<int>(i)), growth_at(start, static_cast<int>(i)),
                                    views_->of(static_cast<int>(i)).mesh().nodes));
}

// Collective.
double ErrorEstimator::energy_when_carried(const Instant& instant) const {
  const Problem& problem = *instant.model.problem;
  const Cut& cut = *instant.model.cut;
  const std::vector<double> moved2 = of_all_pieces(
      cut, 1, [&](int i, double* to) { *to = instant.piece_displacement(i).colwise().squaredNorm().maxCoeff(); });
  double energy = 0.0;
  for (size_t i = 0; i < volume_.size(); ++i) {
    if (volume_[i] == 0.0) continue;  // of matrices alone
    const auto part = static_cast<int>(i);
    const auto first = moved2.begin() + cut.first(part);
    const double most2 = *std::max_element(first, first + cut.n_pieces(part));
    const double size2 = extent_of(*problem.substructures[i]).size().squaredNorm();
    energy += 0.5 * problem.substructures[i]->material.young() * volume_[i] * most2 / size2 *
              std::pow(limit::strain_of_carrying, 2);
  }
  return energy;
}

// What increments leave adds up along a static path: friction keeps it. It is held against the work that the step's own
// loads do, or what it gives back of the strain energy, since what an earlier step has stored says nothing of this one;
// and it is no less than what the energy balance misses in the step (eq. Q9).
void ErrorEstimator::accept_static(const Instant& instant) {
  const Energies& energies = instant.state.energies;
  static_.interface_energy += instant.interface_energy;
  still_.left += std::sqrt(std::max(0.0, instant.interface_energy));
  still_.work = std::max({still_.work, std::abs(energies.loads - still_.loads),
                          std::abs(energies.strain + energies.stored - still_.strain)});
  still_.missing = std::max(still_.missing, std::abs(energies.balance() - still_.balance));
  if (instant.increment + 1 < instant.model.step->n_increments()) return;
  const double carried = energy_when_carried(instant);
  at_rest_ = std::max(at_rest_, carried);
  if (const double work = std::max(still_.work, 1e-8 * energies.strain); work > carried)
    static_.iteration = std::max(
        {static_.iteration, still_.left / std::sqrt(work), still_.missing / std::max(work, 1e-4 * energies.strain)});
  const StressEnergies energies_now = stress_energies(instant, strain_energies(instant).of_motion);
  // What is left of nothing is rounding.
  most_strain_ = std::max({most_strain_, energies_now.strain, still_.strain});
  if (energies_now.strain > carried)
    static_.mesh =
        std::max(static_.mesh, ratio(energies_now.error(), std::max(energies_now.strain, 1e-8 * most_strain_)));
}

// What moves as a whole, spins, flies or slides, has no strain, and nothing in it swings: the mean frequency is that of
// strain energies.
void ErrorEstimator::sample(const Instant& instant) {
  const long all = instant.model.step->n_increments(), i = instant.increment;
  if (is_sampled(i, all)) sample_strain(instant, is_regular(i, all));
  if (!is_sampled(i + 1, all)) return;
  parallel_for(static_cast<int>(pieces_.size()), [&](int k) {
    PieceMotion& own = pieces_[static_cast<size_t>(k)];
    own.before = strained_piece(instant, own.piece) - own.start;
  });
}

void ErrorEstimator::sample_strain(const Instant& instant, bool is_regular) {
  const StrainEnergies now = strain_energies(instant);
  strain_now_ = now.of_motion;
  moving_ += kinetic_now_;
  strained_ += now.of_motion;
  rate_ += now.of_velocities;
  sprung_ += springs_.energy();
  sprung_rate_ += springs_.energy_of_velocities(dt_);
  ++n_strained_;
  shock_energy_ = std::max(shock_energy_, kinetic_now_ + now.of_motion + springs_.energy());
  for (size_t k = 0; k < parts_.size(); ++k)
    parts_[k].energy = std::max(parts_[k].energy, parts_[k].kinetic + now.of_parts[k]);
  // A short pulse has its stress between the regular instants.
  if (is_regular || now.of_motion > 4.0 * strain_at_stress_)
    sample_stress(instant, now.of_motion, is_regular ? 1.0 : static_cast<double>(n_samples) / n_strains);
}

// weight: of the time that the instant stands for.
void ErrorEstimator::sample_stress(const Instant& instant, double strain, double weight) {
  lumping_sum_ += weight * lumping_energy(instant);
  kinetic_sum_ += weight * kinetic_now_;
  sprung_sum_ += weight * springs_.energy();
  const StressEnergies now = stress_energies(instant, strain);
  stress_energy_ = std::max(stress_energy_, now.error());
  sums_.within += weight * now.within;
  sums_.at_surface += weight * now.at_surface;
  sums_.strain += weight * now.strain;
  strain_at_stress_ = std::max(strain_at_stress_, strain);
}

void ErrorEstimator::accept(const Instant& instant) {
  strain_now_.reset();
  if (instant.is_static()) return accept_static(instant);
  // Central differences of n substeps.
  phase_factor_ = instant.fields ? TimeScheme::lag_of_central_differences / std::pow(std::max(1, instant.iterations), 2)
                                 : instant.model.phase_factor();
  dynamic_.interface_energy += instant.interface_energy;
  const Energies& energies = instant.state.energies;
  springs_.accept(energies.stored);
  linked_.accept(instant);
  take_velocities(instant);
  if (instant.work_left) watch_parts(instant);
  kinetic_ = std::max(kinetic_, kinetic_now_);
  stored_ = std::max(stored_, energies.held());
  sample(instant);
}

// A light part on a heavy one has little of the energy that the tolerance is relative to. What the iteration leaves
// between it and its neighbours feeds its own motion, or takes from it, increment after increment.
void ErrorEstimator::watch_parts(const Instant& instant) {
  std::vector<double> strains(parts_.size(), 0.0);
  for (size_t i = 0; i < instant.work_left->size(); ++i) {
    const auto part = static_cast<size_t>(instant.model.cut->piece(static_cast<int>(i)).part);
    parts_[part].left += (*instant.work_left)[i];
    strains[part] += (*instant.energies)[i].strain;
  }
  for (size_t i = 0; i < parts_.size(); ++i) {
    PartMotion& part = parts_[i];
    part.most_left = std::max(part.most_left, std::abs(part.left));
    // Of a step that starts strained the motion's own share is known where the stress is sampled.
    const double with_strain = part.kinetic + (starts_strained_ ? 0.0 : strains[i]);
    part.energy = std::max({part.energy, 2.0 * part.kinetic, with_strain});
  }
}

// energy: J, of the shock, beside which next to nothing counts as rounding.
std::vector<ErrorEstimator::OfPart> ErrorEstimator::of_parts(double energy) const {
  std::vector<OfPart> all;
  for (const PartMotion& part : parts_) {
    const double own = std::max(part.energy, 1e-12 * energy);
    all.push_back({part.most_left / own, part.mass > 0.0 ? std::sqrt(own / part.mass) : 0.0});
  }
  return all;
}

ErrorEstimator::Estimate ErrorEstimator::dynamic_steps() const {
  Estimate estimate = dynamic_;
  const double energy = this->energy();
  if (energy <= 0.0) return estimate;
  const double root = std::sqrt(energy);
  estimate.parts = of_parts(energy);
  estimate.velocity = total_mass_ > 0.0 ? root / std::sqrt(total_mass_) : 0.0;
  estimate.iteration = std::sqrt(dynamic_.interface_energy) / root;
  estimate.time_step = (before_ + (bank_ ? bank_->phase_error(phase_factor_) : 0.0)) / root;
  if (sums_.strain <= 0.0 || moving_ <= 0.0) return estimate;
  if (strained_ < n_strained_ * at_rest_) return estimate;  // of what moves as a whole there is only rounding
  // Rayleigh's quotient of the velocities, over the energy of which there is less: strain, of what moves as a whole, or
  // kinetic, of what swings about another place than that of the start: let go there, it has three times as much strain
  // energy on average. With more than that a load holds it strained, and the time is the load's. Springs store as
  // strain does.
  const double held = strained_ + sprung_;
  const double frequency2 = (rate_ + sprung_rate_) / std::max(std::min(moving_, held), held / 3.0);
  const double steps2 = frequency2 * dt_ * dt_;  // (w dt)^2
  estimate.mean_frequency = std::sqrt(frequency2) / (2 * std::numbers::pi);
  const FrequencyShares mesh = frequency_shares();
  // What goes with the square of the frequency turns as a time step does; the rest all frequencies alike.
  const double turned = (steps2 > 0.0 ? 12.0 * mesh.dispersion / steps2 : 0.0) + 6.0 * lag_ / (dt_ * dt_);
  const double phase = bank_ ? bank_->phase_error(turned, mesh.of_all) / root : 0.0;
  const bool is_tuned = bank_ && bank_->is_tuned();
  const double lag = TimeScheme::frequency_lag(steps2, is_tuned);
  // Of what (Q2) would have.
  const double of_step = is_tuned && steps2 > 0.0 ? lag / TimeScheme::frequency_lag(steps2, false) : 1.0;
  estimate.mesh_amplitude = ratio(stress_energy_, energy);
  estimate.mesh = std::hypot(phase, estimate.mesh_amplitude);
  estimate.mesh_dispersion = of_step * mesh.dispersion + 0.5 * frequency2 * lag_;
  estimate.mesh_shift = mesh.of_all;
  estimate.mesh_frequency = estimate.mesh_dispersion + estimate.mesh_shift;
  const std::vector<OctaveBank::Lag> octaves = bank_ ? bank_->lags(phase_factor_) : std::vector<OctaveBank::Lag>();
  for (const auto& [turn, error] : octaves)
    estimate.lags.emplace_back(turn / (2 * std::numbers::pi * dt_), error / root * estimate.velocity);
  estimate.main_frequency = estimate.mean_frequency;
  estimate.step_frequency = phase_factor_ * lag;
  return estimate;
}

}  // namespace dygita
