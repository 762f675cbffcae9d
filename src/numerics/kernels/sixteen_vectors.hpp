// Substitutions and products with sixteen right-hand sides side by side, whose long sums alone are in double precision
// where panels are stored in single. Part of panel_arithmetic.hpp: the same rules hold.
#pragma once

#include "numerics/kernels/many_vectors.hpp"

namespace dygita::DYGITA_ISA {

namespace {

constexpr int sixteen = panel::together;

// The entries of a tile in single precision, scale included.
template <int columns, class T>
inline const float* floats_of(const T* tile, float scale, float* buffer) {
  if constexpr (std::is_same_v<T, float>) {
    return tile;
  } else {
    for (int i = 0; i < columns * height; i += n_floats) {
      const Floats v = scale * load_floats(tile + i);
      std::memcpy(buffer + i, &v, sizeof(v));
    }
    return buffer;
  }
}

// Sums in single precision go into those in double.
inline void move_sums(float* from, int n, double* to) {
  for (int i = 0; i < n; i += n_floats) add(read<Floats>(from + i), to + i);
  std::memset(from, 0, sizeof(float) * static_cast<size_t>(n));
}

// y + a x of the rows of a tile, and sums + a(first.., c) . rows of its columns, whichever is asked for. V: registers
// of numbers T.
template <class V, int columns, bool has_product, bool has_sums, class T>
inline void add_both(const T* a, int first, const T* x, const T* rows, T* y, T* sums) {
  constexpr int n = sizeof(V) / sizeof(T);
  for (int v = 0; v < sixteen; v += n) {
    V at[columns] = {}, own[columns] = {};
    for (int c = 0; c < columns; ++c) {
      if (has_product) at[c] = read<V>(x + c * sixteen + v);
      if (has_sums) own[c] = read<V>(sums + c * sixteen + v);
    }
    for (int r = 0; r < height; ++r) {
      if (has_product) {
        V even = read<V>(y + r * sixteen + v), odd{};
        for (int c = 0; c < columns; ++c) (c % 2 == 0 ? even : odd) += a[c * height + r] * at[c];
        even += odd;
        std::memcpy(y + r * sixteen + v, &even, sizeof(even));
      }
      if (has_sums && r >= first) {
        const V here = read<V>(rows + r * sixteen + v);
        for (int c = 0; c < columns; ++c) own[c] += a[c * height + r] * here;
      }
    }
    for (int c = 0; c < columns && has_sums; ++c) std::memcpy(sums + c * sixteen + v, &own[c], sizeof(own[c]));
  }
}

// below: what is to be added to y, in single precision.
template <int columns>
inline void forward_panel_sixteen(const View& view, double* y, float* below) {
  alignas(64) double buffer[panel::width * height], x[columns * sixteen];
  alignas(64) float entries_of_tile[panel::width * height], minus_x[columns * sixteen];
  move_sums(below, columns * sixteen, y);
  with_first(view, [&](const auto* entries) {
    const double* a = decoded<columns>(entries, 1.0f, buffer);
    for (int c = 0; c < columns; ++c)
      for (int v = 0; v < sixteen; v += n_doubles) {
        Doubles at = load(y + c * sixteen + v);
        for (int k = 0; k < c; ++k) at -= a[k * height + c] * load(x + k * sixteen + v);
        store(at * a[c * height + c], x + c * sixteen + v);
      }
    subtract_many<columns, sixteen / n_doubles>(a, x, y);
  });
  std::memcpy(y, x, sizeof(x));
  for (int i = 0; i < columns * sixteen; ++i) minus_x[i] = static_cast<float>(-x[i]);
  for_each_below<columns>(view, [&](const auto* entries, const Tile& tile) {
    if constexpr (!std::is_same_v<decltype(entries), const double*>) {
      fetch_ahead(entries, columns);
      add_both<Floats, columns, true, false, float>(floats_of<columns>(entries, tile.scale, entries_of_tile), 0,
                                                    minus_x, nullptr, below + static_cast<size_t>(tile.row) * sixteen,
                                                    nullptr);
    }
  });
}

// rows: y in single precision.
template <int columns>
inline void backward_panel_sixteen(const View& view, double* y, float* rows) {
  alignas(64) double buffer[panel::width * height], sums[columns * sixteen] = {};
  alignas(64) float entries_of_tile[panel::width * height], own[columns * sixteen] = {};
  int n_summed = 0;
  for_each_below<columns>(view, [&](const auto* entries, const Tile& tile) {
    if constexpr (!std::is_same_v<decltype(entries), const double*>) {
      fetch_ahead(entries, columns);
      add_both<Floats, columns, false, true, float>(floats_of<columns>(entries, tile.scale, entries_of_tile), 0,
                                                    nullptr, rows + static_cast<size_t>(tile.row) * sixteen, nullptr,
                                                    own);
      if (++n_summed % most_summed == 0) move_sums(own, columns * sixteen, sums);
    }
  });
  move_sums(own, columns * sixteen, sums);
  with_first(view, [&](const auto* entries) {
    const double* a = decoded<columns>(entries, 1.0f, buffer);
    add_transposed_many<columns, sixteen / n_doubles>(a, columns, y, sums);
    for (int c = columns; c-- > 0;)
      for (int v = 0; v < sixteen; v += n_doubles) {
        Doubles x = load(y + c * sixteen + v) - load(sums + c * sixteen + v);
        for (int r = c + 1; r < columns; ++r) x -= a[c * height + r] * load(y + r * sixteen + v);
        store(a[c * height + c] * x, y + c * sixteen + v);
      }
  });
  for (int i = 0; i < columns * sixteen; ++i) rows[i] = static_cast<float>(y[i]);
}

// below: what is to be added to y beside the sums of the columns, in single precision.
template <int columns>
inline void multiply_panel_sixteen(const View& view, const float* x, float* below, double* y) {
  alignas(64) float entries_of_tile[panel::width * height], own[columns * sixteen] = {};
  int n_summed = 0;
  const auto take = [&](const auto* entries, const Tile& tile, int first) {
    if constexpr (!std::is_same_v<decltype(entries), const double*>) {
      fetch_ahead(entries, columns);
      const size_t at = static_cast<size_t>(tile.row) * sixteen;
      add_both<Floats, columns, true, true, float>(floats_of<columns>(entries, tile.scale, entries_of_tile), first, x,
                                                   x + at, below + at, own);
      if (++n_summed % most_summed == 0) move_sums(own, columns * sixteen, y);
    }
  };
  with_first(view, [&](const auto* entries) { take(entries, Tile{0, 1.0f}, columns); });
  for_each_below<columns>(view, [&](const auto* entries, const Tile& tile) { take(entries, tile, 0); });
  move_sums(own, columns * sixteen, y);
}

template <int columns>
inline void multiply_panel_sixteen(const View& view, const double* x, double* y) {
  alignas(64) double sums[columns * sixteen] = {};
  const auto take = [&](const auto* entries, const Tile& tile, int first) {
    if constexpr (std::is_same_v<decltype(entries), const double*>) {
      fetch_ahead(entries, columns);
      const size_t at = static_cast<size_t>(tile.row) * sixteen;
      add_both<Doubles, columns, true, true, double>(entries, first, x, x + at, y + at, sums);
    }
  };
  with_first(view, [&](const auto* entries) { take(entries, Tile{0, 1.0f}, columns); });
  for_each_below<columns>(view, [&](const auto* entries, const Tile& tile) { take(entries, tile, 0); });
  for (int i = 0; i < columns * sixteen; i += n_doubles) store(load(y + i) + load(sums + i), y + i);
}

}  // namespace

}  // namespace dygita::DYGITA_ISA
