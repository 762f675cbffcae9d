// What a load does to the assembly: the few mechanisms that solvers know. Loads are many and solvers never ask which
// one they have; whoever visits an Effect answers for every mechanism, without a default.
#pragma once

#include <functional>

#include "model/bolt_formula.hpp"
#include "model/bolt_rating.hpp"
#include "model/model.hpp"

namespace dygita {

// Nodes that a load acts on, where they stand in space.
struct LoadedNodes {
  Points positions;  // 3 x n, m
  Vec weights;       // of each node: m^2, its part of a face (not positive at every node of one of order two); 1 in a
                     // region
  Points vectors;    // m^2, weight times outward normal; zero in a region, which has none
  Points moments;    // m^3, of a face: integral of the node's shape function times the place; in a region the place
};

// Forces on the nodes of a face or a region.
struct NodalForces {
  std::string name;  // of the value: one on each place
  FaceOrRegion on;
  TimeValue value;
  std::function<Points(const LoadedNodes&)> unit;  // 3 x n, N, for a value of one
};

// A force on every mass of every substructure.
struct BodyForce {
  std::string name;  // of the value
  TimeValue value;
  std::function<Vec3(const Vec3& position)> unit;  // m/s^2, for a value of one
};

// Nodes that move as told along some of the axes.
struct PrescribedMotion {
  std::string name;  // of the values: one on each place
  FaceOrRegion on;
  bool is_velocity = false;                       // m/s; else a displacement, m
  std::array<std::optional<TimeValue>, 3> along;  // x, y, z; none: free

  std::string name_along(int axis) const { return name + " " + "xyz"[axis]; }
};

// A support that is shaken.
struct BaseMotion {
  SupportPtr on;
  Vec3 direction;  // unit
  History acceleration;
};

// An interface whose sides are drawn together, as a nut does.
struct Tightening {
  InterfacePtr on;
  TimeValue value;
  std::optional<BoltDimensions> hand;  // the bolt that a hand formula is printed for
  double share = 1.0;                  // of that bolt, in the model
  std::optional<BoltRating> rating;    // what its margins are against
};
struct Shortening : Tightening {};    // by a length, m
struct PreloadForce : Tightening {};  // until a force goes through it, N: the shortening is found

// An interface that lets go for good.
struct Release {
  InterfacePtr on;
  double at = 0.0;  // s from the start of the step; from 0 to 1 in a static one
};

using Effect = std::variant<NodalForces, BodyForce, PrescribedMotion, BaseMotion, Shortening, PreloadForce, Release>;

// The effect as what tightens an interface; null where it is something else.
const Tightening* tightening(const Effect& effect);

}  // namespace dygita
