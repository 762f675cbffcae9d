// What a file of another program asks for beside its meshes, in the units of the file.
#pragma once

#include <array>
#include <string>

#include "numerics/types.hpp"

namespace dygita {

struct FileAction {
  enum class Kind { held, moved, force, resultant, pressure, traction, gravity, spin, preload, shortening };
  Kind kind;
  std::string place;  // a set of nodes or a face of the model; empty: everywhere
  Vec3 value;  // of gravity, a traction, a force on each node or on a face, a motion; [0] of a pressure and of what
               // tightens; the axis of a spin
  std::array<bool, 3> along = {};
  std::string amplitude;        // its name; empty: none
  std::string where;            // "plate.inp:45"
  int n_nodes = 0;              // of the place
  double speed = 0.0;           // rad in the unit of time, of a spin
  Vec3 through = Vec3::Zero();  // the same, a point of its axis

  bool stays = false;  // held, or tightened, where it has come to
  int owner = -1;      // a node whose load it shares

  bool tightens() const { return kind == Kind::preload || kind == Kind::shortening; }
  bool is_on_faces() const {
    return kind == Kind::pressure || kind == Kind::traction || kind == Kind::resultant || tightens();
  }
  bool is_everywhere() const { return kind == Kind::gravity || kind == Kind::spin; }
};

// A mass with its inertia behind nodes, which it moves rigidly or whose mean it moves with.
struct FileBody {
  std::string place;  // a set of nodes of the model, which has a face
  double mass;        // 0: none, and inertia is the square of a radius
  Mat3 inertia;       // about its centre of mass
  Vec3 at;            // that
  bool is_mean;       // of the nodes alike
  std::string where;
  std::string weights = "nodes";  // of a mean, or "area"
};

// Springs between the mean motions of two sets of nodes, or of one and the ground: along axes, and about them.
struct FileSpring {
  std::string one, other;  // other: empty, the ground
  std::array<double, 6> stiffness{}, damping{};
  Mat3 axes;
  std::string where;
};

}  // namespace dygita
