#pragma once

#include "model/model.hpp"

namespace dygita {

// Cross-checks what no single constructor can see: names unique, every object referred to is listed, steps chained
// without a fork or a loop, no face under a rigid support and a prescribed motion in the same direction, gaps and
// interferences, srs of a history... Throws InputError with the object's origin: "problem 'bolted': step 'tighten'
// loads interface 'shank', which is not in 'interfaces'".
void check_problem(const Problem& problem);

}  // namespace dygita
