// What a step needs of memory; nothing is factorised.
#pragma once

#include "step/step_model.hpp"

namespace dygita {

struct StepNeeds {
  StepSize size;
  double at_most = 0.0;  // bytes of the whole process while one thread solves the step, from what it takes now
};
StepNeeds predict_needs(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces,
                        const std::vector<Body>& bodies, const State& start, const CutPtr& cut);

}  // namespace dygita
