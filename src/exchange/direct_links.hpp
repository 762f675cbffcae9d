// Which points are solved in closed form.
#pragma once

#include "exchange/exchange.hpp"

namespace dygita {

// Points linked through nodes of explicit pieces depend on each other within a step: one that meets an implicit piece
// has all of them iterated.
void find_direct(const Cut& cut, const std::vector<char>& explicit_pieces, Exchange& exchange);

// What a rank is concerned with of points in closed form where there are several: those that touch its pieces, and
// those that these share nodes with.
struct NearDirect {
  struct Node {
    int piece, node;
    std::vector<int> readers;  // ranks that solve a point there
  };
  std::vector<char> points;  // of the exchange: is it near?
  std::vector<Node> nodes;   // that near points act on, by piece and node

  std::vector<int> nodes_of(int piece) const;
  // Of such a node.
  const std::vector<int>& readers_at(int piece, int node) const;
};
NearDirect near_direct(const Cut& cut, const Exchange& exchange);

}  // namespace dygita
