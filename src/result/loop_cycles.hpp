// From force against displacement to a condensed joint: cycles, loss, stiffness, exponent, backbone (manual, eq.
// C1-C7).
#pragma once

#include "result/result.hpp"

namespace dygita {

// table: columns time (s), displacement (m), force (N), steps; first: the row that counts as the origin (the tightened
// state). The path is cut at the turning points of the displacement; travels below a thousandth of the whole range are
// no turn. A cycle is a branch and the way back to where it began, closed by a straight line where it misses that by at
// most a fifth of its range.
LoopSummary summarise_loop(const Table& table, int first);

// Rows at which the displacement turns, the ends of the path included; where it stands still, the row at which the
// force turns.
std::vector<int> turning_points(const std::vector<double>& displacement, const std::vector<double>& force, int first);

// Stiffness (N/m) that does not increase along the path, nearest to the given ones in the mean square weighted with
// `length` (pool adjacent violators).
std::vector<double> decreasing(const std::vector<double>& stiffness, const std::vector<double>& length);

// Exponent of y against x by least squares in logarithms; nan unless there are two points with x apart by 5 % and y >
// 0.
double exponent_of(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace dygita
