// How threads wait: a program on a shared machine must not spin.
#pragma once

namespace dygita {

// OpenMP's threads spin at every barrier unless told otherwise before the program starts, and OpenBLAS starts threads of its own:
// on a busy machine that costs several times the work itself. Starts the program once more with OMP_WAIT_POLICY=passive and
// OPENBLAS_NUM_THREADS=1 where the user has set neither. Call first in main.
void wait_passively(char** argv);

}  // namespace dygita
