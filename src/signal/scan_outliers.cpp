#include "signal/scan_outliers.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "base/error.hpp"
#include "signal/fitted_plane.hpp"

namespace dygita {

namespace {

constexpr size_t n_around = 8;

// The nearest of many points in a plane: a tree that halves them along u and v by turns.
class NearestPoints {
 public:
  struct Near {
    double distance2 = std::numeric_limits<double>::infinity();
    size_t point = 0;
  };
  using Nearest = std::array<Near, n_around>;  // the nearest first

  explicit NearestPoints(const std::vector<ScanPoint>& points) : points_(points), order_(points.size()) {
    std::iota(order_.begin(), order_.end(), size_t{0});
    halve(0, order_.size(), 0);
  }
  // Of others than itself.
  Nearest around(size_t point) const {
    Nearest nearest;
    search(0, order_.size(), 0, point, nearest);
    return nearest;
  }

 private:
  double at(size_t point, int axis) const { return axis == 0 ? points_[point].u : points_[point].v; }
  void halve(size_t begin, size_t end, int axis) {
    if (end - begin < 2) return;
    const size_t middle = begin + (end - begin) / 2;
    const auto it = order_.begin();
    std::nth_element(it + static_cast<long>(begin), it + static_cast<long>(middle), it + static_cast<long>(end),
                     [&](size_t a, size_t b) { return std::pair(at(a, axis), a) < std::pair(at(b, axis), b); });
    halve(begin, middle, 1 - axis);
    halve(middle + 1, end, 1 - axis);
  }
  void search(size_t begin, size_t end, int axis, size_t of, Nearest& nearest) const {
    if (begin == end) return;
    const size_t middle = begin + (end - begin) / 2, point = order_[middle];
    const double du = at(point, 0) - at(of, 0), dv = at(point, 1) - at(of, 1);
    if (point != of) take({du * du + dv * dv, point}, nearest);
    const double side = at(of, axis) - at(point, axis);
    const auto half = [&](bool is_low) {
      is_low ? search(begin, middle, 1 - axis, of, nearest) : search(middle + 1, end, 1 - axis, of, nearest);
    };
    half(side < 0.0);
    if (side * side <= nearest.back().distance2) half(!(side < 0.0));
  }
  static void take(Near one, Nearest& nearest) {
    for (Near& near : nearest)
      if (std::pair(one.distance2, one.point) < std::pair(near.distance2, near.point)) std::swap(one, near);
  }

  const std::vector<ScanPoint>& points_;
  std::vector<size_t> order_;
};

// The least that two heights differ by, of many: what the file's digits tell apart. A flat face with a few wrong
// heights says nothing of them.
double least_difference(const std::vector<ScanPoint>& points) {
  std::vector<double> heights;
  for (const ScanPoint& point : points) heights.push_back(point.height);
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  constexpr size_t many = 5;
  if (heights.size() < many) return 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 1; i < heights.size(); ++i) least = std::min(least, heights[i] - heights[i - 1]);
  return least;
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<long>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

void refuse_two_heights(const std::vector<ScanPoint>& points, const std::string& file) {
  std::vector<const ScanPoint*> sorted;
  for (const ScanPoint& point : points) sorted.push_back(&point);
  std::sort(sorted.begin(), sorted.end(), [](const ScanPoint* a, const ScanPoint* b) {
    return std::tuple(a->u, a->v, a->line) < std::tuple(b->u, b->v, b->line);
  });
  const ScanPoint *first = nullptr, *second = nullptr;  // those of the lowest line
  for (size_t i = 1; i < sorted.size(); ++i) {
    const ScanPoint &a = *sorted[i - 1], &b = *sorted[i];
    if (a.u == b.u && a.v == b.v && a.height != b.height && (!second || b.line < second->line)) first = &a, second = &b;
  }
  if (second)
    throw InputError(
        {file, second->line},
        fmt::format("the height at ({:.6g}, {:.6g}) mm is {:.6g} um here and {:.6g} um in line {}\n    keep "
                    "one line for each place, or their mean",
                    1e3 * second->u, 1e3 * second->v, 1e6 * second->height, 1e6 * first->height, first->line));
}

std::vector<ScanOutlier> outliers_of(const std::vector<ScanPoint>& points) {
  constexpr double of_all = 8.0, of_neighbours = 3.0, least = 4.0, normal = 1.4826;  // median of a normal scatter
  if (points.size() <= 2 * n_around) return {};
  const NearestPoints nearest(points);
  std::vector<double> off(points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    const NearestPoints::Nearest around = nearest.around(i);
    FittedPlane plane;
    for (const NearestPoints::Near& near : around) {
      const ScanPoint& other = points[near.point];
      plane.add(other.u - points[i].u, other.v - points[i].v, other.height - points[i].height, 1.0);
    }
    off[i] = std::abs(plane.height(std::sqrt(around.back().distance2)));
  }
  const double scatter = std::max(of_all * normal * median_of(off), least * least_difference(points));
  std::vector<ScanOutlier> outliers;
  for (size_t i = 0; i < points.size(); ++i) {
    if (!(off[i] > scatter)) continue;
    const NearestPoints::Nearest around = nearest.around(i);
    std::array<double, n_around> of{};
    std::transform(around.begin(), around.end(), of.begin(), [&](const auto& near) { return off[near.point]; });
    std::nth_element(of.begin(), of.begin() + 2, of.end(), std::greater<>());
    if (off[i] > of_neighbours * of[2]) outliers.push_back({&points[i], off[i], of[2]});
  }
  std::sort(outliers.begin(), outliers.end(), [](const ScanOutlier& a, const ScanOutlier& b) {
    return std::pair(-a.off, a.point->line) < std::pair(-b.off, b.point->line);
  });
  return outliers;
}

std::string doubt_of_outliers(const std::vector<ScanPoint>& points) {
  constexpr size_t most = 8;
  const std::vector<ScanOutlier> outliers = outliers_of(points);
  if (outliers.empty()) return "";
  const auto& [point, off, scatter] = outliers.front();
  std::string others;
  for (size_t i = 1; i < std::min(most, outliers.size()); ++i)
    others += fmt::format("{}{} ({:.3g} um)", i == 1 ? "; likewise of lines " : ", ", outliers[i].point->line,
                          1e6 * outliers[i].off);
  if (outliers.size() > most) others += fmt::format(" and {} more", outliers.size() - most);
  return fmt::format(
      "the height in line {}, {:.6g} um at ({:.6g}, {:.6g}) mm, is {:.3g} um off the plane through the eight points "
      "around it, which are {:.3g} um off theirs{}: measured wrongly? it is used as it stands; take the line out of "
      "the "
      "file, or smooth = over more than one distance between points",
      point->line, 1e6 * point->height, 1e3 * point->u, 1e3 * point->v, 1e6 * off, 1e6 * scatter, others);
}

}  // namespace dygita
