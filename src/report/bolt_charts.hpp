// Bars of bolts: what their force has become, and what took it.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace dygita {

// Yielding of the bolt; other bolts and static loads; the joint in the motion.
inline constexpr size_t n_preload_takers = 3;

// %, of what its tightening gave.
struct BoltLoss {
  std::string name;
  double all, swing;
  std::array<double, n_preload_takers> by;
};

struct BoltForce {
  std::string name;
  double lowest, highest, last;
};

// SVG, a bar each. Losses from zero, on a scale that ends where they do.
std::string loss_chart(const std::vector<BoltLoss>& losses);
// What the force swings between in the motion, and where it ends.
std::string force_chart(const std::vector<BoltForce>& forces);

}  // namespace dygita
