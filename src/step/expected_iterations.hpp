// How many iterations an increment takes by experience, before anything is known of its solution.
#pragma once

#include "step/integration.hpp"

namespace dygita {

constexpr double iterations_of_shocks = 7.0;  // of a dynamic increment in which no law may turn

struct ExpectedIterations {
  double fewest, most;
};

// Of a step that is solved part by part.
ExpectedIterations expected_iterations(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces,
                                       const Integration& integration);

// Does a law act in the step that may change from iteration to iteration?
bool may_turn(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces);

}  // namespace dygita
