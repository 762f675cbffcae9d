// What non-reflecting supports hold waves with (manual, absorbing support).
#pragma once

#include <unordered_map>
#include <vector>

#include "pieces/piece_operator.hpp"

namespace dygita {

// Of a substructure, N s/m: lumped at the nodes of linear facets; on those of order two consistent, or lumped as the
// mass behind them is in an explicit piece. Nothing in a static step.
struct AbsorbingImpedance {
  std::unordered_map<int, Mat3> of_nodes;
  std::vector<NodePairImpedance> of_pairs;

  void add(int node, const Mat3& own) { of_nodes.emplace(node, Mat3::Zero()).first->second += own; }
};
AbsorbingImpedance absorbing_impedance(const Problem& problem, const Step& step, const Substructure& body,
                                       bool is_explicit);

}  // namespace dygita
