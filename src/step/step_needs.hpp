// What a step needs of memory and of time; nothing is factorised.
#pragma once

#include <string>

#include "step/step_model.hpp"

namespace dygita {

// Operations of sparse factors, each a multiplication and an addition, and the bytes of plain reading that the rest
// costs as much as.
struct Cost {
  double operations = 0.0, bytes = 0.0;
};

// Of a step: once, and in each of its rounds, of which there are so many.
struct StepCost {
  Cost once, a_round;
  double fewest = 0.0, most = 0.0;
  std::string rounds;  // "4 to 16 factors"; empty: nothing is known to vary
};

struct StepNeeds {
  StepSize size;
  double at_most = 0.0;  // bytes of the whole process while one thread solves the step, from what it takes now
  StepCost cost;
};
StepNeeds predict_needs(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces,
                        const std::vector<Body>& bodies, const State& start, const CutPtr& cut);

// Of a dynamic step, its parts integrated in that way; of a static one that is solved part by part.
StepCost predict_cost(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces,
                      const std::vector<Body>& bodies, const Cut& cut, const Integration& integration);

}  // namespace dygita
