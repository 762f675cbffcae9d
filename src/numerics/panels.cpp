#include "numerics/panels.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "numerics/panel_choice.hpp"

namespace dygita {

using namespace panel;

namespace {

template <class T>
size_t tile_bytes(int n_columns) {
  return sizeof(T) * height * n_columns;
}

// f(entries, tile) for every tile, the first of the panel first.
template <class Function>
void for_each_tile(const View& view, Function&& f) {
  const std::byte* at = view.data;
  const Tile* tile = view.tiles;
  const auto run = [&](int n, auto zero) {
    using T = decltype(zero);
    for (int i = 0; i < n; ++i, ++tile, at += tile_bytes<T>(view.n_columns)) f(reinterpret_cast<const T*>(at), *tile);
  };
  run(view.count[full], 0.0);
  run(view.count[float_32], 0.0f);
  run(view.count[int_16], std::int16_t{0});
  run(view.count[int_8], std::int8_t{0});
}

}  // namespace

double panel_bytes(int n_rows, int n_columns) { return 8.0 * ((n_rows + height - 1) / height) * height * n_columns; }

Kind Panels::kind_of(double largest, double tolerance) const {
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

void Panels::forward(size_t i, double* y) const { panel_kernels().forward(view(panels_[i]), y); }
void Panels::backward(size_t i, double* y) const { panel_kernels().backward(view(panels_[i]), y); }
void Panels::forward(size_t i, double* y, int n) const { panel_kernels().forward_many(view(panels_[i]), y, n); }
void Panels::backward(size_t i, double* y, int n) const { panel_kernels().backward_many(view(panels_[i]), y, n); }
void Panels::multiply_symmetric(size_t i, const double* x, double* y) const {
  panel_kernels().multiply_double(view(panels_[i]), x, y);
}
void Panels::multiply_symmetric(size_t i, const float* x, double* y) const {
  panel_kernels().multiply_single(view(panels_[i]), x, y);
}

void Panels::unpack(size_t i_panel, double* values, int stride) const {
  const Panel& panel = panels_[i_panel];
  for (int c = 0; c < panel.n_columns; ++c) std::fill_n(values + static_cast<size_t>(c) * stride, panel.n_rows, 0.0);
  for_each_tile(view(panel), [&](const auto* entries, const Tile& tile) {
    const int n = std::min(height, panel.n_rows - tile.row);
    for (int c = 0; c < panel.n_columns; ++c)
      for (int i = 0; i < n; ++i)
        values[static_cast<size_t>(c) * stride + tile.row + i] =
            static_cast<double>(tile.scale) * static_cast<double>(entries[c * height + i]);
  });
}
}  // namespace dygita
