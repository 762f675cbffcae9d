// Nodes that do not move as they please: tied to copies of themselves, held or moved, or on an absorbing support
// (manual, eq. X1). Copies that are tied share one motion; what they do to each other is found afterwards.
#pragma once

#include <utility>

#include "reference/internal_force.hpp"
#include "step/make_pieces.hpp"

namespace dygita {

// A change of velocities by external - internal forces over tau (s). theta: share of the new velocity in what drags;
// motions: velocities of the prescribed motions after it.
struct Kick {
  const Vec& external;  // N
  double tau, theta;
  const std::vector<double>& motions;
};

class SharedNodes {
 public:
  // is_tied: of each surface, whether its two sides are held together all through the step.
  SharedNodes(const StepModel& model, const std::vector<char>& is_tied, const InternalForce& internal);

  // Gives every copy the mean of a field, weighted with their masses.
  void average(Vec& field) const;
  // Velocities after a kick.
  void kick(const Kick& kick, const Vec& internal, Vec& velocity);
  // Of a dof, those that it moves with; -1: its node moves by itself.
  int group_of(int dof) const { return group_of_node_[dof / 3]; }
  // Velocity (m/s) of a group after a kick, and its change by a further force (m/(N s)).
  Vec3 velocity_after(int group, const Kick& kick, const Vec& internal, const Vec& velocity) const;
  Mat3 mobility(int group, const Kick& kick) const;
  // Sums a field of forces over copies and takes held directions off: M^-1 of that is an acceleration they can have.
  void restrict_force(Vec& force) const;

  // Works since the last call, J: of what moves held nodes, and of absorbing supports.
  double take_motion_work() { return std::exchange(motion_work_, 0.0); }
  double take_absorbed_work() { return std::exchange(absorbed_work_, 0.0); }

  // Ends an increment of dt that began with these velocities: splits what each copy feels between its ties, shown in
  // the state's surfaces, and its support.
  void end_increment(const Vec& velocity_old, const Vec& velocity, double dt, State& state);
  // Of the last increment, on a part's nodes: supports and prescribed motions; absorbing supports.
  void add_reactions(int part, Points& force) const;
  void add_absorbing(int part, Points& force) const;

  // Mass (kg) that a dof moves with: its node's own or all copies'.
  const Vec& moved_mass() const { return moved_mass_; }
  bool is_shared(int dof) const { return group_of(dof) >= 0; }
  double bytes() const;

 private:
  struct Copy {
    int part, node, dof;
    double mass;
    Mat3 impedance = Mat3::Zero();                           // N s/m
    Vec3 impulse = Vec3::Zero();                             // N s, of net forces in the increment
    Vec3 drag = Vec3::Zero();                                // N s, of the absorbing support
    Vec3 reaction = Vec3::Zero(), absorbing = Vec3::Zero();  // N, means
  };
  struct Edge {
    int surface, point, copy_1, copy_2;
    double root_area;
  };
  struct Group {
    std::vector<Copy> copies;
    std::vector<Edge> edges;
    double mass = 0.0;
    Mat3 impedance = Mat3::Zero();
    bool absorbs = false, is_moved = false;
    Held held;              // of all copies together
    std::vector<Mat> free;  // of each copy, 3 x free directions
    Mat split;              // from the copies' free forces to the edges' weighted ones
  };
  void collect(const StepModel& model, const std::vector<char>& is_tied, const InternalForce& internal);
  template <class Visit>
  static void for_each_tie(const StepModel& model, const std::vector<char>& is_tied, const InternalForce& internal,
                           Visit&& visit);
  static void add_copy(const Copy& copy, Group& group);
  static Vec3 force_on(const Group& group, const Kick& kick, const Vec& internal);
  static Vec3 free_velocity(const Group& group, const Kick& kick, const Vec3& force, const Vec3& before);
  static Vec3 as_held(const Group& group, const Kick& kick, const Vec3& free);
  void hold(const StepModel& model, Group& group) const;
  static void make_split(const StepModel& model, Group& group);
  void split_forces(Group& group, const Vec& velocity_old, const Vec& velocity, double dt, State& state);

  std::vector<Group> groups_;
  std::vector<int> group_of_node_;
  Vec moved_mass_;
  double motion_work_ = 0.0, absorbed_work_ = 0.0;
};

}  // namespace dygita
