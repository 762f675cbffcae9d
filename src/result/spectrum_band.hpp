// What iteration, time step and mesh leave on a shock response spectrum, in dB (manual, eq. Q7-Q8).
#pragma once

#include "result/error_estimator.hpp"
#include "result/result.hpp"
#include "signal/srs.hpp"

namespace dygita {

// Share of the mean error velocity that a spectrum shows, fitted so that the true differences lie below (manual, Q7).
inline constexpr double band_share = 0.3;

// frequency [Hz], iteration, time_step, mesh, all [dB] for the maximax of `spectrum`, a spectrum of `quantity`.
Table spectrum_band(const Table& spectrum, SrsQuantity quantity, const ErrorEstimator::Estimate& errors);

// Puts what a spectrum has moved since the pass before in the place of the estimate of what iterating leaves.
void take_iteration_from(const Table& spectrum, const Table& before, Table& band);

// Mean of a column over the frequencies, dB.
double mean_band(const Table& band, const std::string& column);

// Largest difference of the maximax of two spectra over the same frequencies, dB.
double largest_move(const Table& spectrum, const Table& other);

}  // namespace dygita
