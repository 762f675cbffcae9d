// What OpenBLAS sets aside for each thread that computes with it.
#pragma once

namespace dygita {

// Has OpenBLAS set its buffers for so many threads aside now: where it cannot have one later, it retries without limit.
void take_blas_buffers(int n_threads);

}  // namespace dygita
