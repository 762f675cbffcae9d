// What every contact of a run did, step by step: for a table that nobody has to ask for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace dygita {

struct Problem;

// Of a static step the state at its end; of a dynamic one the extremes over its increments.
struct ContactStep {
  int step = -1;                        // index in problem.steps
  double lowest = 0.0, highest = 0.0;   // N, pressed
  double shear = 0.0;                   // N, largest
  double closed = 0.0;                  // smallest share of the area
  double opening = 0.0;                 // m, largest of the points that were closed when the step began
  Vec3 opening_at = Vec3::Zero();       // m, undeformed
  std::optional<double> sliding;        // largest share of the closed area; none without friction
  std::optional<double> slip;           // m, largest since the step began
  Vec3 slip_at = Vec3::Zero();          // m, undeformed
  std::optional<double> friction_used;  // largest shear over friction times what presses
};

struct ContactSummary {
  std::string name;        // of the interface or the wall
  std::vector<int> parts;  // indices in problem.substructures; of a wall one
  double area = 0.0;       // m^2
  double friction = 0.0;
  std::vector<ContactStep> steps;  // those it has a part in
};

// What touches, lets go or slides in a shock does so when and where dt and mesh decide, which no estimate sees.
bool contacts_change(const Problem& problem, const std::vector<ContactSummary>& contacts);

}  // namespace dygita
