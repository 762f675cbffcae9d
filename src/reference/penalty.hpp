// Springs in place of the laws that have a penalty form (manual, eq. X8-X12).
#pragma once

#include "law/penalty_form.hpp"
#include "reference/internal_force.hpp"
#include "step/point_record.hpp"

namespace dygita {

class PenaltySprings {
 public:
  // Springs of a step whose points start with these records; points of interfaces that `is_tied` says to be held
  // otherwise have none. first: of each part's dofs.
  PenaltySprings(const StepModel& model, const std::vector<PointRecord>& start, const std::vector<char>& is_tied,
                 const InternalForce& internal);

  int size() const { return static_cast<int>(springs_.size()); }
  // Lets the springs of released interfaces go; returns the energy (J) that was in penalty springs.
  double release(const StepModel& model, int increment);
  // Adds the force (N, as internal force: M a = external - force) for the displacements since the step's start.
  void add_force(const Vec& displacement, Vec& force);
  // The same with every spring closed and sticking: what stability has to reckon with.
  void add_closed_force(const Vec& displacement, Vec& force) const;
  // Counts the present forces with this weight in the mean that `show` will give.
  void weigh(double weight);

  // Elastic energy in penalty springs now, J.
  double energy() const;
  // Means of the increment and present states into the records and the surfaces, works into the energies.
  void show(const StepModel& model, std::vector<PointRecord>& records, State& state);
  // The forces now in place of the means: what the next step starts from.
  void keep(const StepModel& model, std::vector<PointRecord>& records, State& state) const;
  double bytes() const { return static_cast<double>(springs_.size() * sizeof(Spring)); }

 private:
  // A node that moves with a side, and what it adds to its motion.
  struct MovedNode {
    int dof;
    Mat3 block;
  };
  struct Spring {
    int point, dof_1 = -1, dof_2 = -1;      // dof_2 < 0: a wall
    std::vector<MovedNode> side_1, side_2;  // in their place where faces do not match
    const PenaltyForm* form;
    Mat3 frame;
    SpringPoint at;
    bool is_released = false;
    Vec3 sum = Vec3::Zero();
    double weight = 0.0;
  };
  Vec3 jump_of(const Spring& spring, const Vec& displacement) const;
  static void put(const Spring& spring, const Vec3& force, Vec& all);

  std::vector<Spring> springs_;
};

}  // namespace dygita
