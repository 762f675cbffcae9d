// What a case comes to: one figure or two of each output, for tables of parametric studies.
#pragma once

#include <string>
#include <vector>

#include "result/result.hpp"

namespace dygita {

struct CaseFigure {
  std::string name, unit;  // "bolt.normal largest", "N"
  double value = 0.0;      // SI; NaN where the run gave nothing
};

// What each output says of itself (Output::study_figures), in the problem's order.
std::vector<CaseFigure> case_summary(const Problem& problem, const RunResult& result);

// What rounding leaves of a quantity that is zero, by its SI unit: far below what anyone measures.
double noise_of(const std::string& unit);

// Largest difference of two runs of the same problem over all columns of their tables, each relative to the largest
// value of its unit in its table. Columns of noise and areas by state are left out: a point on the verge of sliding
// counts here or there. Tables of different lengths differ by infinity.
struct Difference {
  double value = 0.0;
  std::string where;  // "bolt.normal"; empty where nothing differs
};
Difference largest_difference(const Problem& problem, const RunResult& a, const RunResult& b);

}  // namespace dygita
