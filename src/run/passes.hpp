// Spectra that were asked for: passes over the run until they stand still.
#pragma once

#include "model/model.hpp"
#include "result/result.hpp"

namespace dygita {

// Tolerances of the passes over a run, the problem's own last: one pass unless spectra are to decide (solver.latin{
// spectra }).
std::vector<double> pass_tolerances(const Problem& problem);

// Compares the spectra of a pass with those of the one before, which tells their bands of iteration. True where none
// has moved by as much as the problem allows.
bool have_settled(const Problem& problem, const RunResult& before, RunResult& result);

// Adds what the pass before took to the figures of this one.
void add_pass(const RunResult& before, RunResult& result);

}  // namespace dygita
