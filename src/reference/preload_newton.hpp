// Shortenings that bring the forces asked for, around the reference's own solution for given ones (manual, the
// monolithic reference).
#pragma once

#include "reference/interface_newton.hpp"
#include "reference/static_approach.hpp"

namespace dygita {

class PreloadNewton {
 public:
  // rows outlives this object. records: of all points, as the step starts; tolerance: of the forces, relative.
  PreloadNewton(const InterfaceRows& rows, const std::vector<PointRecord>& records, double tolerance, bool plain);

  // Solves the increment; without preloads, just the interfaces. The records' shortenings are those found.
  InterfaceNewton::Outcome solve(InterfaceNewton& newton, std::vector<PointRecord>& records, const Increment& increment,
                                 int i_increment);

 private:
  // From as near to the solution as `near`, relative.
  InterfaceNewton::Outcome attempt(InterfaceNewton& newton, std::vector<PointRecord>& records,
                                   const Increment& increment, int i_increment, double near);
  Vec search(Vec& d);
  double error(const Vec& force) const;  // relative
  Vec forces(const Vec& d);
  void one_by_one(Vec& d);
  Mat slopes(const Vec& d, const Vec& force);

  const StepModel* model_;
  std::vector<Preload> preloads_;
  StaticApproach approach_;
  Vec stiffest_;   // N/m, of each preload
  double extent_;  // m, of all substructures
  double tolerance_;
  // Of the increment at hand.
  Vec target_;
  double scale_ = 0.0;
  std::function<InterfaceNewton::Outcome()> solve_;
  std::vector<PointRecord>* records_ = nullptr;
  InterfaceNewton::Outcome outcome_;
  int n_iterations_ = 0, n_in_vain_ = 0;
};

}  // namespace dygita
