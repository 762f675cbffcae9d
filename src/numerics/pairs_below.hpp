// The few smallest eigenpairs of a large sparse matrix that is nearly singular. By hand: libraries ask how many there
// are, which is what is wanted here.
#pragma once

#include "numerics/dense.hpp"

namespace dygita {

// Eigenpairs of a symmetric positive semidefinite matrix with eigenvalues below a limit, increasing, vectors
// orthonormal: those that the others leave a gap to, as free motions do. How many there are is the number of negative
// pivots of A - limit I (Sylvester's law of inertia), so that none costs one sparse factor; they are found by subspace
// iteration with (A + limit I)^-1. A small matrix, or one whose pairs do not come out as counted, is solved dense.
EigenPairs pairs_below(const SparseMatrix& a, double limit);

}  // namespace dygita
