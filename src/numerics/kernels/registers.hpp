// Registers of numbers of one kind of processor, and their conversions. Part of panel_arithmetic.hpp: the same rules
// hold.
#pragma once

#include <cstring>
#include <type_traits>

#include "numerics/panel_kernels.hpp"

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace dygita::DYGITA_ISA {

namespace {

using panel::height;
using panel::Tile;
using panel::View;

#if defined(__AVX512F__) && defined(__AVX512BW__) && defined(__AVX512VL__)
constexpr int n_bytes = 64;
#elif defined(__AVX2__)
constexpr int n_bytes = 32;
#else
constexpr int n_bytes = 16;
#endif
constexpr int n_doubles = n_bytes / 8, n_floats = n_bytes / 4;  // of a register
constexpr int most_summed = 16;                                 // tiles whose products are summed in single precision

typedef double Doubles __attribute__((vector_size(n_bytes)));
typedef float Floats __attribute__((vector_size(n_bytes)));
typedef float HalfFloats __attribute__((vector_size(n_bytes / 2)));

template <class V, class T>
inline V read(const T* from) {
  V v;
  std::memcpy(&v, from, sizeof(v));
  return v;
}
inline Doubles load(const double* from) { return read<Doubles>(from); }
inline void store(const Doubles& v, double* to) { std::memcpy(to, &v, sizeof(v)); }

// g++ 12 makes of general conversions several times what the processor needs: they are written out.
#if defined(__AVX512F__) && defined(__AVX512BW__) && defined(__AVX512VL__)
inline Doubles load(const float* from) { return (Doubles)_mm512_cvtps_pd(_mm256_loadu_ps(from)); }
inline Floats load_floats(const float* from) { return read<Floats>(from); }
inline Floats load_floats(const std::int16_t* from) {
  return (Floats)_mm512_cvtepi32_ps(_mm512_cvtepi16_epi32(_mm256_loadu_si256((const __m256i*)from)));
}
inline Floats load_floats(const std::int8_t* from) {
  return (Floats)_mm512_cvtepi32_ps(_mm512_cvtepi8_epi32(_mm_loadu_si128((const __m128i*)from)));
}
inline Doubles lower_half(const Floats& v) { return (Doubles)_mm512_cvtps_pd(_mm512_castps512_ps256((__m512)v)); }
inline Doubles upper_half(const Floats& v) {
  return (Doubles)_mm512_cvtps_pd(_mm256_castpd_ps(_mm512_extractf64x4_pd(_mm512_castps_pd((__m512)v), 1)));
}
inline Floats narrowed(const Doubles& lower, const Doubles& upper) {
  const __m512d a = _mm512_castpd256_pd512(_mm256_castps_pd(_mm512_cvtpd_ps((__m512d)lower)));
  return (Floats)_mm512_castpd_ps(_mm512_insertf64x4(a, _mm256_castps_pd(_mm512_cvtpd_ps((__m512d)upper)), 1));
}
#elif defined(__AVX2__)
inline Doubles load(const float* from) { return (Doubles)_mm256_cvtps_pd(_mm_loadu_ps(from)); }
inline Floats load_floats(const float* from) { return read<Floats>(from); }
inline Floats load_floats(const std::int16_t* from) {
  return (Floats)_mm256_cvtepi32_ps(_mm256_cvtepi16_epi32(_mm_loadu_si128((const __m128i*)from)));
}
inline Floats load_floats(const std::int8_t* from) {
  return (Floats)_mm256_cvtepi32_ps(_mm256_cvtepi8_epi32(_mm_loadl_epi64((const __m128i*)from)));
}
inline Doubles lower_half(const Floats& v) { return (Doubles)_mm256_cvtps_pd(_mm256_castps256_ps128((__m256)v)); }
inline Doubles upper_half(const Floats& v) { return (Doubles)_mm256_cvtps_pd(_mm256_extractf128_ps((__m256)v, 1)); }
inline Floats narrowed(const Doubles& lower, const Doubles& upper) {
  return (Floats)_mm256_set_m128(_mm256_cvtpd_ps((__m256d)upper), _mm256_cvtpd_ps((__m256d)lower));
}
#else
[[maybe_unused]] typedef std::int32_t Ints __attribute__((vector_size(n_bytes)));
inline Doubles widened(const HalfFloats& v) { return __builtin_convertvector(v, Doubles); }
inline Doubles load(const float* from) { return widened(read<HalfFloats>(from)); }
inline Floats load_floats(const float* from) { return read<Floats>(from); }
#if defined(__SSE2__)
// Into the upper half of each number, then down again with its sign.
inline Floats load_floats(const std::int16_t* from) {
  const __m128i v = _mm_loadl_epi64((const __m128i*)from);
  return (Floats)_mm_cvtepi32_ps(_mm_srai_epi32(_mm_unpacklo_epi16(v, v), 16));
}
inline Floats load_floats(const std::int8_t* from) {
  std::int32_t four;
  std::memcpy(&four, from, sizeof(four));
  const __m128i v = _mm_cvtsi32_si128(four), twice = _mm_unpacklo_epi8(v, v);
  return (Floats)_mm_cvtepi32_ps(_mm_srai_epi32(_mm_unpacklo_epi16(twice, twice), 24));
}
#else
template <class T>
inline Floats load_floats(const T* from) {
  Ints ints = {};
  for (int i = 0; i < n_floats; ++i) ints[i] = from[i];
  return __builtin_convertvector(ints, Floats);
}
#endif
inline Doubles lower_half(const Floats& v) { return Doubles{v[0], v[1]}; }
inline Doubles upper_half(const Floats& v) { return Doubles{v[2], v[3]}; }
inline Floats narrowed(const Doubles& lower, const Doubles& upper) {
  return Floats{(float)lower[0], (float)lower[1], (float)upper[0], (float)upper[1]};
}
#endif

// In pairs that are as far apart as can be: the order in which a processor folds a register.
template <class V, class T>
inline T folded(const V& v) {
  constexpr int n = sizeof(V) / sizeof(T);
  T values[n];
  std::memcpy(values, &v, sizeof(v));
  for (int half = n / 2; half > 0; half /= 2)
    for (int i = 0; i < half; ++i) values[i] += values[i + half];
  return values[0];
}
inline double sum(const Doubles& v) { return folded<Doubles, double>(v); }
inline double sum(const Floats& v) { return folded<Doubles, double>(lower_half(v) + upper_half(v)); }

inline Floats narrowed(const double* y) { return narrowed(load(y), load(y + n_doubles)); }
inline void add(const Floats& product, double* y) {
  store(load(y) + lower_half(product), y);
  store(load(y + n_doubles) + upper_half(product), y + n_doubles);
}

}  // namespace

}  // namespace dygita::DYGITA_ISA
