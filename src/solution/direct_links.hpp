// Which points are solved in closed form.
#pragma once

#include "solution/exchange.hpp"

namespace dygita {

// Points linked through nodes of explicit pieces depend on each other within a step: one that meets an implicit piece
// has all of them iterated.
void find_direct(const Cut& cut, const std::vector<char>& explicit_pieces, Exchange& exchange);

// Nodes of a piece that points in closed form act on, increasing.
std::vector<int> direct_nodes(const Cut& cut, const Exchange& exchange, int piece);

}  // namespace dygita
