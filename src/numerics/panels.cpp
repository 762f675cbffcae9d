#include "numerics/panels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/panel_tiles.hpp"

namespace dygita {

double panel_bytes(int n_rows, int n_columns) {
  return 8.0 * ((n_rows + Panels::height - 1) / Panels::height) * Panels::height * n_columns;
}

Panels::Kind Panels::kind_of(double largest, double tolerance) const {
  if (precision_ == Precision::double_precision) return full;
  if (largest <= 254.0 * tolerance) return int_8;  // the error of an integer is half a unit, of 127 or 32767
  if (largest <= 65534.0 * tolerance) return int_16;
  return float_32;
}

void Panels::add(const double* values, int stride, int n_rows, int n_columns, const double* tolerance) {
  const bool is_double = precision_ == Precision::double_precision;
  struct Planned {
    Tile tile;
    Kind kind;
  };
  std::vector<Planned> planned;
  for (int row = 0; row < n_rows; row += height) {
    const int end = std::min(row + height, n_rows);
    double largest = 0.0, allowed = std::numeric_limits<double>::infinity();
    for (int c = 0; c < n_columns; ++c)
      for (int i = row; i < end; ++i)
        largest = std::max(largest, std::abs(values[static_cast<size_t>(c) * stride + i]));
    for (int i = row; i < end && tolerance; ++i) allowed = std::min(allowed, tolerance[i]);
    if (row > 0 && largest <= (is_double ? 0.0 : allowed)) continue;
    const Kind kind = row == 0 ? (is_double ? full : float_32) : kind_of(largest, allowed);
    const double most = kind == int_8 ? 127.0 : 32767.0;
    planned.push_back({{row, kind == int_8 || kind == int_16 ? static_cast<float>(largest / most) : 1.0f}, kind});
  }
  std::stable_sort(planned.begin() + 1, planned.end(),
                   [](const Planned& a, const Planned& b) { return a.kind < b.kind; });

  Panel panel{data_.size(), tiles_.size(), n_rows, n_columns, {}};
  const auto write = [&](const Tile& tile, auto zero) {
    using T = decltype(zero);
    const size_t start = data_.size();
    data_.resize(start + tile_bytes<T>(n_columns));
    std::vector<T> entries(static_cast<size_t>(height) * n_columns, T(0));
    const double inverse = tile.scale > 0.0f ? 1.0 / static_cast<double>(tile.scale) : 0.0;
    for (int c = 0; c < n_columns; ++c)
      for (int i = tile.row; i < std::min(tile.row + height, n_rows); ++i) {
        const double value = values[static_cast<size_t>(c) * stride + i];
        entries[static_cast<size_t>(c) * height + i - tile.row] =
            std::is_integral_v<T> ? static_cast<T>(std::lround(
                                        std::clamp(value * inverse, -static_cast<double>(std::numeric_limits<T>::max()),
                                                   static_cast<double>(std::numeric_limits<T>::max()))))
                                  : static_cast<T>(value);
      }
    std::memcpy(data_.data() + start, entries.data(), entries.size() * sizeof(T));
  };
  for (const Planned& p : planned) {
    ++panel.count[p.kind];
    tiles_.push_back(p.tile);
    switch (p.kind) {
      case full:
        write(p.tile, 0.0);
        break;
      case float_32:
        write(p.tile, 0.0f);
        break;
      case int_16:
        write(p.tile, std::int16_t{0});
        break;
      default:
        write(p.tile, std::int8_t{0});
        break;
    }
  }
  panels_.push_back(panel);
}

void Panels::shrink() {
  data_.shrink_to_fit();
  tiles_.shrink_to_fit();
  panels_.shrink_to_fit();
}

double Panels::bytes() const {
  return static_cast<double>(data_.size() + tiles_.size() * sizeof(Tile) + panels_.size() * sizeof(Panel));
}

void Panels::forward(size_t i_panel, double* y) const {
  const Panel& panel = panels_[i_panel];
  with_width(panel.n_columns, [&](auto n) {
    constexpr int columns = n;
    double x[columns];
    float x_single[columns];
    for_each_tile(panel, [&](const auto* entries, const Tile& tile) {
      if (tile.row > 0) {
        if constexpr (std::is_same_v<decltype(entries), const double*>)
          return subtract_product<columns>(entries, 1.0, x, y + tile.row);
        else
          return subtract_product<columns>(entries, tile.scale, x_single, y + tile.row);
      }
      for (int c = 0; c < columns; ++c) x[c] = y[c];
      for (int c = 0; c < columns; ++c) {
        x[c] *= static_cast<double>(entries[c * height + c]);
        for (int r = c + 1; r < columns; ++r) x[r] -= static_cast<double>(entries[c * height + r]) * x[c];
      }
      subtract_product<columns>(entries, 1.0, x, y);
      for (int c = 0; c < columns; ++c) y[c] = x[c];
      for (int c = 0; c < columns; ++c) x_single[c] = static_cast<float>(x[c]);
    });
  });
}

void Panels::backward(size_t i_panel, double* y) const {
  const Panel& panel = panels_[i_panel];
  with_width(panel.n_columns, [&](auto n) {
    constexpr int columns = n;
    Lanes sums[columns] = {};
    WideLanes sums_single[columns] = {};
    double total[columns] = {};
    int n_summed = 0;
    const auto flush = [&] {
      for (int c = 0; c < columns; ++c) {
        total[c] += sum(sums_single[c]);
        sums_single[c] = WideLanes{};
      }
      n_summed = 0;
    };
    const double* triangle_double = nullptr;
    const float* triangle_float = nullptr;
    for_each_tile(panel, [&](const auto* entries, const Tile& tile) {
      if (tile.row > 0) {
        if constexpr (std::is_same_v<decltype(entries), const double*>) {
          add_transposed<columns>(entries, 1.0, y + tile.row, sums);
        } else {
          add_transposed<columns>(entries, tile.scale, y + tile.row, sums_single);
          if (++n_summed == most_summed) flush();
        }
        return;
      }
      if constexpr (std::is_same_v<decltype(entries), const double*>) triangle_double = entries;
      if constexpr (std::is_same_v<decltype(entries), const float*>) triangle_float = entries;
    });
    if (triangle_float) flush();
    const auto solve = [&](const auto* triangle) {
      double x[columns];
      for (int c = 0; c < columns; ++c) {
        x[c] = y[c] - (sum(sums[c]) + total[c]);
        for (int r = columns; r < height; ++r) x[c] -= static_cast<double>(triangle[c * height + r]) * y[r];
      }
      for (int c = columns; c-- > 0;) {
        for (int r = c + 1; r < columns; ++r) x[c] -= static_cast<double>(triangle[c * height + r]) * x[r];
        x[c] *= static_cast<double>(triangle[c * height + c]);
      }
      for (int c = 0; c < columns; ++c) y[c] = x[c];
    };
    if (triangle_double)
      solve(triangle_double);
    else
      solve(triangle_float);
  });
}

namespace {

// The first tile of a symmetric panel: rows of the square on the diagonal count once, those below it twice.
template <int columns, class T, class X>
void add_first(const T* tile, const X* at, const X* x, double* y) {
  for (int c = 0; c < columns; ++c)
    for (int r = 0; r < Panels::height; ++r) {
      const double a = static_cast<double>(tile[c * Panels::height + r]);
      y[r] += a * at[c];
      if (r >= columns) y[c] += a * x[r];
    }
}

}  // namespace

void Panels::multiply_symmetric(size_t i_panel, const double* x, double* y) const {
  const Panel& panel = panels_[i_panel];
  with_width(panel.n_columns, [&](auto n) {
    constexpr int columns = n;
    double at[columns];
    for (int c = 0; c < columns; ++c) at[c] = x[c];
    Lanes sums[columns] = {};
    for_each_tile(panel, [&](const auto* entries, const Tile& tile) {
      if (tile.row > 0) return add_both<columns>(entries, tile.scale, at, x + tile.row, y + tile.row, sums);
      add_first<columns>(entries, at, x, y);
    });
    for (int c = 0; c < columns; ++c) y[c] += sum(sums[c]);
  });
}

void Panels::multiply_symmetric(size_t i_panel, const float* x, double* y) const {
  const Panel& panel = panels_[i_panel];
  with_width(panel.n_columns, [&](auto n) {
    constexpr int columns = n;
    float at[columns];
    double total[columns] = {};
    for (int c = 0; c < columns; ++c) at[c] = x[c];
    WideLanes sums[columns] = {};
    int n_summed = 0;
    const auto flush = [&] {
      for (int c = 0; c < columns; ++c) {
        total[c] += sum(sums[c]);
        sums[c] = WideLanes{};
      }
      n_summed = 0;
    };
    for_each_tile(panel, [&](const auto* entries, const Tile& tile) {
      using T = std::remove_cvref_t<decltype(*entries)>;
      if constexpr (!std::is_same_v<T, double>) {
        if (tile.row > 0) {
          add_both<columns>(entries, tile.scale, at, x + tile.row, y + tile.row, sums);
          if (++n_summed == most_summed) flush();
          return;
        }
        add_first<columns>(entries, at, x, y);
      }
    });
    flush();
    for (int c = 0; c < columns; ++c) y[c] += total[c];
  });
}

void Panels::unpack(size_t i_panel, double* values, int stride) const {
  const Panel& panel = panels_[i_panel];
  for (int c = 0; c < panel.n_columns; ++c) std::fill_n(values + static_cast<size_t>(c) * stride, panel.n_rows, 0.0);
  for_each_tile(panel, [&](const auto* entries, const Tile& tile) {
    const int n = std::min(height, panel.n_rows - tile.row);
    for (int c = 0; c < panel.n_columns; ++c)
      for (int i = 0; i < n; ++i)
        values[static_cast<size_t>(c) * stride + tile.row + i] =
            static_cast<double>(tile.scale) * static_cast<double>(entries[c * height + i]);
  });
}
}  // namespace dygita
