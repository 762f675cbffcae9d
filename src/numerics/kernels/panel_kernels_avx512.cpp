#define DYGITA_ISA avx512
#include "numerics/kernels/panel_arithmetic.hpp"
