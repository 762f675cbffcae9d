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
  // Throws NumericalError where the sides of an interface have moved too far apart.
  void check_together(const Outcome& outcome) const;
  Vec& reduced_force() { return f_; }
  const MonolithicSettings& settings() const { return settings_; }

 private:
  using Fields = InterfaceRows::Fields;
  using Tangents = std::vector<Mat3>;  // of the law at each point: force by trial
  Tangents tangents_at(const Fields& fields, const std::vector<PointRecord>& records, const Increment& increment) const;
  void factorise(const Tangents& tangents);
  Vec times(const Tangents& tangents, const Vec& x) const;
  Vec factor_solve(const Vec& phi) const;
  Vec direction(const Tangents& tangents, const Fields& now);
  bool is_apart(const Fields& now) const;
  void sweep(Vec& f, const std::vector<PointRecord>& records, const Increment& increment) const;

  InterfaceRows* rows_;
  const MergedAssembly* assembly_;
  MonolithicSettings settings_;
  Vec f_;
  // Of the tangents that were factorised: rows in the factor, and out of it.
  std::vector<int> active_, passive_;
  Mat tangent_passive_;  // passive x active, transposed as the factor is
  LuFactor transposed_;
  bool has_factor_ = false;
};

}  // namespace dygita
