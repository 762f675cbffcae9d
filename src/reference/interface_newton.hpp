// The nonlinear system of an increment on the law rows, by a semi-smooth Newton method (manual, eq. R5-R7).
#pragma once

#include "numerics/dense.hpp"
#include "reference/interface_rows.hpp"

namespace dygita {

class InterfaceNewton {
 public:
  // rows outlives this object.
  InterfaceNewton(InterfaceRows& rows, const MonolithicSettings& settings);

  struct Outcome {
    int iterations = 0;
    double residual = 0.0;  // relative, as LATIN's indicator is
    double distance = 0.0;  // W, what the residual is of: sum Y phi^2
    bool converged = true;
    bool is_apart = false;  // a singular system has been "solved" by going very far
  };
  // Starts from the records' forces.
  void start(const std::vector<PointRecord>& records);
  // Solves for the records' forces, from the reduced forces at hand, and completes their trials. Throws NumericalError.
  Outcome solve(std::vector<PointRecord>& records, const Increment& increment);
  // Throws NumericalError where the sides of an interface have moved apart.
  void check_together(const Outcome& outcome) const;
  Vec& reduced_force() { return f_; }
  const MonolithicSettings& settings() const { return settings_; }

 private:
  using Fields = InterfaceRows::Fields;
  void factorise(const Fields& fields, const std::vector<PointRecord>& records, const Increment& increment);
  Vec direction(const Vec& phi) const;
  void sweep(Vec& f, const std::vector<PointRecord>& records, const Increment& increment) const;

  InterfaceRows* rows_;
  const MergedAssembly* assembly_;
  MonolithicSettings settings_;
  Vec f_;
  std::vector<int> active_, passive_;  // rows in and out of the factorised tangent
  Mat tangent_passive_;                // (active x passive)
  LuFactor lu_;
  bool has_factor_ = false;
};

}  // namespace dygita
