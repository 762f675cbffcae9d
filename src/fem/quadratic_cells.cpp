// The kernels of the cells of order two.
#include "fem/cells.hpp"

namespace dygita {

DYGITA_QUADRATIC_KERNELS(template)

}  // namespace dygita
