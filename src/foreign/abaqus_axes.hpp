// Axes of nodes by *TRANSFORM, and what is held or loaded along them, in the axes of the file.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "foreign/cards.hpp"
#include "numerics/types.hpp"

namespace dygita {

// Along x, y and z whether, then by how much.
using AxesSaying = std::array<double, 6>;

// Axes of a node. R: the first through a point, in a plane with another; C: from a line through two outwards, around
// it, along it.
Mat3 axes_of_node(const CardFile& file, const FileCard& card, bool is_cylinder, const std::array<Vec3, 2>& points,
                  const Vec3& x);

AxesSaying forced_in(const Mat3& axes, const Vec3& by);

// What is held along some axes: as axes of the file where they, or what they leave free, are such; the other directions
// by themselves. Throws InputError where a node moves along these.
struct HeldInAxes {
  AxesSaying says{};
  std::vector<Vec3> oblique;  // unit, their first component that is not 0 positive
};
HeldInAxes held_in(const Mat3& axes, const AxesSaying& own, const std::string& where);

// Nodes that are held along an oblique direction: a set of them all, and one of each.
struct ObliqueHold {
  std::string place;
  std::vector<std::string> nodes;
  Vec3 along;
  std::string where;
};

}  // namespace dygita
