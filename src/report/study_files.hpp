// The table and the figure of a parametric study.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "result/case_summary.hpp"

namespace dygita {

struct StudyCase {
  std::string name;                                // of the case
  std::vector<std::pair<std::string, double>> at;  // its parameters, SI
  std::string started_from;                        // name of the case whose interface fields it took; empty: cold
  std::vector<CaseFigure> figures;
  long iterations = 0;
  double mean_iterations = 0.0, seconds = 0.0;
  bool converged = true;
  std::optional<long> cold_iterations;    // where the case was checked cold
  std::optional<double> cold_difference;  // largest relative difference of the answers, then
};

// One row per case: name, started_from, the parameters, the figures, iterations, seconds; numbers in SI.
std::string study_csv(const std::vector<StudyCase>& cases);

// One chart a figure against the first parameter that varies (the case's number where none does), a line for each
// combination of the others, and one of the iterations; figures of cases that have not converged are left out.
std::string study_svg(const std::string& title, const std::vector<StudyCase>& cases);

// Two lines for the screen: how many cases, their iterations, what starting from others saved, what checks said.
std::string study_summary(const std::string& name, const std::vector<StudyCase>& cases);

// Writes study.csv and study.svg into a folder. Throws InputError where it cannot.
void write_study(const std::filesystem::path& folder, const std::string& name, const std::vector<StudyCase>& cases);

}  // namespace dygita
