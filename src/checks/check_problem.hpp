#pragma once

#include "model/model.hpp"

namespace dygita {

// Cross-checks what no single constructor can see: names unique, every object referred to is listed, steps chained
// without a fork or a loop, no face under a rigid support and a prescribed motion in the same direction, gaps and
// interferences, srs of a history... Throws InputError with the object's origin: "problem 'bolted': step 'tighten'
// loads interface 'shank', which is not in 'interfaces'".
void check_problem(const Problem& problem);

namespace check {

// For a dynamic step that has none: one that carries what its loads bring and the outputs ask for (s), and a line that
// says so. Throws where nothing tells.
struct ChosenDt {
  double dt;
  std::string why;
};
ChosenDt choose_dt(const Problem& problem, size_t i_step);

}  // namespace check

}  // namespace dygita
