// Where a run's own figures are too large to build on: it warns beyond them, and the report's cards turn from green.
// Warnings, cards, spectra and margins take their limits from here and from nowhere else; the frequencies at which
// a spectrum is judged are those that its record holds (signal/frequency_range.hpp).
#pragma once

#include <cmath>

namespace dygita::limit {

inline constexpr double energy_imbalance = 0.5;  // %, of the largest energy
inline constexpr double open_balance = 20.0;     // %, of it: beyond, the run counts as not converged
inline constexpr double strain_at_rest = 1e-11;  // 2 Pa in steel: with less, all over, nothing has happened
inline constexpr double strain_of_carrying =
    1e-6;                                   // of a displacement over the size: the same of what moves as a whole
inline constexpr double energy_gain = 0.5;  // %
inline constexpr double numerical_dissipation = 5.0;  // %
inline constexpr double penalty_energy = 5.0;         // %, that the springs of a penalty hold
inline constexpr double hourglass_energy = 10.0;      // %
inline constexpr double iteration_error = 1.0;        // %, in energy norm, where a tolerance could leave 0.1 %
inline constexpr double discretisation_error = 30.0;  // %, of the time step, of the mesh
inline constexpr double good_discretisation = 10.0;   // %, beyond it a card is amber: stresses are off by as much
inline constexpr double frequency_error = 10.0;       // %, of the time step, of the mesh
inline constexpr double good_frequency = 2.0;         // %, beyond it a card is amber
inline constexpr double spectrum_band = 6.0;          // dB, mean over a spectrum's frequencies: a factor of two
inline constexpr double record_band = 1.0;            // dB, that a spectrum depends on the end of its record
inline constexpr double loop_energy_error = 0.05;     // of the loss of a cycle, that the energy balance misses
inline constexpr double rotation = 5.0;               // degrees, of a cell: what small displacements bear
inline constexpr double strain = 0.1;                 // of a cell, principal: what small strains bear
inline constexpr double slip_in_cells = 0.5;          // of a contact cell, along the slip
inline constexpr double passing_in_cells = 0.01;      // of a cell, of released sides into each other
inline constexpr double specification = 0.0;          // dB above it: exceeded
inline constexpr double yield_margin = 0.0;           // yield / von Mises - 1, below it the material would yield
inline constexpr double good_preload_kept = 0.9;      // of what its tightening gave, below it a card is amber
inline constexpr double preload_kept = 0.5;           // of it, below it a card is red
inline constexpr double bolt_stress = 1.2e9;          // Pa, on its area: yield of the strongest class, 12.9, and more
inline constexpr double bolt_shortening = 0.01;       // m, the longest that load.shortening takes

// What the springs hold (%) and the error in energy norm (%) that goes with it.
inline double penalty_energy_of(double error) { return std::pow(error, 2) / 100.0; }
inline double penalty_error_of(double energy) { return 10.0 * std::sqrt(energy); }

}  // namespace dygita::limit
