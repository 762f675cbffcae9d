#include "estimates/spectrum_band.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace dygita {

namespace {

double decibels(double ratio) { return 20.0 * std::log10(ratio); }

// A spectrum between its frequencies, dB: straight lines over their logarithms; at its ends as there.
double level_at(const std::vector<double>& frequency, const std::vector<double>& level, double at) {
  const auto after = std::lower_bound(frequency.begin(), frequency.end(), at);
  if (after == frequency.begin()) return decibels(level.front());
  if (after == frequency.end()) return decibels(level.back());
  const auto i = static_cast<size_t>(after - frequency.begin());
  const double share = std::log(at / frequency[i - 1]) / std::log(frequency[i] / frequency[i - 1]);
  return (1.0 - share) * decibels(level[i - 1]) + share * decibels(level[i]);
}

// dB, by how much a spectrum changes where the frequencies of the motion move up or down by a share.
double largest_within(const std::vector<double>& frequency, const std::vector<double>& level, size_t i, double share) {
  double most = 0.0;
  for (const double part : {-1.0, -0.5, 0.5, 1.0}) {
    const double there = level_at(frequency, level, frequency[i] * std::pow(1.0 + share, part));
    if (std::isfinite(there)) most = std::max(most, std::abs(there - decibels(level[i])));
  }
  return most;
}

double turns_of(double frequency, const ErrorEstimator::Estimate& errors) {
  return errors.mean_frequency > 0.0 ? frequency / errors.mean_frequency : 1.0;
}

// Relative: the mesh moves frequencies by shares that rise with them, as in bending (manual, eq. Q15).
double moved_at(double frequency, const ErrorEstimator::Estimate& errors) {
  constexpr double most = 0.5;
  return std::min(most, errors.mesh_shift + errors.mesh_dispersion * turns_of(frequency, errors));
}

// Relative to the level of the spectrum, of which errors of all velocities are a share `of_velocity`. Velocities are
// off by the square of what stresses are, at the frequencies of the motion, also where next to nothing of it arrives. A
// lag moves a spectrum and leaves nothing else, but lets parts meet otherwise.
double mesh_error_beside(const ErrorEstimator::Estimate& errors, double frequency, double of_velocity) {
  const double amplitude2 = std::pow(errors.mesh_amplitude, 2);
  if (!errors.joints_change)
    return amplitude2 * std::max(1.0, of_velocity / std::max(1.0, turns_of(frequency, errors)));
  const double phase2 = std::max(0.0, std::pow(errors.mesh, 2) - amplitude2);
  return of_velocity * std::sqrt(phase2 + std::pow(amplitude2, 2));
}

// Relative, of all frequencies about this one: the time step moves them by shares that rise with their square (manual,
// eq. Q18).
double lag_at(double frequency, const ErrorEstimator::Estimate& errors) {
  constexpr double most = 0.5;
  if (errors.main_frequency <= 0.0) return 0.0;
  return std::min(most, errors.step_frequency * std::pow(frequency / errors.main_frequency, 2));
}

// m/s (manual, eq. Q18): an oscillator responds to octaves about its own frequency, to slower ones by their
// accelerations, faster ones by their displacements.
double response_to(const std::vector<std::pair<double, double>>& velocities, double frequency) {
  double sum = 0.0;
  for (const auto& [about, velocity] : velocities)
    sum += std::pow(velocity * std::min(about / frequency, frequency / about), 2);
  return std::sqrt(sum);
}

constexpr size_t iteration_column = 1, time_step_column = 2, mesh_column = 3, all_column = 4, record_column = 5;

double of_errors(const Table& band, size_t i) {
  return std::hypot(band.columns[iteration_column][i], band.columns[time_step_column][i], band.columns[mesh_column][i]);
}

// Errors of different origin have no common sign.
void add_up(Table& band) {
  band.columns[all_column].clear();
  for (size_t i = 0; i < band.columns[0].size(); ++i)
    band.columns[all_column].push_back(std::hypot(of_errors(band, i), band.columns[record_column][i]));
}

}  // namespace

Table spectrum_band(const Table& spectrum, SrsQuantity quantity, const ErrorEstimator::Estimate& errors,
                    const std::vector<double>& of_record, const char* column) {
  const int power = quantity == SrsQuantity::absolute_acceleration ? 1
                    : quantity == SrsQuantity::pseudo_velocity     ? 0
                                                                   : -1;
  Table band{
      {"frequency", "iteration", "time_step", "mesh", "all", "record"}, {"Hz", "dB", "dB", "dB", "dB", "dB"}, {}, {}};
  band.columns.resize(band.names.size());
  if (spectrum.columns.empty()) return band;
  const std::vector<double>&frequency = spectrum.columns[0], &maximax = spectrum.column(column);
  for (size_t i = 0; i < frequency.size(); ++i) {
    const double w = 2.0 * std::numbers::pi * frequency[i];
    const double level = band_share * errors.velocity * std::pow(w, power);
    band.columns[0].push_back(frequency[i]);
    if (maximax[i] <= 0.0) {  // a spectrum of nothing has no level to be relative to
      for (const size_t k : {iteration_column, time_step_column, mesh_column}) band.columns[k].push_back(0.0);
      continue;
    }
    const double of_velocity = level / maximax[i];
    // Errors without a common sign are those of a motion beside the true one; what has one is missing in the balance.
    const double of_part = errors.seen.velocity * std::pow(w, power) / maximax[i];
    const double gathered = std::max(errors.imbalance, errors.seen.imbalance * std::min(1.0, of_part));
    band.columns[iteration_column].push_back(
        std::hypot(decibels(1.0 + of_velocity * errors.iteration), decibels(1.0 + gathered)));
    band.columns[time_step_column].push_back(
        errors.joints_change ? decibels(1.0 + of_velocity * errors.time_step)
                             : std::hypot(largest_within(frequency, maximax, i, lag_at(frequency[i], errors)),
                                          decibels(1.0 + band_share * response_to(errors.lags, frequency[i]) *
                                                             std::pow(w, power) / maximax[i])));
    band.columns[mesh_column].push_back(
        std::hypot(largest_within(frequency, maximax, i, moved_at(frequency[i], errors)),
                   decibels(1.0 + mesh_error_beside(errors, frequency[i], of_velocity))));
  }
  band.columns[record_column] = of_record;
  band.columns[record_column].resize(frequency.size(), 0.0);
  add_up(band);
  return band;
}

void take_iteration_from(const Table& spectrum, const Table& before, Table& band, const char* column) {
  const std::vector<double>&now = spectrum.column(column), &then = before.column(column);
  for (size_t i = 0; i < now.size(); ++i)
    band.columns[iteration_column][i] = now[i] > 0.0 && then[i] > 0.0 ? std::abs(decibels(now[i] / then[i])) : 0.0;
  add_up(band);
}

double mean_error_band(const Table& band) {
  double sum = 0.0;
  for (size_t i = 0; i < band.columns[0].size(); ++i) sum += of_errors(band, i);
  return sum / static_cast<double>(band.columns[0].size());
}

double mean_band(const Table& band, const std::string& column) {
  const std::vector<double>& values = band.column(column);
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double largest_move(const Table& spectrum, const Table& other) {
  if (spectrum.columns.empty() || other.columns.empty()) return 0.0;
  const std::vector<double>&a = spectrum.column("maximax"), &b = other.column("maximax");
  const double floor = 1e-12 * std::max(*std::max_element(a.begin(), a.end()), *std::max_element(b.begin(), b.end()));
  double worst = 0.0;
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    if (floor > 0.0) worst = std::max(worst, std::abs(decibels(std::max(a[i], floor) / std::max(b[i], floor))));
  return worst;
}

}  // namespace dygita
