// What a bolt may carry by its standard, and the joint that it clamps (manual, eq. B8-B11).
#pragma once

#include <string>
#include <vector>

#include "model/model.hpp"

namespace dygita {

struct BoltRating {
  double proof_load = 0.0;          // N, of the whole bolt
  double safety = 1.0;              // on what the loads do, not on the preload
  std::vector<InterfacePtr> joint;  // contacts that it clamps and that carry its shear; none: margins of slip and
                                    // separation are not asked for
};

// Nominal diameter and pitch (m) of a metric coarse thread (ISO 261, 262), tensile stress area (m^2, ISO 898-1), and
// the stress (Pa) that a class bears without permanent set: proof stress of ISO 898-1, 0.2 % of ISO 3506-1.
struct Thread {
  double diameter = 0.0, pitch = 0.0;
  double stress_area() const;
};
Thread thread_of(const std::string& size);
// Throws InputError on a class that has no bolt of that size.
double proof_stress(const std::string& property_class, const Thread& thread);

}  // namespace dygita
