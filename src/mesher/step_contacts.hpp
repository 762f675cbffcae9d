// Faces of CAD solids that touch, before anything is meshed: where cells should be small.
#pragma once

#include <map>
#include <vector>

namespace dygita {

struct StepContacts {
  std::vector<int> surfaces;  // tags of surfaces that lie on one of another volume
  std::vector<int> curves;    // that bound them
};

// Of gmsh's current model; surfaces_of: the surfaces of each volume; within: in the model's unit. Planes that face each
// other at the same place, cylinders of one axis and radius; both where their bounding boxes meet.
StepContacts step_contacts(const std::map<int, std::vector<int>>& surfaces_of, double within);

}  // namespace dygita
