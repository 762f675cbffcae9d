#include "model/bolt_formula.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hpp"

namespace dygita {

namespace {

constexpr double pi = std::numbers::pi;

double disc(double diameter) { return 0.25 * pi * diameter * diameter; }

// Shank and free thread, and what head, engaged thread and nut give: as lengths of 0.5 d, 0.5 d and 0.4 d (0.33 d in a
// tapped hole, of the plates' modulus).
double resilience_of_bolt(const BoltDimensions& b) {
  const double shank = disc(b.diameter), core = disc(b.core);
  const double in_grip = (b.grip - b.thread) / shank + b.thread / core;
  const double head = 0.5 * b.diameter / shank, engaged = 0.5 * b.diameter / core;
  const double nut = (b.is_tapped ? 0.33 : 0.4) * b.diameter / shank;
  return (in_grip + head + engaged) / b.young + nut / (b.is_tapped ? b.plate_young : b.young);
}

// Cones from the bearing surfaces, and a sleeve where they reach the outer diameter. w: 1 with a nut (two cones), 2
// without (one).
double resilience_of_plates(const BoltDimensions& b) {
  if (b.outer <= b.head) return b.grip / (b.plate_young * (disc(b.outer) - disc(b.hole)));
  const double w = b.is_tapped ? 2.0 : 1.0, beta = b.grip / b.head, y = b.outer / b.head;
  const double slope = b.is_tapped ? 0.348 + 0.013 * std::log(beta) + 0.193 * std::log(y)
                                   : 0.362 + 0.032 * std::log(0.5 * beta) + 0.153 * std::log(y);
  const double tangent = std::max(slope, 0.05);  // the fit leaves its range for a grip of a hundredth of the head
  const double widest = std::min(b.head + w * b.grip * tangent, b.outer);
  const double cones = 2.0 / (w * b.hole * tangent) *
                       std::log((b.head + b.hole) * (widest - b.hole) / ((b.head - b.hole) * (widest + b.hole)));
  const double sleeve = 4.0 / (widest * widest - b.hole * b.hole) * (b.grip - (widest - b.head) / (w * tangent));
  return (cones + sleeve) / (pi * b.plate_young);
}

}  // namespace

BoltResilience bolt_resilience(const BoltDimensions& b) {
  CHECK(b.diameter > 0.0 && b.hole >= b.diameter && b.head > b.hole && b.outer > b.hole && b.core > 0.0 &&
            b.core <= b.diameter && b.thread >= 0.0 && b.thread <= b.grip && b.young > 0.0 && b.plate_young > 0.0,
        "dimensions of a bolt");
  return {resilience_of_bolt(b), resilience_of_plates(b)};
}

}  // namespace dygita
