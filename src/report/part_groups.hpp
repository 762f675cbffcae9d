// Equal parts, upper[1] to upper[24], screw 1 to screw 6, shown as one.
#pragma once

#include <string>
#include <vector>

#include "files/run_folder.hpp"

namespace dygita {

struct PartGroup {
  std::string name;  // "upper[1] to upper[24]", of a part by itself its own
  size_t first;      // its first part
  size_t n = 1;
};

// Parts (of run.json) that are called stem[i], in the order of the first of each, with the same material and mesh:
// one group. So are three or more whose names differ by numbers alone.
std::vector<PartGroup> part_groups(const Json& parts);

// The group of each part.
std::vector<int> group_of_parts(const Json& parts);

}  // namespace dygita
