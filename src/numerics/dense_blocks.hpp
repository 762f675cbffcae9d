// Dense Cholesky factorisation by blocks of fixed size, which the threads at hand share: the same bits for any number
// of them. Matrices are column-major, `stride` apart, and only their lower triangles are read and written.
#pragma once

#include <functional>

#include "numerics/types.hpp"

namespace dygita {

// Is called again and again while something long is computed, on any of its threads; what it throws ends that.
using Watch = std::function<void()>;

// The first n_columns columns of L in A = L L^T, over those of A (n_rows >= n_columns of each); what is to the right of
// them is left alone. Answers the first column whose pivot is not positive, or -1.
int factorise_columns(int n_rows, int n_columns, double* a, int stride, const Watch& watch = {});

// A <- beta A - B B^T (n x n), B with n rows and k columns.
void subtract_square(int n, int k, const double* b, int stride_b, double beta, double* a, int stride,
                     const Watch& watch = {});

// (L L^T)^-1 over L (n x n).
void invert_factor(Mat& l, const Watch& watch = {});

}  // namespace dygita
