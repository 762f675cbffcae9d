// Substitutions with 8 or 16 right-hand sides side by side. Part of panel_arithmetic.hpp: the same rules hold.
#pragma once

#include "numerics/kernels/tile_loops.hpp"

namespace dygita::DYGITA_ISA {

namespace {

// With several right-hand sides a tile keeps the processor busy for so long that it does not look ahead by itself.
template <class T>
inline void fetch_ahead(const T* tile, int n) {
  const auto* next = reinterpret_cast<const char*>(tile + 2 * height * n);
  for (size_t i = 0; i < sizeof(T) * height * n; i += 64) __builtin_prefetch(next + i);
}

// A tile in double precision, scale included.
template <int columns, class T>
inline const double* decoded(const T* tile, float scale, double* buffer) {
  if constexpr (std::is_same_v<T, double>) return tile;
  for (int i = 0; i < columns * height; i += n_floats) {
    const Floats v = load_floats(tile + i);
    store(static_cast<double>(scale) * lower_half(v), buffer + i);
    store(static_cast<double>(scale) * upper_half(v), buffer + i + n_doubles);
  }
  return buffer;
}
template <int columns>
inline const double* decoded(const double* tile, float, double*) {
  return tile;
}

// Registers of right-hand sides, rows and columns that are worked on together: their sums fill half of the registers.
constexpr int side_by_side = 2, rows_together = 4;
constexpr int columns_together = n_bytes == 64 ? 8 : 4;

// rows - a x, both with `n` registers of right-hand sides a row.
template <int columns, int n>
inline void subtract_many(const double* a, const double* x, double* rows) {
  constexpr int stride = n * n_doubles;
  for (int v = 0; v < stride; v += side_by_side * n_doubles)
    for (int r = 0; r < height; r += rows_together) {
      Doubles sums[rows_together][side_by_side];
      for (int i = 0; i < rows_together; ++i)
        for (int s = 0; s < side_by_side && v + s * n_doubles < stride; ++s)
          sums[i][s] = load(rows + (r + i) * stride + v + s * n_doubles);
      for (int c = 0; c < columns; ++c)
        for (int s = 0; s < side_by_side && v + s * n_doubles < stride; ++s) {
          const Doubles at = load(x + c * stride + v + s * n_doubles);
          for (int i = 0; i < rows_together; ++i) sums[i][s] -= a[c * height + r + i] * at;
        }
      for (int i = 0; i < rows_together; ++i)
        for (int s = 0; s < side_by_side && v + s * n_doubles < stride; ++s)
          store(sums[i][s], rows + (r + i) * stride + v + s * n_doubles);
    }
}

template <int columns, int n>
inline void forward_panel_many(const View& view, double* y) {
  constexpr int stride = n * n_doubles;
  alignas(64) double buffer[panel::width * height], x[columns * stride];
  with_first(view, [&](const auto* entries) {
    const double* a = decoded<columns>(entries, 1.0f, buffer);
    for (int c = 0; c < columns; ++c)
      for (int v = 0; v < stride; v += n_doubles) {
        Doubles at = load(y + c * stride + v);
        for (int k = 0; k < c; ++k) at -= a[k * height + c] * load(x + k * stride + v);
        store(at * a[c * height + c], x + c * stride + v);
      }
    subtract_many<columns, n>(a, x, y);
  });
  std::memcpy(y, x, sizeof(x));
  for_each_below<columns>(view, [&](const auto* entries, const Tile& tile) {
    fetch_ahead(entries, columns);
    subtract_many<columns, n>(decoded<columns>(entries, tile.scale, buffer), x,
                              y + static_cast<size_t>(tile.row) * stride);
  });
}

// sums[c] + a(from.., c) . rows, with `n` registers of right-hand sides a row.
template <int columns, int n>
inline void add_transposed_many(const double* a, int from, const double* rows, double* sums) {
  constexpr int stride = n * n_doubles;
  for (int v = 0; v < stride; v += side_by_side * n_doubles)
    for (int first = 0; first < columns; first += columns_together) {
      Doubles own[columns_together][side_by_side] = {};
      for (int r = from; r < height; ++r)
        for (int s = 0; s < side_by_side && v + s * n_doubles < stride; ++s) {
          const Doubles here = load(rows + r * stride + v + s * n_doubles);
          for (int c = 0; c < columns_together && first + c < columns; ++c)
            own[c][s] += a[(first + c) * height + r] * here;
        }
      for (int c = 0; c < columns_together && first + c < columns; ++c)
        for (int s = 0; s < side_by_side && v + s * n_doubles < stride; ++s) {
          double* to = sums + (first + c) * stride + v + s * n_doubles;
          store(load(to) + own[c][s], to);
        }
    }
}

template <int columns, int n>
inline void backward_panel_many(const View& view, double* y) {
  constexpr int stride = n * n_doubles;
  alignas(64) double buffer[panel::width * height], sums[columns * stride] = {};
  for_each_below<columns>(view, [&](const auto* entries, const Tile& tile) {
    fetch_ahead(entries, columns);
    add_transposed_many<columns, n>(decoded<columns>(entries, tile.scale, buffer), 0,
                                    y + static_cast<size_t>(tile.row) * stride, sums);
  });
  with_first(view, [&](const auto* entries) {
    const double* a = decoded<columns>(entries, 1.0f, buffer);
    add_transposed_many<columns, n>(a, columns, y, sums);
    for (int c = columns; c-- > 0;)
      for (int v = 0; v < stride; v += n_doubles) {
        Doubles x = load(y + c * stride + v) - load(sums + c * stride + v);
        for (int r = c + 1; r < columns; ++r) x -= a[c * height + r] * load(y + r * stride + v);
        store(a[c * height + c] * x, y + c * stride + v);
      }
  });
}

}  // namespace

}  // namespace dygita::DYGITA_ISA
