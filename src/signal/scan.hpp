// A measured face: heights at places of a plane, from a file, and between them.
#pragma once

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/error.hpp"
#include "signal/scan_outliers.hpp"

namespace dygita {

struct ScanOptions {
  std::string file;
  std::optional<double> unit, height_unit;  // SI of one unit of the file; none: as its titles say
  double smooth = 0.0;                      // m; 0: the distance between points
};

class Scan {
 public:
  // Three columns: two places and a height. Throws InputError with file and line, also where a place has two heights.
  explicit Scan(const ScanOptions& options);

  // m, of the plane that fits the points around best, weighted by exp(-(distance / smooth)^2). None farther than that
  // from all points.
  std::optional<double> at(double u, double v) const;

  const std::vector<ScanPoint>& points() const { return points_; }
  size_t n_points() const { return points_.size(); }
  double smooth() const { return smooth_; }
  const std::string& file() const { return file_; }

 private:
  void read(const ScanOptions& options);
  void settle_distance(double smooth);
  void sort_in();
  long long cell_of(double u, double v) const;
  template <class Visit>
  void around(double u, double v, Visit&& visit) const;

  std::string file_;
  std::vector<ScanPoint> points_;
  double smooth_ = 0.0, low_u_ = 0.0, low_v_ = 0.0, cell_ = 1.0;
  std::unordered_map<long long, std::vector<int>> cells_;
};

}  // namespace dygita
