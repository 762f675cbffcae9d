// Shock response spectra of what a run recorded: what the outputs that give them share.
#pragma once

#include "model/arguments.hpp"
#include "model/output.hpp"
#include "result/result.hpp"
#include "signal/srs.hpp"

namespace dygita {

inline constexpr const char* spectrum_names[] = {"maximax", "positive", "negative", "primary", "residual"};

// The arguments of a spectrum. Throws InputError on both of 'q_factor' and 'damping', and on 'from' not below 'to'.
SrsSettings srs_settings(const Arguments& arguments);

// Of a spectrum of accelerations (m/s^2).
std::string spectrum_unit(const SrsSettings& settings);

// Throws InputError where the problem has no dynamic step.
void check_spectrum(const Problem& problem, const Output& output);

// Of a column of a history over its dynamic rows; steps of different dt are brought to the smallest. No frequency where
// there is no such row.
Srs spectrum_of(const Problem& problem, const SrsSettings& settings, const Table& history, size_t column);

// Frequencies that the dynamic rows of a history allow to judge: from 1/record length to half the sampling rate.
FrequencyRange judged_by(const Problem& problem, const Table& history);

// Linear between instants (s, increasing), every dt from the first to the last: what a spectrum takes.
std::vector<double> evenly(const std::vector<double>& time, const std::vector<double>& value, double dt);

}  // namespace dygita
