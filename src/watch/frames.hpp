// Frames for ParaView of an instant.
#pragma once

#include "fem/free_surface.hpp"
#include "result/frame.hpp"
#include "watch/followed_motion.hpp"

namespace dygita {

// All fields of every interface, and the names of those of every substructure, which are filled in where it is
// (part_frames.hpp); without a label_time.
Frame make_frame(const Instant& instant, const std::vector<std::string>& fields, const FollowedMotion& motion);

// Motion of the nodes of a mesh, 3 x n_nodes each, m, m/s, m/s^2; empty where it is not wanted.
struct NodalMotion {
  Points displacement, velocity, acceleration;
  double growth = 0.0;  // strain that does not stress it
};
// The fields that a substructure's frame names at all nodes of its mesh, or of a part of it. free: cells of that at
// whose facets nothing acts.
void fill_part(const Mesh& mesh, const NodalMotion& motion, const std::vector<FreeCell>& free, PartFrame& frame);
// Components of a field of substructures; of none that is here it has no columns.
int components_of(const std::string& field);

}  // namespace dygita
