// Nodes of a face or a region with the weights of a mean over it.
#pragma once

#include "model/model.hpp"

namespace dygita {

struct WeightedNodes {
  int part = -1;  // index in problem.substructures
  std::vector<int> nodes;
  std::vector<double> weights;  // of a face m^2, of a region m^3: not normalised; a face of order two has some of zero
                                // or below, and their sum is its area
};

WeightedNodes weighted_nodes(const Problem& problem, const FaceOrRegion& place);

// Mean over them of a field at them, 3 x nodes.
Vec3 mean_over(const WeightedNodes& on, const Points& field);

}  // namespace dygita
