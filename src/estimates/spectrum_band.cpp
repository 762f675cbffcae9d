#include "estimates/spectrum_band.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace dygita {

namespace {

double decibels(double ratio) { return 20.0 * std::log10(ratio); }

// Of the velocities, relative to those of the shock: all of the mesh error that is phase, and the square of the error
// of stresses.
double mesh_error_of_motion(const ErrorEstimator::Estimate& errors) {
  const double amplitude2 = std::pow(errors.mesh_amplitude, 2);
  return std::sqrt(std::max(0.0, std::pow(errors.mesh, 2) - amplitude2) + std::pow(amplitude2, 2));
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
    const double parts[] = {errors.iteration, errors.time_step, mesh_error_of_motion(errors)};
    for (int k = 0; k < 3; ++k) {
      // A spectrum of nothing has no level to be relative to.
      band.columns[k + 1].push_back(maximax[i] > 0.0 ? decibels(1.0 + level * parts[k] / maximax[i]) : 0.0);
    }
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
