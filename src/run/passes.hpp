// Spectra that were asked for: passes over the run until they stand still, and what is said of their errors.
#pragma once

#include "model/model.hpp"
#include "result/result.hpp"

namespace dygita {

// Tolerances of the passes over a run, the problem's own last: one pass unless spectra are to decide (solver.latin{
// spectra }).
std::vector<double> pass_tolerances(const Problem& problem);

// Compares the spectra of a pass with those of the one before: what they have moved becomes their iteration band. True
// where none has moved by as much as the problem allows.
bool have_settled(const Problem& problem, const RunResult& before, RunResult& result);

// Adds what the pass before took to the figures of this one.
void add_pass(const RunResult& before, RunResult& result);

// A line for each spectrum: its mean band.
void say_bands(const Problem& problem, const RunResult& result);

// Warns of spectra whose band is wider than a factor of two.
void warn_of_bands(const Problem& problem, const RunResult& result);

}  // namespace dygita
