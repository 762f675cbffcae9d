// Frames for ParaView of an instant.
#pragma once

#include "result/followed_motion.hpp"
#include "result/frame.hpp"

namespace dygita {

// These fields of every substructure, and all of every interface; without a label_time.
Frame make_frame(const Instant& instant, const std::vector<std::string>& fields, const FollowedMotion& motion);

}  // namespace dygita
