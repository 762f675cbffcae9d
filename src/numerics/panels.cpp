#include "numerics/panels.hpp"

#if defined(__AVX512F__) && defined(__AVX512VL__)
#include <immintrin.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace dygita {

namespace {

constexpr int lanes = 8;
constexpr int most_summed = 16;  // tiles whose products are summed in single precision
using Lanes = double __attribute__((vector_size(lanes * sizeof(double))));
using FloatLanes = float __attribute__((vector_size(lanes * sizeof(float))));
using IntLanes = std::int32_t __attribute__((vector_size(lanes * sizeof(std::int32_t))));
using ShortLanes = std::int16_t __attribute__((vector_size(lanes * sizeof(std::int16_t))));
using ByteLanes = std::int8_t __attribute__((vector_size(lanes * sizeof(std::int8_t))));

template <class V, class T>
V read(const T* from) {
  V v;
  std::memcpy(&v, from, sizeof(v));
  return v;
}
Lanes load(const double* from) { return read<Lanes>(from); }
#if defined(__AVX512F__) && defined(__AVX512VL__)  // what g++ 12 makes of the conversions below is several times slower
Lanes load(const float* from) { return (Lanes)_mm512_cvtps_pd(_mm256_loadu_ps(from)); }
Lanes load(const std::int16_t* from) {
  return (Lanes)_mm512_cvtepi32_pd(_mm256_cvtepi16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(from))));
}
Lanes load(const std::int8_t* from) {
  return (Lanes)_mm512_cvtepi32_pd(_mm256_cvtepi8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from))));
}
#else
Lanes load(const float* from) { return __builtin_convertvector(read<FloatLanes>(from), Lanes); }
Lanes load(const std::int16_t* from) {
  return __builtin_convertvector(__builtin_convertvector(read<ShortLanes>(from), IntLanes), Lanes);
}
Lanes load(const std::int8_t* from) {
  return __builtin_convertvector(__builtin_convertvector(read<ByteLanes>(from), IntLanes), Lanes);
}
#endif

using WideLanes = float __attribute__((vector_size(2 * lanes * sizeof(float))));
WideLanes load_wide(const float* from) { return read<WideLanes>(from); }
#if defined(__AVX512F__) && defined(__AVX512VL__)
WideLanes load_wide(const std::int16_t* from) {
  return (WideLanes)_mm512_cvtepi32_ps(_mm512_cvtepi16_epi32(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(from))));
}
WideLanes load_wide(const std::int8_t* from) {
  return (WideLanes)_mm512_cvtepi32_ps(_mm512_cvtepi8_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(from))));
}
#else
using WideInts = std::int32_t __attribute__((vector_size(2 * lanes * sizeof(std::int32_t))));
template <class T>
WideLanes load_wide(const T* from) {
  WideInts ints;
  for (int i = 0; i < 2 * lanes; ++i) ints[i] = from[i];
  return __builtin_convertvector(ints, WideLanes);
}
#endif

void store(const Lanes& v, double* to) { std::memcpy(to, &v, sizeof(v)); }
double sum(const Lanes& v) { return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7])); }

// y - tile x, the first `n` columns.
template <int n, class T>
void subtract_product(const T* tile, double scale, const double* x, double* y) {
  Lanes upper{}, lower{};
  for (int c = 0; c < n; ++c) {
    upper += load(tile + c * Panels::height) * x[c];
    lower += load(tile + c * Panels::height + lanes) * x[c];
  }
  store(load(y) - scale * upper, y);
  store(load(y + lanes) - scale * lower, y + lanes);
}

// The same with the tile's own sums, of up to 8 products, in single precision.
template <int n, class T>
void subtract_product(const T* tile, float scale, const float* x, double* y) {
  WideLanes even{}, odd{};
  for (int c = 0; c < n; ++c) (c % 2 == 0 ? even : odd) += load_wide(tile + c * Panels::height) * x[c];
  const WideLanes product = scale * (even + odd);
  float values[2 * lanes];
  std::memcpy(values, &product, sizeof(values));
  store(load(y) - load(values), y);
  store(load(y + lanes) - load(values + lanes), y + lanes);
}

WideLanes narrowed(const double* y) {
  const FloatLanes upper = __builtin_convertvector(load(y), FloatLanes), lower = __builtin_convertvector(load(y + lanes), FloatLanes);
  WideLanes both;
  std::memcpy(&both, &upper, sizeof(upper));
  std::memcpy(reinterpret_cast<char*>(&both) + sizeof(upper), &lower, sizeof(lower));
  return both;
}

template <int n, class T>
void add_transposed(const T* tile, float scale, const double* y, WideLanes* sums) {
  const WideLanes here = scale * narrowed(y);
  for (int c = 0; c < n; ++c) sums[c] += load_wide(tile + c * Panels::height) * here;
}

double sum(const WideLanes& v) {
  float values[2 * lanes];
  std::memcpy(values, &v, sizeof(values));
  return sum(load(values) + load(values + lanes));
}

// sums[c] + tile(:, c) . y
template <int n, class T>
void add_transposed(const T* tile, double scale, const double* y, Lanes* sums) {
  const Lanes upper = scale * load(y), lower = scale * load(y + lanes);
  for (int c = 0; c < n; ++c) {
    sums[c] += load(tile + c * Panels::height) * upper;
    sums[c] += load(tile + c * Panels::height + lanes) * lower;
  }
}

template <int n, class T>
void add_both(const T* tile, double scale, const double* at, const double* x, double* y, Lanes* sums) {
  const Lanes x_upper = scale * load(x), x_lower = scale * load(x + lanes);
  Lanes upper{}, lower{};
  for (int c = 0; c < n; ++c) {
    const Lanes a = load(tile + c * Panels::height), b = load(tile + c * Panels::height + lanes);
    upper += a * at[c];
    lower += b * at[c];
    sums[c] += a * x_upper;
    sums[c] += b * x_lower;
  }
  store(load(y) + scale * upper, y);
  store(load(y + lanes) + scale * lower, y + lanes);
}

template <int n, class T>
void add_both(const T* tile, float scale, const float* at, const float* x, double* y, WideLanes* sums) {
  const WideLanes here = scale * load_wide(x);
  WideLanes even{}, odd{};
  for (int c = 0; c < n; ++c) {
    const WideLanes a = load_wide(tile + c * Panels::height);
    (c % 2 == 0 ? even : odd) += a * at[c];
    sums[c] += a * here;
  }
  const WideLanes product = scale * (even + odd);
  float values[2 * lanes];
  std::memcpy(values, &product, sizeof(values));
  store(load(y) + load(values), y);
  store(load(y + lanes) + load(values + lanes), y + lanes);
}

// Calls f with the number of columns as a constant.
template <class Function>
void with_width(int n, Function&& f) {
  switch (n) {
    case 1: return f(std::integral_constant<int, 1>{});
    case 2: return f(std::integral_constant<int, 2>{});
    case 3: return f(std::integral_constant<int, 3>{});
    case 4: return f(std::integral_constant<int, 4>{});
    case 5: return f(std::integral_constant<int, 5>{});
    case 6: return f(std::integral_constant<int, 6>{});
    case 7: return f(std::integral_constant<int, 7>{});
    default: return f(std::integral_constant<int, 8>{});
  }
}

template <class T>
size_t tile_bytes(int n_columns) { return sizeof(T) * Panels::height * n_columns; }

}  // namespace

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
      for (int i = row; i < end; ++i) largest = std::max(largest, std::abs(values[static_cast<size_t>(c) * stride + i]));
    for (int i = row; i < end && tolerance; ++i) allowed = std::min(allowed, tolerance[i]);
    if (row > 0 && largest <= (is_double ? 0.0 : allowed)) continue;
    const Kind kind = row == 0 ? (is_double ? full : float_32) : kind_of(largest, allowed);
    const double most = kind == int_8 ? 127.0 : 32767.0;
    planned.push_back({{row, kind == int_8 || kind == int_16 ? static_cast<float>(largest / most) : 1.0f}, kind});
  }
  std::stable_sort(planned.begin() + 1, planned.end(), [](const Planned& a, const Planned& b) { return a.kind < b.kind; });

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
            std::is_integral_v<T> ? static_cast<T>(std::lround(std::clamp(value * inverse, -static_cast<double>(std::numeric_limits<T>::max()),
                                                                          static_cast<double>(std::numeric_limits<T>::max()))))
                                  : static_cast<T>(value);
      }
    std::memcpy(data_.data() + start, entries.data(), entries.size() * sizeof(T));
  };
  for (const Planned& p : planned) {
    ++panel.count[p.kind];
    tiles_.push_back(p.tile);
    switch (p.kind) {
      case full: write(p.tile, 0.0); break;
      case float_32: write(p.tile, 0.0f); break;
      case int_16: write(p.tile, std::int16_t{0}); break;
      default: write(p.tile, std::int8_t{0}); break;
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

// f(entries, tile) for every tile, the first of the panel first.
template <class Function>
void Panels::for_each_tile(const Panel& panel, Function&& f) const {
  const std::byte* at = data_.data() + panel.data;
  const Tile* tile = tiles_.data() + panel.tiles;
  const auto run = [&](int n, auto zero) {
    using T = decltype(zero);
    for (int i = 0; i < n; ++i, ++tile, at += tile_bytes<T>(panel.n_columns)) f(reinterpret_cast<const T*>(at), *tile);
  };
  run(panel.count[full], 0.0);
  run(panel.count[float_32], 0.0f);
  run(panel.count[int_16], std::int16_t{0});
  run(panel.count[int_8], std::int8_t{0});
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
    if (triangle_double) solve(triangle_double);
    else solve(triangle_float);
  });
}

void Panels::multiply_symmetric(size_t i_panel, const double* x, double* y) const {
  const Panel& panel = panels_[i_panel];
  with_width(panel.n_columns, [&](auto n) {
    constexpr int columns = n;
    double at[columns];
    for (int c = 0; c < columns; ++c) at[c] = x[c];
    Lanes sums[columns] = {};
    for_each_tile(panel, [&](const auto* entries, const Tile& tile) {
      if (tile.row > 0) return add_both<columns>(entries, tile.scale, at, x + tile.row, y + tile.row, sums);
      // Rows of the square on the diagonal count once, those below it twice.
      for (int c = 0; c < columns; ++c)
        for (int r = 0; r < height; ++r) {
          const double a = static_cast<double>(entries[c * height + r]);
          y[r] += a * at[c];
          if (r >= columns) y[c] += a * x[r];
        }
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
        for (int c = 0; c < columns; ++c)
          for (int r = 0; r < height; ++r) {
            const double a = static_cast<double>(entries[c * height + r]);
            y[r] += a * at[c];
            if (r >= columns) y[c] += a * x[r];
          }
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
        values[static_cast<size_t>(c) * stride + tile.row + i] = static_cast<double>(tile.scale) * static_cast<double>(entries[c * height + i]);
  });
}

namespace {

// With several right-hand sides a tile keeps the processor busy for so long that it does not look ahead by itself.
template <class T>
void fetch_ahead(const T* tile, int n) {
  const auto* next = reinterpret_cast<const char*>(tile + 2 * Panels::height * n);
  for (size_t i = 0; i < sizeof(T) * Panels::height * n; i += 64) __builtin_prefetch(next + i);
}

// A tile in double precision, scale included.
template <class T>
const double* decoded(const T* tile, double scale, int n, double* buffer) {
  if constexpr (std::is_same_v<T, double>) return tile;
  for (int i = 0; i < n * Panels::height; i += lanes) store(scale * load(tile + i), buffer + i);
  return buffer;
}

}  // namespace

void Panels::forward(size_t i_panel, double* y, int n_vectors) const {
  const auto solve = [&](auto n, auto vectors) {
    constexpr int columns = n, m = vectors, stride = m * lanes;
    Lanes x[columns][m];
    alignas(64) double buffer[width * height];
    for_each_tile(panels_[i_panel], [&](const auto* entries, const Tile& tile) {
      fetch_ahead(entries, columns);
      const double* a = decoded(entries, tile.scale, columns, buffer);
      double* rows = y + static_cast<size_t>(tile.row) * stride;
      if (tile.row == 0) {
        for (int c = 0; c < columns; ++c)
          for (int v = 0; v < m; ++v) x[c][v] = load(rows + c * stride + v * lanes);
        for (int c = 0; c < columns; ++c)
          for (int v = 0; v < m; ++v) {
            x[c][v] *= a[c * height + c];
            for (int r = c + 1; r < columns; ++r) x[r][v] -= a[c * height + r] * x[c][v];
          }
      }
      constexpr int together = 4;
      Lanes at[columns][m];  // a copy that can stay in registers
      for (int c = 0; c < columns; ++c)
        for (int v = 0; v < m; ++v) at[c][v] = x[c][v];
      for (int r = 0; r < height; r += together) {
        Lanes sums[together][m];
        for (int i = 0; i < together; ++i)
          for (int v = 0; v < m; ++v) sums[i][v] = load(rows + (r + i) * stride + v * lanes);
        for (int c = 0; c < columns; ++c)
          for (int i = 0; i < together; ++i)
            for (int v = 0; v < m; ++v) sums[i][v] -= a[c * height + r + i] * at[c][v];
        for (int i = 0; i < together; ++i)
          for (int v = 0; v < m; ++v) store(sums[i][v], rows + (r + i) * stride + v * lanes);
      }
      if (tile.row == 0)
        for (int c = 0; c < columns; ++c)
          for (int v = 0; v < m; ++v) store(x[c][v], rows + c * stride + v * lanes);
    });
  };
  with_width(panels_[i_panel].n_columns, [&](auto n) {
    if (n_vectors == 1) solve(n, std::integral_constant<int, 1>{});
    else solve(n, std::integral_constant<int, 2>{});
  });
}

void Panels::backward(size_t i_panel, double* y, int n_vectors) const {
  const auto solve = [&](auto n, auto vectors) {
    constexpr int columns = n, m = vectors, stride = m * lanes;
    Lanes sums[columns][m] = {};
    alignas(64) double buffer[width * height], first[width * height];
    const double* triangle = nullptr;
    for_each_tile(panels_[i_panel], [&](const auto* entries, const Tile& tile) {
      fetch_ahead(entries, columns);
      if (tile.row == 0) triangle = decoded(entries, 1.0, columns, first);
      const double* a = tile.row == 0 ? triangle : decoded(entries, tile.scale, columns, buffer);
      const double* rows = y + static_cast<size_t>(tile.row) * stride;
      Lanes own[columns][m] = {};  // sums that can stay in registers
      for (int r = tile.row == 0 ? columns : 0; r < height; ++r) {
        Lanes here[m];
        for (int v = 0; v < m; ++v) here[v] = load(rows + r * stride + v * lanes);
        for (int c = 0; c < columns; ++c)
          for (int v = 0; v < m; ++v) own[c][v] += a[c * height + r] * here[v];
      }
      for (int c = 0; c < columns; ++c)
        for (int v = 0; v < m; ++v) sums[c][v] += own[c][v];
    });
    for (int c = columns; c-- > 0;)
      for (int v = 0; v < m; ++v) {
        Lanes x = load(y + c * stride + v * lanes) - sums[c][v];
        for (int r = c + 1; r < columns; ++r) x -= triangle[c * height + r] * load(y + r * stride + v * lanes);
        store(triangle[c * height + c] * x, y + c * stride + v * lanes);
      }
  };
  with_width(panels_[i_panel].n_columns, [&](auto n) {
    if (n_vectors == 1) solve(n, std::integral_constant<int, 1>{});
    else solve(n, std::integral_constant<int, 2>{});
  });
}

}  // namespace dygita
