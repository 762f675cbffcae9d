// What each thread, and the process before its first one, is set to.
#pragma once

namespace dygita {

// OpenBLAS and VTK start threads of their own unless told otherwise before the program starts: on a busy machine that
// costs several times the work itself. Starts the program once more with OPENBLAS_NUM_THREADS=1,
// VTK_SMP_BACKEND_IN_USE=Sequential and GLIBC_TUNABLES (large pages under the heap) where the user has not set them.
// Call first in main. blas_kernels: the kernels that OpenBLAS is to use, where its own choice is poor
// (better_blas_kernels); null: its own choice.
void set_up_process(char** argv, const char* blas_kernels = nullptr);

// Numbers too small to be normal are zero from now on in this thread: a wave's tail would cost a hundred times its
// front.
void flush_denormals();

}  // namespace dygita
