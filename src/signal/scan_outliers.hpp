// Points of a scan that contradict what lies around them.
#pragma once

#include <string>
#include <vector>

namespace dygita {

struct ScanPoint {
  double u, v, height;  // m
  int line;             // of its file
};

struct ScanOutlier {
  const ScanPoint* point;
  double off, scatter;  // m, it is off the plane through its neighbours; these are off theirs
};

// Throws InputError at the line of a place that has another height already.
void refuse_two_heights(const std::vector<ScanPoint>& points, const std::string& file);

// Those farther off the plane through their eight nearest neighbours than eight times the scatter of all points, and
// three times that of the neighbours themselves, but for two of these: the edge of a step has neighbours like it. The
// worst first.
std::vector<ScanOutlier> outliers_of(const std::vector<ScanPoint>& points);

// What a warning says of them: the worst in full, the others by their lines; empty: there are none.
std::string doubt_of_outliers(const std::vector<ScanPoint>& points);

}  // namespace dygita
