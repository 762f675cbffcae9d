#define DYGITA_ISA generic
#include "numerics/kernels/panel_arithmetic.hpp"
