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

namespace {

// A tile of a panel, by columns of `height` entries; rows that the panel lacks are zero.
struct TileEntries {
  double value[width * height];
  double largest = 0.0;

  TileEntries(const double* top, const double* values, int stride, int row, int end, int n_columns) {
    double most[height] = {};
    for (int c = 0; c < n_columns; ++c) {
      double* column = value + static_cast<ptrdiff_t>(c) * height;
      const double* from = values + static_cast<size_t>(c) * stride + row;
      if (end - row == height) {
        std::copy_n(from, height, column);
      } else {
        std::fill_n(column, height, 0.0);
        std::copy_n(from, end - row, column);
      }
      if (row == 0) std::copy_n(top + static_cast<ptrdiff_t>(c) * n_columns, n_columns, column);
      for (int i = 0; i < height; ++i) most[i] = std::max(most[i], std::abs(column[i]));
    }
    largest = *std::max_element(most, most + height);
  }
};

template <class T>
void write_tile(const TileEntries& tile, double scale, int n_columns, std::byte* to) {
  T entries[width * height];
  const double inverse = scale > 0.0 ? 1.0 / scale : 0.0;
  constexpr double most = std::is_integral_v<T> ? static_cast<double>(std::numeric_limits<T>::max()) : 0.0;
  for (int i = 0; i < n_columns * height; ++i)
    entries[i] = std::is_integral_v<T> ? static_cast<T>(std::lround(std::clamp(tile.value[i] * inverse, -most, most)))
                                       : static_cast<T>(tile.value[i]);
  std::memcpy(to, entries, tile_bytes<T>(n_columns));
}

}  // namespace

std::byte* Chunks::room(size_t n) {
  constexpr size_t smallest = size_t{1} << 16, largest = size_t{1} << 25;
  if (chunks_.empty() || used_ + n > capacity_) {
    capacity_ = std::max(n, std::clamp(taken_, smallest, largest));
    chunks_.emplace_back(capacity_);
    used_ = 0;
  }
  return chunks_.back().data() + used_;
}

void Chunks::clear() {
  // What comes next is seldom of the very same size, and memory that is not reached costs nothing.
  if (chunks_.size() > 1) {
    chunks_.clear();
    capacity_ = taken_ + taken_ / 8;
    chunks_.emplace_back(capacity_);
  }
  used_ = taken_ = 0;
}

void Panels::clear() {
  panels_.clear();
  tiles_.clear();
  data_.clear();
}

void Panels::add(const double* top, const double* values, int stride, int n_rows, int n_columns,
                 const double* tolerance) {
  const bool is_double = precision_ == Precision::double_precision;
  Panel panel{nullptr, tiles_.size(), n_rows, n_columns, {}};
  const size_t n_tiles = (n_rows + height - 1) / height;
  std::byte* to = data_.room(n_tiles * (is_double ? tile_bytes<double>(n_columns) : tile_bytes<float>(n_columns)));
  panel.data = to;
  const auto read = [&](int row) {
    return TileEntries(top, values, stride, row, std::min(row + height, n_rows), n_columns);
  };
  const auto put = [&](const Tile& tile, Kind kind, auto zero, const TileEntries& entries) {
    using T = decltype(zero);
    write_tile<T>(entries, tile.scale, n_columns, to);
    to += tile_bytes<T>(n_columns);
    ++panel.count[kind];
    tiles_.push_back(tile);
  };
  if (is_double) {
    for (int row = 0; row < n_rows; row += height)
      if (const TileEntries entries = read(row); row == 0 || entries.largest > 0.0)
        put({row, 1.0f}, full, 0.0, entries);
  } else {
    struct Planned {
      Tile tile;
      Kind kind;
    };
    std::vector<Planned> planned;
    for (int row = 0; row < n_rows; row += height) {
      const double largest = read(row).largest;
      double allowed = std::numeric_limits<double>::infinity();
      for (int i = row; i < std::min(row + height, n_rows) && tolerance; ++i) allowed = std::min(allowed, tolerance[i]);
      if (row > 0 && largest <= allowed) continue;
      const Kind kind = row == 0 ? float_32 : kind_of(largest, allowed);
      const double most = kind == int_8 ? 127.0 : 32767.0;
      planned.push_back({{row, kind == int_8 || kind == int_16 ? static_cast<float>(largest / most) : 1.0f}, kind});
    }
    std::stable_sort(planned.begin() + 1, planned.end(),
                     [](const Planned& a, const Planned& b) { return a.kind < b.kind; });
    for (const Planned& p : planned) {
      const TileEntries entries = read(p.tile.row);
      if (p.kind == float_32) put(p.tile, p.kind, 0.0f, entries);
      if (p.kind == int_16) put(p.tile, p.kind, std::int16_t{0}, entries);
      if (p.kind == int_8) put(p.tile, p.kind, std::int8_t{0}, entries);
    }
  }
  data_.take(static_cast<size_t>(to - panel.data));
  panels_.push_back(panel);
}

double Panels::bytes() const {
  return static_cast<double>(data_.size() + tiles_.size() * sizeof(Tile) + panels_.size() * sizeof(Panel));
}

void Panels::forward(size_t i, double* y) const { panel_kernels().forward(view(panels_[i]), y); }
void Panels::backward(size_t i, size_t next, double* y) const {
  View read = view(panels_[i]);
  read.next = panels_[next].data;
  panel_kernels().backward(read, y);
}
void Panels::forward(size_t i, double* y, int n) const { panel_kernels().forward_many(view(panels_[i]), y, n); }
void Panels::backward(size_t i, double* y, int n) const { panel_kernels().backward_many(view(panels_[i]), y, n); }
void Panels::multiply_symmetric(size_t i, const double* x, double* y) const {
  panel_kernels().multiply_double(view(panels_[i]), x, y);
}
void Panels::multiply_symmetric(size_t i, const float* x, double* y) const {
  panel_kernels().multiply_single(view(panels_[i]), x, y);
}

void Panels::forward(size_t i, double* y, float* below) const {
  panel_kernels().forward_sixteen(view(panels_[i]), y, below);
}
void Panels::backward(size_t i, double* y, float* rows) const {
  panel_kernels().backward_sixteen(view(panels_[i]), y, rows);
}
void Panels::multiply_together(size_t i, const double* x, double* y) const {
  panel_kernels().multiply_double_sixteen(view(panels_[i]), x, y);
}
void Panels::multiply_together(size_t i, const float* x, float* below, double* y) const {
  panel_kernels().multiply_single_sixteen(view(panels_[i]), x, below, y);
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
