// The arithmetic of one tile (panels.hpp): what it is stored in, and its products with vectors. Of panels*.cpp alone.
#pragma once

#if defined(__AVX512F__) && defined(__AVX512VL__)
#include <immintrin.h>
#endif

#include <cstdint>
#include <cstring>

#include "numerics/panels.hpp"

// Without AVX-512 g++ warns at each call that how a function returns such wide vectors depends on the processor. All
// of these are inlined into two sources of one library, compiled alike: let it be silent to the end of the source.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace dygita {

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
inline Lanes load(const double* from) { return read<Lanes>(from); }
#if defined(__AVX512F__) && defined(__AVX512VL__)  // what g++ 12 makes of the conversions below is several times slower
inline Lanes load(const float* from) { return (Lanes)_mm512_cvtps_pd(_mm256_loadu_ps(from)); }
inline Lanes load(const std::int16_t* from) {
  return (Lanes)_mm512_cvtepi32_pd(_mm256_cvtepi16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(from))));
}
inline Lanes load(const std::int8_t* from) {
  return (Lanes)_mm512_cvtepi32_pd(_mm256_cvtepi8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from))));
}
#else
inline Lanes load(const float* from) { return __builtin_convertvector(read<FloatLanes>(from), Lanes); }
inline Lanes load(const std::int16_t* from) {
  return __builtin_convertvector(__builtin_convertvector(read<ShortLanes>(from), IntLanes), Lanes);
}
inline Lanes load(const std::int8_t* from) {
  return __builtin_convertvector(__builtin_convertvector(read<ByteLanes>(from), IntLanes), Lanes);
}
#endif

using WideLanes = float __attribute__((vector_size(2 * lanes * sizeof(float))));
inline WideLanes load_wide(const float* from) { return read<WideLanes>(from); }
#if defined(__AVX512F__) && defined(__AVX512VL__)
inline WideLanes load_wide(const std::int16_t* from) {
  return (WideLanes)_mm512_cvtepi32_ps(
      _mm512_cvtepi16_epi32(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(from))));
}
inline WideLanes load_wide(const std::int8_t* from) {
  return (WideLanes)_mm512_cvtepi32_ps(_mm512_cvtepi8_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(from))));
}
#else
using WideInts = std::int32_t __attribute__((vector_size(2 * lanes * sizeof(std::int32_t))));
template <class T>
inline WideLanes load_wide(const T* from) {
  WideInts ints;
  for (int i = 0; i < 2 * lanes; ++i) ints[i] = from[i];
  return __builtin_convertvector(ints, WideLanes);
}
#endif

inline void store(const Lanes& v, double* to) { std::memcpy(to, &v, sizeof(v)); }
inline double sum(const Lanes& v) { return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7])); }

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

inline WideLanes narrowed(const double* y) {
  const FloatLanes upper = __builtin_convertvector(load(y), FloatLanes),
                   lower = __builtin_convertvector(load(y + lanes), FloatLanes);
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

inline double sum(const WideLanes& v) {
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
    case 1:
      return f(std::integral_constant<int, 1>{});
    case 2:
      return f(std::integral_constant<int, 2>{});
    case 3:
      return f(std::integral_constant<int, 3>{});
    case 4:
      return f(std::integral_constant<int, 4>{});
    case 5:
      return f(std::integral_constant<int, 5>{});
    case 6:
      return f(std::integral_constant<int, 6>{});
    case 7:
      return f(std::integral_constant<int, 7>{});
    default:
      return f(std::integral_constant<int, 8>{});
  }
}

template <class T>
size_t tile_bytes(int n_columns) {
  return sizeof(T) * Panels::height * n_columns;
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
}  // namespace dygita
