// Stress along the axes of a material with directions, and how near it comes to what that bears.
#pragma once

#include "fem/assembly.hpp"
#include "material/strength.hpp"

namespace dygita {

// At nodes, 6 x n_nodes, Pa, 11 22 33 12 23 13, the mean of the adjacent cells; of a layup in the axes of one of its
// plies (from 0), in the middle of that, or of the ply that the node lies in, of two the lower.
inline constexpr int at_its_place = -1;
Tensors own_stress(const Mesh& mesh, const Elastic& material, const Points& displacement, int ply = at_its_place);

// Of the mean stress of the adjacent cells in the material's axes; of a layup the largest of its plies, above and below
// each, at the node's place in the plane.
struct NodalFailure {
  Vec index;
  std::vector<int> ply;  // from 0; empty: no layup
  std::vector<FailureMode> mode;
};
// Of a material that has strengths; of a layup of all plies or of one.
inline constexpr int of_all_plies = -1;
NodalFailure nodal_failure(const Mesh& mesh, const Elastic& material, const Points& displacement,
                           int ply = of_all_plies);

// nodal_stress of a layup: that of the ply which the node lies in, of two plies their mean.
Tensors layered_stress(const Mesh& mesh, const Elastic& material, const Points& displacement);

}  // namespace dygita
