// Directions of nodes that a step holds or moves: linear conditions live in the operator, not in the iteration.
#pragma once

#include <functional>
#include <unordered_map>
#include <vector>

#include "interfaces/state.hpp"
#include "model/load.hpp"

namespace dygita {

// A motion common to all nodes of one load or accelerated support: a scalar velocity in time.
struct Motion {
  // Velocity at the end of increment i, of increments of dt (m/s). In a static step the displacement of the increment,
  // m.
  std::function<double(int increment, double dt)> velocity;
  // Velocity (m/s) that a dynamic step of increments of dt starts with; empty: rest.
  std::function<double(double dt)> at_start = nullptr;
  // Nodes have that velocity at once when the step starts, whatever they had before.
  bool is_taken_up = false;
};

// Held directions of one node: orthonormal; each moves as a combination of motions (none: it rests).
struct Held {
  int n = 0;
  Mat3 directions = Mat3::Zero();                             // first n columns
  Mat3 given = Mat3::Zero();                                  // likewise, as whoever holds it has them: not orthogonal
  std::array<std::vector<std::pair<int, double>>, 3> motion;  // (index in Conditions::motions, factor)
  std::array<const Support*, 3> support{};                    // who holds it, null for a load
  bool is_absorbed = false;                                   // an absorbing support is among those that stand here

  // Is direction j held by a support or a prescribed motion? Else the program has pinned it against a free motion.
  bool is_held(int j) const { return support[static_cast<size_t>(j)] || !motion[static_cast<size_t>(j)].empty(); }
  // An orthonormal basis of what is left free: 3 x (3 - n).
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> free_basis() const;
};

struct Conditions {
  std::vector<std::unordered_map<int, Held>> held;  // one map a substructure: node -> held directions
  std::vector<Motion> motions;

  const Held* at(int part, int node) const;
};

// Displacements (m) of some nodes of each substructure.
using NodeMotions = std::vector<std::unordered_map<int, Vec3>>;

// Supports in force and prescribed motions of a step. moved: where nodes whose displacement it prescribes are when it
// begins, of static steps (none: where the deck has put them). Throws InputError when a motion is prescribed where
// something else already holds the node, and when two supports move a node in two ways.
Conditions make_conditions(const Problem& problem, const Step& step, const State& start, const NodeMotions& moved = {});

// Nodes of each substructure whose displacement the loads of a step prescribe; empty in a dynamic step.
std::vector<std::vector<int>> prescribed_nodes(const Problem& problem, const Step& step);

// A value over a step: what the number or history means in a static and in a dynamic step.
struct LoadValue : TimeValue {
  double from = 0.0;  // reached in the step before

  // Static: at the end of increment i of n (i = 0 .. n - 1; i = -1 is the start).
  double at_static(int i, int n) const;
  // Dynamic: mean over [t0, t1].
  double mean(double t0, double t1) const { return history.integral(t0, t1) / (t1 - t0); }
};

// Key in State::reached of a value of a load: its name and the nodes that it is on, whatever these are called. Forces
// on the nodes of a face are others than those on a region of the same nodes; a motion is the same.
std::string force_key(const std::string& value, const FaceOrRegion& on);
std::string motion_key(const std::string& value, const FaceOrRegion& on);

}  // namespace dygita
