// Can contacts balance the loads of a static increment at all? Bodies that are tied to each other are rigid here, every
// gap may close, and friction is a little more than it is: where even so no forces do, there is no equilibrium.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "step/observer.hpp"

namespace dygita {

// Bodies that the loads move, tied to each other, and how: no force of a contact is in the way of that.
struct RigidImbalance {
  std::vector<int> parts;
  Vec3 along = Vec3::Zero();  // unit: of their middle, or the axis about which they turn
  bool turns = false;         // more than they move
  int n_points = 0;           // of contact, that they have
  std::vector<std::string> joints;
};

// The first of them, those that move most; empty: there is none, or nothing is proven (on several ranks, of many
// bodies).
std::optional<RigidImbalance> rigid_imbalance(const Instant& instant);

}  // namespace dygita
