// The nonlinear system of an increment on the law rows, by a semi-smooth Newton method (manual, eq. R5-R7).
//
// Unknown: the reduced forces f. rate = free - W f, F = f + R (rate - held), and at every point F = law(rate + Y F).
#pragma once

#include <Eigen/LU>

#include "reference/merged_assembly.hpp"
#include "solution/point_record.hpp"

namespace dygita {

class InterfaceNewton {
 public:
  InterfaceNewton(const StepModel& model, const MergedAssembly& assembly, const MonolithicSettings& settings);

  struct Outcome {
    int iterations = 0;
    double residual = 0.0;  // relative, as LATIN's indicator is
    double distance = 0.0;  // W, what the residual is of: sum Y phi^2
    bool converged = true;
    bool is_apart = false;  // a singular system has been "solved" by going very far
  };
  // Solves for the records' forces, from those at hand, and completes their trials. Throws NumericalError.
  Outcome solve(std::vector<PointRecord>& records, const Increment& increment);
  // Throws NumericalError where the sides of an interface have moved apart.
  void check_together(const Outcome& outcome) const;
  const Vec& reduced_force() const { return f_; }
  // Keeps increments where nothing happens from iterating on round-off: energy seen so far, J.
  void raise_floor(double energy, double dt) { floor_ = std::max(floor_, 1e-12 * energy / dt); }

 private:
  struct Residual {
    Vec phi;                            // F - law(rate + Y F), N
    double distance = 0.0, size = 0.0;  // W
  };
  Residual evaluate(const Vec& f, const std::vector<PointRecord>& records, const Increment& increment) const;
  Trial trial_of(size_t i_point, const Vec& rate, const Vec& force, const PointRecord& record) const;
  Vec rate_of(const Vec& f) const { return assembly_->free_rate() - assembly_->compliance() * f; }
  Vec force_of(const Vec& f, const Vec& rate) const;
  Mat3 law_tangent(size_t i_point, const Trial& trial, const PointRecord& record, const Increment& increment) const;
  void factorise(const Vec& f, const std::vector<PointRecord>& records, const Increment& increment);
  Vec direction(const Vec& phi) const;
  void sweep(Vec& f, const std::vector<PointRecord>& records, const Increment& increment) const;
  double relative(const Residual& r) const;

  const StepModel* model_;
  const MergedAssembly* assembly_;
  MonolithicSettings settings_;
  Vec y_, f_;
  std::vector<int> active_, passive_;  // rows in and out of the factorised tangent
  Mat tangent_passive_;                // (active x passive)
  Eigen::PartialPivLU<Mat> lu_;
  bool has_factor_ = false;
  double largest_ = 0.0, floor_ = 0.0;
  double extent_ = 0.0;  // m, of all substructures
};

}  // namespace dygita
