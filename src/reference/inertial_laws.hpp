// Laws of rates in explicit steps: the law itself at each point, against the inertia of the nodes there (manual, eq.
// X14).
#pragma once

#include "reference/shared_nodes.hpp"
#include "step/point_record.hpp"

namespace dygita {

class InertialLaws {
 public:
  // The points of a step whose law is taken so.
  InertialLaws(const StepModel& model, const std::vector<PointRecord>& start, const InternalForce& internal,
               const SharedNodes& shared);

  void release(const StepModel& model, int increment);
  // Finds the forces (N) of a kick from the velocities (m/s) before it and adds them to `internal`.
  // inverse_mass: of dofs that move by themselves, 1/kg.
  void add_force(const Kick& kick, const SharedNodes& shared, const Vec& inverse_mass, const Vec& velocity,
                 Vec& internal);
  // Takes them off again.
  void remove_force(Vec& internal);

  // Means over an increment of dt into the records and the surfaces, works into the energies.
  void show(const StepModel& model, double dt, std::vector<PointRecord>& records, State& state);
  // The forces now in place of the means: what the next step starts from.
  void keep(const StepModel& model, const std::vector<PointRecord>& records, State& state) const;
  double bytes() const;

 private:
  // A node, with all that is tied to it.
  struct Mover {
    int dof = -1;
    Vec3 before = Vec3::Zero(), now = Vec3::Zero();  // m/s
    Mat3 mobility = Mat3::Zero();                    // m/(N s), velocity after the kick per force
  };
  struct InertialPoint {
    int point = -1, side_1 = -1, side_2 = -1;  // movers; side_2 < 0: a wall
    const Law* law = nullptr;
    bool has_springs = false;  // which show force and memory, and this adds to the force
    std::array<bool, 3> is_active{}, is_given{};
    LawState start;
    Vec3 force = Vec3::Zero(), impulse = Vec3::Zero();  // N now; N s in the increment
    Work work;                                          // in the increment
    bool is_released = false;
  };
  void find_movers(const Kick& kick, const SharedNodes& shared, const Vec& inverse_mass, const Vec& velocity,
                   const Vec& internal);
  void push(const InertialPoint& at, const Vec3& force);
  Vec3 rate(const InertialPoint& at, Vec3 Mover::*velocity) const;
  Trial trial_at(const InertialPoint& at) const;
  double sweep(const Increment& increment);
  void put(int dof, const Vec3& force, Vec& internal);

  const std::vector<Point>* all_;
  std::vector<Mover> movers_;
  std::vector<InertialPoint> points_;
  std::vector<std::pair<int, Vec3>> replaced_;  // entries of the internal forces as they were
};

}  // namespace dygita
