#include "signal/scan.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "signal/text_table.hpp"

namespace dygita {

namespace {

constexpr double farthest = 3.0;  // of the smoothing length: what is farther weighs 1e-4 at most

// The height at the origin of the plane through weighted points (u, v, h) that fits best; where they lie on a line,
// their mean.
class Plane {
 public:
  void add(double u, double v, double h, double weight) {
    const double x[3] = {1.0, u, v};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) m_[i][j] += weight * x[i] * x[j];
      b_[i] += weight * x[i] * h;
    }
  }
  bool is_empty() const { return m_[0][0] == 0.0; }
  double height(double length) const {
    const double a = m_[1][1] - m_[0][1] * m_[0][1] / m_[0][0], b = m_[1][2] - m_[0][1] * m_[0][2] / m_[0][0],
                 c = m_[2][2] - m_[0][2] * m_[0][2] / m_[0][0];  // spread about the middle
    const double mean = b_[0] / m_[0][0], det = a * c - b * b;
    constexpr double narrow = 1e-6;
    if (!(det > narrow * std::pow(length * length * m_[0][0], 2))) return mean;
    const double p = b_[1] - m_[0][1] * mean, q = b_[2] - m_[0][2] * mean;
    return mean - ((c * p - b * q) * m_[0][1] + (a * q - b * p) * m_[0][2]) / (det * m_[0][0]);
  }

 private:
  double m_[3][3] = {}, b_[3] = {};
};

double factor_of(const TextTable& table, size_t i, const std::optional<double>& given, const char* word) {
  std::optional<Unit> stated;
  if (i < table.titles().size()) stated = unit_of(table.titles()[i], table.title_origin(), "m");
  if (given && stated && std::abs(*given / stated->factor - 1.0) > 1e-9)
    throw InputError(table.title_origin(), fmt::format("the title of column {} says {:g} m, and '{}' is {:g} m", i + 1,
                                                       stated->factor, word, *given));
  if (given) return *given;
  if (stated) return stated->factor;
  throw InputError(table.title_origin(),
                   fmt::format("column {} has no unit\n    {} = mm, or titles with units: x [mm], y [mm], height [um]",
                               i + 1, word));
}

}  // namespace

Scan::Scan(const ScanOptions& options) : file_(options.file) {
  read(options);
  settle_distance(options.smooth);
  sort_in();
}

void Scan::read(const ScanOptions& options) {
  TextTable table(options.file, "scan");
  if (!table.has_rows()) throw InputError(fmt::format("the scan '{}' has no numbers", options.file));
  if (table.n_columns() != 3)
    throw InputError(
        fmt::format("the scan '{}' has {} columns: they are two places and a height", options.file, table.n_columns()));
  const double factors[3] = {factor_of(table, 0, options.unit, "unit"), factor_of(table, 1, options.unit, "unit"),
                             factor_of(table, 2, options.height_unit, "height_unit")};
  for (TableRow row; table.next(row);) {
    Point point{};
    for (size_t i = 0; i < 3; ++i) {
      const auto value = i < row.cells.size() ? table.number(row.cells[i], row.origin) : std::nullopt;
      if (row.cells.size() != 3 || !value || !std::isfinite(*value))
        throw InputError(row.origin, fmt::format("'{}' is not two places and a height{}", row.text,
                                                 i < row.cells.size() ? doubt_of_number(row.cells[i]) : ""));
      point[i] = factors[i] * *value;
    }
    points_.push_back(point);
  }
}

void Scan::settle_distance(double smooth) {
  double low[2] = {points_[0][0], points_[0][1]}, high[2] = {low[0], low[1]};
  for (const Point& point : points_)
    for (size_t d = 0; d < 2; ++d) {
      low[d] = std::min(low[d], point[d]);
      high[d] = std::max(high[d], point[d]);
    }
  const double width = high[0] - low[0], height = high[1] - low[1];
  constexpr size_t least = 4;
  if (points_.size() < least || !(width * height > 0.0))
    throw InputError(fmt::format("the scan '{}' has {} points on {:g} x {:g} mm: four that span an area are needed",
                                 file_, points_.size(), 1e3 * width, 1e3 * height));
  // Of a grid of so many; its columns and rows are one fewer.
  smooth_ = smooth > 0.0 ? smooth : std::sqrt(width * height) / (std::sqrt(static_cast<double>(points_.size())) - 1.0);
  low_u_ = low[0], low_v_ = low[1];
  cell_ = std::max(farthest * smooth_, 1e-5 * std::max(width, height));
}

long long Scan::cell_of(double u, double v) const {
  constexpr long long row = 1LL << 31;
  return static_cast<long long>(std::floor((v - low_v_) / cell_)) * row +
         static_cast<long long>(std::floor((u - low_u_) / cell_));
}

void Scan::sort_in() {
  for (size_t i = 0; i < points_.size(); ++i)
    cells_[cell_of(points_[i][0], points_[i][1])].push_back(static_cast<int>(i));
}

template <class Visit>
void Scan::around(double u, double v, Visit&& visit) const {
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j) {
      const auto found = cells_.find(cell_of(u + i * cell_, v + j * cell_));
      if (found == cells_.end()) continue;
      for (const int k : found->second) visit(points_[static_cast<size_t>(k)]);
    }
}

std::optional<double> Scan::at(double u, double v) const {
  constexpr double far = 1e6;  // cells: no number of a cell beyond
  if (!(std::abs(u - low_u_) < far * cell_) || !(std::abs(v - low_v_) < far * cell_)) return {};
  Plane plane;
  double nearest = INFINITY;
  around(u, v, [&](const Point& point) {
    const double du = point[0] - u, dv = point[1] - v, distance2 = du * du + dv * dv;
    nearest = std::min(nearest, distance2);
    if (distance2 < farthest * farthest * smooth_ * smooth_)
      plane.add(du, dv, point[2], std::exp(-distance2 / (smooth_ * smooth_)));
  });
  if (plane.is_empty() || nearest > smooth_ * smooth_ * (1.0 + 1e-9)) return {};
  return plane.height(smooth_);
}

}  // namespace dygita
