// The facets of a joint laid flat, with what each held at a few instants.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "result/scenes.hpp"

namespace dygita {

struct JointMap {
  bool is_flat = false;  // false: turns by more than a right angle and cannot be laid flat; nothing else is filled
  double width = 0.0, height = 0.0;                       // m
  std::string across, up;                                 // the assembly's axes nearest to the map's: "x", "-z"
  std::vector<std::vector<std::array<double, 2>>> cells;  // corners, m, from the lower left
  std::vector<std::vector<int>> points;                   // of the joint that each cell stands for
};

// Seen from the positive side of the axis that its mean normal is nearest to. A coarse joint is divided at its nodes,
// so that each node shows; nodes of a fine one are merged until there are at most `most_cells` cells.
JointMap make_joint_map(const JointScenes& joint, int most_cells = 400);

// Of a cell: the state of most of its points (the more severe one of equals: open before slip before stick), the mean
// value.
int state_of_cell(const std::vector<unsigned char>& status, const std::vector<int>& points);
double mean_of_cell(const std::vector<float>& values, const std::vector<int>& points);

}  // namespace dygita
