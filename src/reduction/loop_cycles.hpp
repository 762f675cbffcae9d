// From force against displacement to a condensed joint: cycles, loss, stiffness, exponent, backbone (manual, eq.
// C1-C7).
#pragma once

#include "result/result.hpp"

namespace dygita {

// A joint as a system model takes it: what output.loop makes of force against displacement (manual, eq. C1-C7).
struct LoopSummary {
  Table cycles;    // one row a closed cycle
  Table backbone;  // force against displacement of first loading, and the sliders that have it
  double exponent =
      0.0;  // of loss against force amplitude, least squares; nan where two cycles with a loss are not there
  double displacement_exponent = 0.0;        // the same against displacement amplitude
  double stiffness = 0.0;                    // N/m, of the first rows of the backbone; nan where there is none
  double secant = 0.0, largest_force = 0.0;  // N/m and N, at its end; nan likewise
  double range = 0.0;                        // m, of the displacement
  int n_gaining = 0;                         // cycles with a negative loss
  double not_converged = 0.0;                // increments, of the steps that it was asked for
  double energy_error = 0.0;                 // of the loss of a cycle, largest share that the run's balance misses
};

// What is known of the rows of a loop beside their values; empty: nothing to say.
struct LoopRows {
  std::vector<char> converged;  // of each row
  std::vector<double> balance;  // J, energy that the run's balance misses so far
  double noise = 1e-5;          // of force x displacement amplitude: less is no loss, but what a tolerance leaves
  double resolution = 0.0;      // m, what the tolerance leaves of a displacement: less is no motion
};

// table: columns time (s), displacement (m), force (N), steps; first: the row that counts as the origin (the tightened
// state). The path is cut at the turning points of the displacement; travels below a thousandth of the whole range are
// no turn. A cycle is a branch and the way back to where it began, closed by a straight line where it misses that by at
// most a fifth of its range.
LoopSummary summarise_loop(const Table& table, int first, const LoopRows& rows = {});

// Rows at which the displacement turns, the ends of the path included; where it is constant, the row at which the
// force turns.
std::vector<int> turning_points(const std::vector<double>& displacement, const std::vector<double>& force, int first);

// Stiffness (N/m) that does not increase along the path, nearest to the given ones in the mean square weighted with
// `length` (pool adjacent violators).
std::vector<double> decreasing(const std::vector<double>& stiffness, const std::vector<double>& length);

// Exponent of y against x by least squares in logarithms; nan unless there are two points with x apart by 5 % and y >
// 0.
double exponent_of(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace dygita
