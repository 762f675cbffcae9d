// Shock response spectra of what a run recorded: what the outputs that give them share.
#pragma once

#include "model/arguments.hpp"
#include "model/output.hpp"
#include "result/result.hpp"
#include "signal/srs.hpp"

namespace dygita {

inline constexpr const char* spectrum_names[] = {"maximax", "positive", "negative", "primary", "residual"};

// The substructures that a history is on, among its findings: the band of a spectrum of it is of the motion of these.
struct SeenParts {
  std::vector<int> parts;
};

// The arguments of a spectrum. Throws InputError on both of 'q_factor' and 'damping', and on 'from' not below 'to'.
SrsSettings srs_settings(const Arguments& arguments);

// Of a spectrum of accelerations (m/s^2).
std::string spectrum_unit(const SrsSettings& settings);

// Throws InputError where the problem has no dynamic step, or a taper does not fit into them.
void check_spectrum(const Problem& problem, const Output& output, const SrsSettings& settings);

// Of a column of a history over its dynamic rows, which are as far apart as the dt of their steps. No frequency where
// there is no such row.
Srs spectrum_of(const Problem& problem, const SrsSettings& settings, const Table& history, size_t column);

// Values at these instants (s), each the mean over its own dt (s).
std::vector<EvenStretch> stretches_of(const std::vector<double>& time, const std::vector<double>& dt,
                                      const std::vector<double>& value);

// Frequencies that the dynamic rows of a history allow to judge: from 1/record length to half the sampling rate.
FrequencyRange judged_by(const Problem& problem, const Table& history);

// Of the motion behind a column of accelerations, since the dynamic steps began.
struct EndOfRecord {
  double length = 0.0;                        // s
  double velocity = 0.0, displacement = 0.0;  // m/s, m: by how much they have changed
};
EndOfRecord end_of_record(const Problem& problem, const Table& history, size_t column);

// What to say of spectrum `who` where it depends on the end of its record by more than limit::record_band at
// frequencies that are judged; empty: nowhere. `band` in dB.
std::vector<std::string> doubts_of_end(const std::string& who, const Srs& srs, const std::vector<double>& band,
                                       const FrequencyRange& judged, const EndOfRecord& end);

}  // namespace dygita
