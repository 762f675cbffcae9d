// Lowest eigenpairs of A x = lambda M x for large sparse matrices, by block Lanczos iteration on the inverse. By hand,
// since Spectra iterates one vector, which finds an eigenvalue that a symmetric assembly has twice once, and has no
// "all below".
#pragma once

#include <functional>
#include <string>

#include "numerics/types.hpp"

namespace dygita {

struct ModeRequest {
  int n = 0;  // how many; 0: all with lambda <= up_to
  double up_to = 0.0;
  int most = 2000;          // more than this many is an error
  double tolerance = 1e-9;  // residual of a pair of B M, of its eigenvalue
};

struct Modes {
  Vec values;           // lambda, increasing
  Mat vectors;          // size x n, M-orthonormal
  bool is_all = false;  // there are no more
};

// solve: x <- B x for the columns of x, B = (A + shift M)^-1 symmetric, or that inverse within linear constraints (then
// on their null space). mass: M, positive definite. A block finds eigenvalues of any multiplicity up to its width, 8.
// Source: Grimes, Lewis, Simon, SIAM J. Matrix Anal. Appl. 15 (1994), with full reorthogonalisation in place of their
// selective one. Throws NumericalError, naming `what`, beyond `most` vectors.
Modes lowest_modes(int size, const std::function<void(Eigen::Ref<Mat>)>& solve, const SparseMatrix& mass, double shift,
                   const ModeRequest& request, const std::string& what);

}  // namespace dygita
