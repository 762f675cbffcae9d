// The kernels of the linear cells; of those of their own that hexahedra have see hex8.cpp.
#include "fem/cells.hpp"

namespace dygita {

DYGITA_LINEAR_KERNELS(template)

}  // namespace dygita
