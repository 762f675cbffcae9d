// What a sequence of ever finer runs shows of its limit.
#pragma once

#include <limits>
#include <vector>

namespace dygita {

enum class Tendency {
  settled,      // nothing moves by more than rounding
  asymptotic,   // of an order between 0.9 and 2.5
  fast,         // of a higher one: coarse runs that have not come to their order yet
  slow,         // of a lower one: something singular, as at a re-entrant edge
  oscillating,  // the last two changes point opposite ways, or fall fast after one that did not
  divergent     // the changes do not shrink
};

// "asymptotic", and what to make of the others.
const char* meaning(Tendency tendency);

struct GridConvergence {
  Tendency tendency = Tendency::divergent;
  double order = std::numeric_limits<double>::quiet_NaN();  // observed in the last three runs
  // Extrapolated, one entry for each of the values; the finest run's where the order cannot be trusted.
  std::vector<double> limit;
  double uncertainty = std::numeric_limits<double>::infinity();  // of the finest run, in the values' unit
  double finest = 0.0;                                           // size of the finest run
  double exponent = 1.0;                                         // of the size, in what is predicted

  // The uncertainty that a run of another size would have.
  double at(double size) const;
};

// The grid convergence index: observed order of the last three runs, the error of the finest one by Richardson's
// extrapolation, times 1.25 where the runs are asymptotic and 3 where they are not (manual, eq. Q10-Q11; ASME V&V
// 20-2009, 2-4). `sizes`: falling, of cells or time steps, three at least; `values`: of each run, one or as
// many as a spectrum has, whose largest difference then counts; what changes by less than `noise` is rounding.
GridConvergence grid_convergence(const std::vector<double>& sizes, const std::vector<std::vector<double>>& values,
                                 double noise);

}  // namespace dygita
