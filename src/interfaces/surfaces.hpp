// Where substructures meet each other or a rigid wall: the points of every interface and wall of a problem.
#pragma once

#include <memory>
#include <vector>

#include "meeting/facing.hpp"
#include "model/model.hpp"

namespace dygita {

// An interface, or a wall support seen as an interface with a rigid side 2. Independent of the step.
struct Surface {
  const Interface* interface = nullptr;
  const Support* wall = nullptr;
  int part_1 = -1, part_2 = -1;  // index in problem.substructures; -1: rigid
  Facing facing;
  LawPtr law;                   // of its points; null: a tie in all steps, the sides become a group
  bool is_on_ground = false;    // a wall, or an equation whose factors do not cancel: a part alone is held by it
  bool is_of_rotation = false;  // a spring about an axis: what acts at its point is a moment over a length

  // The law of the interface or the wall, ties included.
  const Law& declared_law() const {
    return interface ? *interface->law : facing.is_of_sums() ? *law : *wall->kind->law();
  }
  const std::string& name() const { return interface ? interface->name : wall->name; }
  int n_points() const { return facing.n_points(); }
};

// All interfaces in the problem's order, then every wall support used in a step, one Surface a face of it.
// Throws InputError when faces do not meet or overlap another interface's. has_checked_parts: an earlier run of the
// same parts has looked for seams within them.
std::vector<Surface> make_surfaces(const Problem& problem, bool has_checked_parts = false);

// Whether a surface has a part in a step: walls are supports in it, laws carry forces in steps of its kind.
bool takes_part(const Problem& problem, const Step& step, const Surface& surface);

}  // namespace dygita
