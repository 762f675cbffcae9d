// What iteration, time step, mesh and the end of the record leave on a shock response spectrum, in dB (manual, eq. Q7,
// Q8, Q15, Q16, N3).
#pragma once

#include "estimates/error_estimator.hpp"
#include "result/result.hpp"
#include "signal/srs.hpp"

namespace dygita {

// Share of the mean error velocity that a spectrum shows, fitted so that the true differences lie below (manual, Q7).
inline constexpr double band_share = 0.3;

// frequency [Hz], iteration, time_step, mesh, all, record [dB] for a column of `spectrum`, a spectrum of `quantity`;
// `record` as given, empty: none.
Table spectrum_band(const Table& spectrum, SrsQuantity quantity, const ErrorEstimator::Estimate& errors,
                    const std::vector<double>& record = {}, const char* column = "maximax");

// Puts what a spectrum has moved since the pass before in the place of the estimate of what iterating leaves.
void take_iteration_from(const Table& spectrum, const Table& before, Table& band, const char* column = "maximax");

// Mean of a column over the frequencies, dB.
double mean_band(const Table& band, const std::string& column);
// The same of what iteration, time step and mesh leave together.
double mean_error_band(const Table& band);

// Largest difference of the maximax of two spectra over the same frequencies, dB.
double largest_move(const Table& spectrum, const Table& other);

}  // namespace dygita
