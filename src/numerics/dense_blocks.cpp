#include "numerics/dense_blocks.hpp"

#include <cblas.h>

#include <algorithm>

#include "base/parallel.hpp"

extern "C" void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info);

namespace dygita {

namespace {

constexpr int block_columns = 192;              // columns of a block: products of blocks run at their full speed
constexpr double operations_for_threads = 2e7;  // operations: some hundred times what waking the threads takes

int blocks_of(int n) { return (n + block_columns - 1) / block_columns; }
double* entry(double* a, int stride, int row, int column) { return a + static_cast<size_t>(column) * stride + row; }
int threads_for(double operations) { return operations < operations_for_threads ? 1 : 0; }

}  // namespace

void subtract_square(int n, int k, const double* b, int stride_b, double beta, double* a, int stride,
                     const Watch& watch) {
  if (n == 0) return;
  // The longest columns come first, so that threads end together.
  parallel_for(
      blocks_of(n),
      [&](int block) {
        if (watch) watch();
        const int j = block * block_columns, w = std::min(block_columns, n - j), below = n - j - w;
        cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, w, k, -1.0, b + j, stride_b, beta, entry(a, stride, j, j),
                    stride);
        if (below > 0)
          cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, below, w, k, -1.0, b + j + w, stride_b, b + j, stride_b,
                      beta, entry(a, stride, j + w, j), stride);
      },
      Schedule::as_free, threads_for(static_cast<double>(n) * n * k));
}

int factorise_columns(int n_rows, int n_columns, double* a, int stride, const Watch& watch) {
  for (int j = 0; j < n_columns; j += block_columns) {
    if (watch) watch();
    const int w = std::min(block_columns, n_columns - j), below = n_rows - j - w, right = n_columns - j - w;
    double* const corner = entry(a, stride, j, j);
    int info = 0;
    dpotrf_("L", &w, corner, &stride, &info);
    if (info != 0) return j + std::max(info, 1) - 1;
    parallel_for(
        blocks_of(below),
        [&](int block) {
          const int row = block * block_columns, height = std::min(block_columns, below - row);
          cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, height, w, 1.0, corner, stride,
                      corner + w + row, stride);
        },
        Schedule::as_free, threads_for(static_cast<double>(below) * w * w));
    parallel_for(
        blocks_of(right),
        [&](int block) {
          const int c = block * block_columns, own = std::min(block_columns, right - c), rest = below - c - own;
          const double* const left = corner + w + c;
          cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, own, w, -1.0, left, stride, 1.0,
                      entry(a, stride, j + w + c, j + w + c), stride);
          if (rest > 0)
            cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, rest, own, w, -1.0, left + own, stride, left, stride,
                        1.0, entry(a, stride, j + w + c + own, j + w + c), stride);
        },
        Schedule::as_free, threads_for(2.0 * below * right * w));
  }
  return -1;
}

void invert_factor(Mat& l, const Watch& watch) {
  const int n = static_cast<int>(l.rows());
  const int threads = threads_for(static_cast<double>(n) * n * n / 3);
  Mat x(n, n);  // L^-1
  parallel_for(
      blocks_of(n),
      [&](int block) {
        const int j = block * block_columns, w = std::min(block_columns, n - j);
        if (watch) watch();
        x.block(j, j, n - j, w).setIdentity();
        cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, n - j, w, 1.0,
                    entry(l.data(), n, j, j), n, entry(x.data(), n, j, j), n);
      },
      Schedule::as_free, threads);
  // X^T X: of two columns all rows that both have.
  parallel_for(
      blocks_of(n),
      [&](int block) {
        const int j = block * block_columns, w = std::min(block_columns, n - j);
        for (int i = j; i < n; i += block_columns) {
          if (watch) watch();
          const int h = std::min(block_columns, n - i);
          cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, h, w, n - i, 1.0, entry(x.data(), n, i, i), n,
                      entry(x.data(), n, i, j), n, 0.0, entry(l.data(), n, i, j), n);
        }
      },
      Schedule::as_free, threads);
}

}  // namespace dygita
