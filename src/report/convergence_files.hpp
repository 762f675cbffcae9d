// A study of convergence for people: text, table, figure.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "estimates/convergence_study.hpp"

namespace dygita {

// "size = 0.002, dt = 5e-07".
std::string setting_text(const ConvergenceStudy& study, const Levels& levels);

// For each figure its values along each variation, observed order, limit, uncertainty and what to make of it.
std::string convergence_text(const ConvergenceStudy& study, const std::vector<FigureConvergence>& figures);

// One row a run: the parameters, the figures (spectra left out), seconds; SI.
std::string convergence_csv(const ConvergenceStudy& study);

// Distance from the limit against the size relative to the coarsest, both logarithmic, a line a figure and variation.
std::string convergence_svg(const std::string& title, const ConvergenceStudy& study,
                            const std::vector<FigureConvergence>& figures);

// Writes converge.csv and converge.svg. Throws InputError where it cannot.
void write_convergence(const std::filesystem::path& folder, const std::string& title, const ConvergenceStudy& study,
                       const std::vector<FigureConvergence>& figures);

}  // namespace dygita
