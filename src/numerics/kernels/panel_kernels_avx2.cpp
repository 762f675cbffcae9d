#define DYGITA_ISA avx2
#include "numerics/kernels/panel_arithmetic.hpp"
