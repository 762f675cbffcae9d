// The product of matrices given by edges: a force for each difference of two nodes. Part of panel_arithmetic.hpp: the
// same rules hold.
#pragma once

#include "numerics/kernels/registers.hpp"

namespace dygita::DYGITA_ISA {

namespace {

#if defined(__AVX2__) && defined(__FMA__)
// A row of a block is read with the number after it, which meets the zero in the fourth place of the difference.
inline __m256d load_row(const float* row) { return _mm256_cvtps_pd(_mm_loadu_ps(row)); }
inline double sum_of_three(const __m256d& v) {
  const __m128d low = _mm256_castpd256_pd128(v);
  return _mm_cvtsd_f64(_mm_add_sd(_mm_add_sd(low, _mm_unpackhi_pd(low, low)), _mm256_extractf128_pd(v, 1)));
}

void add_edge_product(const EdgeView& edges, const double* x, double* y) {
  const float* k = edges.blocks;
  for (int a = 0; a < edges.n_nodes; ++a) {
    const __m256d xa = _mm256_loadu_pd(x + 4 * (std::size_t)a);
    __m256d t0 = _mm256_setzero_pd(), t1 = t0, t2 = t0;
    for (int e = edges.starts[a]; e < edges.starts[a + 1]; ++e, k += 9) {
      const std::size_t b = 4 * (std::size_t)edges.others[e];
      const __m256d r0 = load_row(k), r1 = load_row(k + 3), r2 = load_row(k + 6);
      const __m256d d = _mm256_sub_pd(_mm256_loadu_pd(x + b), xa);
      // One component in the first three places, zero in the fourth.
      const __m256d d0 = _mm256_permute4x64_pd(d, 0xc0), d1 = _mm256_permute4x64_pd(d, 0xd5),
                    d2 = _mm256_permute4x64_pd(d, 0xea);
      t0 = _mm256_fmadd_pd(r0, d, t0);
      t1 = _mm256_fmadd_pd(r1, d, t1);
      t2 = _mm256_fmadd_pd(r2, d, t2);
      __m256d w = _mm256_loadu_pd(y + b);
      w = _mm256_fnmadd_pd(r0, d0, w);
      w = _mm256_fnmadd_pd(r1, d1, w);
      w = _mm256_fnmadd_pd(r2, d2, w);
      _mm256_storeu_pd(y + b, w);
    }
    double* const own = y + 4 * (std::size_t)a;
    own[0] += sum_of_three(t0);
    own[1] += sum_of_three(t1);
    own[2] += sum_of_three(t2);
  }
}

inline __m256d scalar_product_at(const NodeEdgeView& edges, const double* x, int a) {
  const __m256d xa = _mm256_loadu_pd(x + 4 * (std::size_t)a);
  __m256d sum = _mm256_setzero_pd();
  for (int e = edges.starts[a]; e < edges.starts[a + 1]; ++e) {
    const __m256d apart = _mm256_sub_pd(xa, _mm256_loadu_pd(x + 4 * (std::size_t)edges.others[e]));
    sum = _mm256_fmadd_pd(_mm256_set1_pd(edges.values[e]), apart, sum);
  }
  return sum;
}

void add_scalar_edge_product(const NodeEdgeView& edges, const double* x, double* y) {
  for (int a = 0; a < edges.n_nodes; ++a) {
    double* const own = y + 4 * (std::size_t)a;
    _mm256_storeu_pd(own, _mm256_add_pd(_mm256_loadu_pd(own), scalar_product_at(edges, x, a)));
  }
}

void move_nodes(const NodeMotion& motion, const NodeEdgeView& edges, const double* x, double* product) {
  const __m256d keep = _mm256_set1_pd(motion.keep), dt = _mm256_set1_pd(motion.dt);
  for (int a = 0; a < edges.n_nodes; ++a) {
    const std::size_t at = 4 * (std::size_t)a;
    const __m256d own = scalar_product_at(edges, x, a);
    _mm256_storeu_pd(product + at, own);
    const __m256d pull =
        _mm256_mul_pd(_mm256_set1_pd(motion.inverse[a]), _mm256_add_pd(_mm256_loadu_pd(motion.pull + at), own));
    const __m256d v = _mm256_fmsub_pd(keep, _mm256_loadu_pd(motion.v + at), pull);
    _mm256_storeu_pd(motion.v + at, v);
    _mm256_storeu_pd(motion.d + at, _mm256_fmadd_pd(dt, v, _mm256_loadu_pd(motion.d + at)));
  }
}
#else
void add_edge_product(const EdgeView& edges, const double* x, double* y) {
  const float* k = edges.blocks;
  for (int a = 0; a < edges.n_nodes; ++a) {
    const double* const xa = x + 4 * (std::size_t)a;
    double t0 = 0.0, t1 = 0.0, t2 = 0.0;
    for (int e = edges.starts[a]; e < edges.starts[a + 1]; ++e, k += 9) {
      const std::size_t b = 4 * (std::size_t)edges.others[e];
      const double d0 = x[b] - xa[0], d1 = x[b + 1] - xa[1], d2 = x[b + 2] - xa[2];
      t0 += k[0] * d0 + k[1] * d1 + k[2] * d2;
      t1 += k[3] * d0 + k[4] * d1 + k[5] * d2;
      t2 += k[6] * d0 + k[7] * d1 + k[8] * d2;
      y[b] -= k[0] * d0 + k[3] * d1 + k[6] * d2;
      y[b + 1] -= k[1] * d0 + k[4] * d1 + k[7] * d2;
      y[b + 2] -= k[2] * d0 + k[5] * d1 + k[8] * d2;
    }
    double* const own = y + 4 * (std::size_t)a;
    own[0] += t0;
    own[1] += t1;
    own[2] += t2;
  }
}

struct Three {
  double at[3];
};
inline Three scalar_product_at(const NodeEdgeView& edges, const double* x, int a) {
  const double* const xa = x + 4 * (std::size_t)a;
  Three sum{{0.0, 0.0, 0.0}};
  for (int e = edges.starts[a]; e < edges.starts[a + 1]; ++e) {
    const double* const xb = x + 4 * (std::size_t)edges.others[e];
    for (int c = 0; c < 3; ++c) sum.at[c] += (double)edges.values[e] * (xa[c] - xb[c]);
  }
  return sum;
}

void add_scalar_edge_product(const NodeEdgeView& edges, const double* x, double* y) {
  for (int a = 0; a < edges.n_nodes; ++a) {
    const Three own = scalar_product_at(edges, x, a);
    for (int c = 0; c < 3; ++c) y[4 * (std::size_t)a + c] += own.at[c];
  }
}

void move_nodes(const NodeMotion& motion, const NodeEdgeView& edges, const double* x, double* product) {
  for (int a = 0; a < edges.n_nodes; ++a) {
    const Three own = scalar_product_at(edges, x, a);
    for (int c = 0; c < 3; ++c) {
      const std::size_t at = 4 * (std::size_t)a + c;
      product[at] = own.at[c];
      motion.v[at] = motion.keep * motion.v[at] - motion.inverse[a] * (motion.pull[at] + own.at[c]);
      motion.d[at] += motion.dt * motion.v[at];
    }
  }
}
#endif

}  // namespace

}  // namespace dygita::DYGITA_ISA
