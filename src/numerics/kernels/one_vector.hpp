// Substitutions and products with one vector. Part of panel_arithmetic.hpp: the same rules hold.
#pragma once

#include "numerics/kernels/tile_loops.hpp"

namespace dygita::DYGITA_ISA {

namespace {

// y - tile x.
template <int n, class T>
inline void subtract_product(const T* tile, const double* x, double* y) {
  for (int h = 0; h < height; h += n_doubles) {
    Doubles product{};
    for (int c = 0; c < n; ++c) product += load(tile + c * height + h) * x[c];
    store(load(y + h) - product, y + h);
  }
}

// y + scale tile x; the tile's own sums, of up to 8 products, in single precision.
template <int n, class T>
inline void add_product(const T* tile, float scale, const float* x, double* y) {
  for (int h = 0; h < height; h += n_floats) {
    Floats even{}, odd{};
    for (int c = 0; c < n; ++c) (c % 2 == 0 ? even : odd) += load_floats(tile + c * height + h) * x[c];
    add(scale * (even + odd), y + h);
  }
}

template <int columns>
inline void forward_panel(const View& view, double* y) {
  double x[columns];
  with_first(view, [&](const auto* entries) {
    for (int c = 0; c < columns; ++c) x[c] = y[c];
    for (int c = 0; c < columns; ++c) {
      x[c] *= static_cast<double>(entries[c * height + c]);
      for (int r = c + 1; r < columns; ++r) x[r] -= static_cast<double>(entries[c * height + r]) * x[c];
    }
    subtract_product<columns>(entries, x, y);
  });
  float minus_x[columns];
  for (int c = 0; c < columns; ++c) {
    y[c] = x[c];
    minus_x[c] = static_cast<float>(-x[c]);
  }
  for_each_below<columns>(view, [&](const auto* entries, const Tile& tile) {
    if constexpr (std::is_same_v<decltype(entries), const double*>)
      subtract_product<columns>(entries, x, y + tile.row);
    else
      add_product<columns>(entries, tile.scale, minus_x, y + tile.row);
  });
}

// Sums over tiles of a column each: in single precision over 16 tiles at most, in double beyond.
template <int columns>
struct ColumnSums {
  Doubles doubles[columns] = {};
  Floats floats[columns] = {};
  double total[columns] = {};
  int n_summed = 0;

  void flush() {
    for (int c = 0; c < columns; ++c) {
      total[c] += sum(floats[c]);
      floats[c] = Floats{};
    }
    n_summed = 0;
  }
  void count() {
    if (++n_summed == most_summed) flush();
  }
  void finish() {
    if (n_summed > 0) flush();
    for (int c = 0; c < columns; ++c) total[c] += sum(doubles[c]);
  }
};

// Asks for as much of the panel that comes next as a tile takes: panels come from the last to the first here, each from
// its start, which no processor takes for one stream. Into the second cache: the first one is full of the panel at
// hand.
template <size_t bytes>
inline void fetch_next(const View& view, const void* tile) {
  constexpr size_t line = 64;
  const char* const at = reinterpret_cast<const char*>(view.next) +
                         (static_cast<const char*>(tile) - reinterpret_cast<const char*>(view.data));
  for (size_t i = 0; i < bytes; i += line) __builtin_prefetch(at + i, 0, 2);
}

template <int columns>
inline void backward_panel(const View& view, double* y) {
  ColumnSums<columns> sums;
  for_each_below<columns>(view, [&](const auto* entries, const Tile& tile) {
    fetch_next<sizeof(*entries) * height * columns>(view, entries);
    const double* rows = y + tile.row;
    if constexpr (std::is_same_v<decltype(entries), const double*>) {
      for (int h = 0; h < height; h += n_doubles) {
        const Doubles here = load(rows + h);
        for (int c = 0; c < columns; ++c) sums.doubles[c] += load(entries + c * height + h) * here;
      }
    } else {
      for (int h = 0; h < height; h += n_floats) {
        const Floats here = tile.scale * narrowed(rows + h);
        for (int c = 0; c < columns; ++c) sums.floats[c] += load_floats(entries + c * height + h) * here;
      }
      sums.count();
    }
  });
  with_first(view, [&](const auto* triangle) {
    fetch_next<sizeof(*triangle) * height * columns>(view, triangle);
    // Its rows below the triangle; what stands above them is multiplied by zero.
    double rows[height] = {};
    for (int r = columns; r < height; ++r) rows[r] = y[r];
    for (int h = 0; h < height; h += n_doubles) {
      const Doubles here = load(rows + h);
      for (int c = 0; c < columns; ++c) sums.doubles[c] += load(triangle + c * height + h) * here;
    }
    sums.finish();
    // The unknown found last comes last in each sum, so that the others need not wait for it.
    double x[columns];
    for (int c = columns; c-- > 0;) {
      x[c] = y[c] - sums.total[c];
      for (int r = columns; r-- > c + 1;) x[c] -= static_cast<double>(triangle[c * height + r]) * x[r];
      x[c] *= static_cast<double>(triangle[c * height + c]);
    }
    for (int c = 0; c < columns; ++c) y[c] = x[c];
  });
}

// The first tile of a symmetric panel: rows of the square on the diagonal count once, those below it twice.
template <int columns, class T, class X>
inline void add_first(const T* tile, const X* x, double* y, ColumnSums<columns>& sums) {
  double rows[height] = {};
  for (int r = columns; r < height; ++r) rows[r] = static_cast<double>(x[r]);
  for (int h = 0; h < height; h += n_doubles) {
    const Doubles here = load(rows + h);
    Doubles product{};
    for (int c = 0; c < columns; ++c) {
      const Doubles a = load(tile + c * height + h);
      product += a * static_cast<double>(x[c]);
      sums.doubles[c] += a * here;
    }
    store(load(y + h) + product, y + h);
  }
}

// Asks for a tile some time ahead, into the second cache: its entries are read across its columns, which no processor
// takes for one stream. Beyond the last tile nothing is read. What substitutions read comes as fast without it.
template <size_t bytes>
inline void fetch_ahead(const void* tile) {
  constexpr size_t ahead = 16384, line = 64;
  for (size_t i = 0; i < bytes; i += line) __builtin_prefetch(static_cast<const char*>(tile) + ahead + i, 0, 2);
}

template <int columns>
inline void multiply_panel(const View& view, const double* x, double* y) {
  ColumnSums<columns> sums;
  with_first(view, [&](const auto* entries) { add_first<columns>(entries, x, y, sums); });
  for_each_below<columns>(view, [&](const auto* entries, const Tile& tile) {
    if constexpr (std::is_same_v<decltype(entries), const double*>) {
      fetch_ahead<sizeof(*entries) * height * columns>(entries);
      for (int h = 0; h < height; h += n_doubles) {
        const Doubles here = load(x + tile.row + h);
        Doubles product{};
        for (int c = 0; c < columns; ++c) {
          const Doubles a = load(entries + c * height + h);
          product += a * x[c];
          sums.doubles[c] += a * here;
        }
        store(load(y + tile.row + h) + product, y + tile.row + h);
      }
    }
  });
  sums.finish();
  for (int c = 0; c < columns; ++c) y[c] += sums.total[c];
}

template <int columns>
inline void multiply_panel(const View& view, const float* x, double* y) {
  ColumnSums<columns> sums;
  with_first(view, [&](const auto* entries) { add_first<columns>(entries, x, y, sums); });
  for_each_below<columns>(view, [&](const auto* entries, const Tile& tile) {
    if constexpr (!std::is_same_v<decltype(entries), const double*>) {
      fetch_ahead<sizeof(*entries) * height * columns>(entries);
      for (int h = 0; h < height; h += n_floats) {
        const Floats here = tile.scale * load_floats(x + tile.row + h);
        Floats even{}, odd{};
        for (int c = 0; c < columns; ++c) {
          const Floats a = load_floats(entries + c * height + h);
          (c % 2 == 0 ? even : odd) += a * x[c];
          sums.floats[c] += a * here;
        }
        add(tile.scale * (even + odd), y + tile.row + h);
      }
      sums.count();
    }
  });
  sums.finish();
  for (int c = 0; c < columns; ++c) y[c] += sums.total[c];
}

}  // namespace

}  // namespace dygita::DYGITA_ISA
