#pragma once

#include "exchange/exchange.hpp"

namespace dygita {

// Throws InputError where supports and prescribed motions of a step move what is bonded apart: nothing could follow
// both, and what lets go of one of them later would close in one increment what has opened.
void refuse_torn_ties(const Problem& problem, const Step& step, const Conditions& conditions,
                      const std::vector<Surface>& surfaces, const Exchange& exchange);

}  // namespace dygita
