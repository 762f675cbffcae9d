// The colour of a part in every picture.
#pragma once

#include <string>

namespace dygita {

// "#rrggbb", pale enough for edges and texts on it.
std::string part_color(int i_part);

}  // namespace dygita
