// Frames for ParaView of an instant.
#pragma once

#include "result/followed_motion.hpp"
#include "result/frame.hpp"

namespace dygita {

// All fields of every interface, and the names of those of every substructure, which are filled in where it is watched
// (part_frames.hpp); without a label_time.
Frame make_frame(const Instant& instant, const std::vector<std::string>& fields, const FollowedMotion& motion);

// The fields that a substructure's frame names, from its displacement and these (3 x n_nodes, where they are wanted).
void fill_part(PartFrame& frame, const Points& velocity, const Points& acceleration);

}  // namespace dygita
