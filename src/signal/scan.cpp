#include "signal/scan.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "signal/fitted_plane.hpp"
#include "signal/text_table.hpp"

namespace dygita {

namespace {

constexpr double farthest = 3.0;  // of the smoothing length: what is farther weighs 1e-4 at most

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
    double numbers[3] = {};
    for (size_t i = 0; i < 3; ++i) {
      const auto value = i < row.cells.size() ? table.number(row.cells[i], row.origin) : std::nullopt;
      if (row.cells.size() != 3 || !value || !std::isfinite(*value))
        throw InputError(row.origin, fmt::format("'{}' is not two places and a height{}", row.text,
                                                 i < row.cells.size() ? doubt_of_number(row.cells[i]) : ""));
      numbers[i] = factors[i] * *value;
    }
    points_.push_back({numbers[0], numbers[1], numbers[2], row.origin.line});
  }
  refuse_two_heights(points_, file_);
}

void Scan::settle_distance(double smooth) {
  double low[2] = {points_[0].u, points_[0].v}, high[2] = {low[0], low[1]};
  for (const ScanPoint& point : points_)
    for (const auto& [d, x] : {std::pair(0, point.u), std::pair(1, point.v)}) {
      low[d] = std::min(low[d], x);
      high[d] = std::max(high[d], x);
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
    cells_[cell_of(points_[i].u, points_[i].v)].push_back(static_cast<int>(i));
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
  FittedPlane plane;
  double nearest = INFINITY;
  around(u, v, [&](const ScanPoint& point) {
    const double du = point.u - u, dv = point.v - v, distance2 = du * du + dv * dv;
    nearest = std::min(nearest, distance2);
    if (distance2 < farthest * farthest * smooth_ * smooth_)
      plane.add(du, dv, point.height, std::exp(-distance2 / (smooth_ * smooth_)));
  });
  if (plane.is_empty() || nearest > smooth_ * smooth_ * (1.0 + 1e-9)) return {};
  return plane.height(smooth_);
}

}  // namespace dygita
