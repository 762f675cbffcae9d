// Shock response spectra of what a run recorded: of histories, between two places.
#pragma once

#include "result/result.hpp"

namespace dygita {

// Columns frequency (Hz), maximax, positive, negative, primary, residual, of the dynamic rows of a history with one
// column; steps of different dt are brought to the smallest. Empty where there is no dynamic row.
Table spectrum_table(const Problem& problem, const Output& output, const Table& history);

// Against the specification of the output's spectrum; not known where it has none, or no spectrum came.
Exceedance exceedance_of(const Output& output, const RunResult& result);

// "frequency", then "entering", "leaving", "ratio", for vector histories each with _x, _y, _z.
std::vector<std::string> attenuation_columns(const Output& output);

// Band by band the level of both spectra (mean in dB over the band's frequencies) and their ratio in dB, leaving over
// entering, NaN along an axis into which a millionth of the strongest axis' level enters at most; the band's frequency
// is its centre (Hz). Bands that the spectra do not fill are left out; less than one is a band of its own.
Table attenuation_table(const Problem& problem, const Output& output, const Table& entering, const Table& leaving);

// One line: mean ratio of each axis over the bands, the lowest and the highest, beside the rule of thumb (-3 dB a
// bolted joint).
std::string attenuation_summary(const Output& output, const Table& attenuation);

// Linear between instants (s, increasing), every dt from the first to the last: what a spectrum takes.
std::vector<double> evenly(const std::vector<double>& time, const std::vector<double>& value, double dt);

}  // namespace dygita
