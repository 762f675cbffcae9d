// Which points are solved in closed form.
#pragma once

#include "solution/exchange.hpp"

namespace dygita {

// Points linked through nodes of explicit pieces depend on each other within a step: one that meets an implicit piece
// has all of them iterated.
void find_direct(const Cut& cut, const std::vector<char>& explicit_pieces, Exchange& exchange);

}  // namespace dygita
