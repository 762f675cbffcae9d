// What a file of another program asks for beside its meshes, in the units of the file.
#pragma once

#include <array>
#include <string>

#include "numerics/types.hpp"

namespace dygita {

struct FileAction {
  enum class Kind { held, moved, force, pressure, traction, gravity };
  Kind kind;
  std::string place;  // a set of nodes or a face of the model; empty: everywhere
  Vec3 value;         // of gravity, a traction, a force on each node, a motion; [0] of a pressure
  std::array<bool, 3> along = {};
  std::string amplitude;  // its name; empty: none
  std::string where;      // "plate.inp:45"
  int n_nodes = 0;        // of the place

  bool is_on_faces() const { return kind == Kind::pressure || kind == Kind::traction; }
};

}  // namespace dygita
