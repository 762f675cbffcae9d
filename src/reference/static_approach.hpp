// Brings a static increment near its solution, however many parts are joined by contact alone, preloads
// included (manual, eq. R8-R9).
#pragma once

#include "numerics/dense.hpp"
#include "reference/interface_rows.hpp"
#include "step/preload.hpp"
#include "step/tangent_steps.hpp"

namespace dygita {

// Newton's method with the laws' slopes between bounds, damped, friction limited a step behind: what is solved in
// between is convex.
class StaticApproach {
 public:
  // All outlive this object.
  // plain: a factor for every set of slopes.
  StaticApproach(const InterfaceRows& rows, const std::vector<Preload>& preloads, bool plain)
      : rows_(&rows), preloads_(&preloads), plain_(plain) {}

  // From reduced forces f to those closer to a solution: to `near`, relative, or as near as `most` iterations come.
  // Gives the records the shortenings that go with them. Returns the number of iterations.
  int approach(Vec& f, std::vector<PointRecord>& records, const Increment& increment, int i_increment, double near,
               int most);

 private:
  using Fields = InterfaceRows::Fields;
  Fields fields(const Vec& f, std::vector<PointRecord>& records, const std::vector<double>& limits);
  int take_slopes(const Fields& now, const std::vector<PointRecord>& records);
  void factorise();
  Vec times(const Vec& x) const;
  Vec step(const Fields& now);
  Vec times_slopes(const Vec& x) const;

  const InterfaceRows* rows_;
  const std::vector<Preload>* preloads_;
  Increment increment_;
  int i_increment_ = 0;
  TangentSteps steps_;
  bool plain_;
  std::vector<Mat3> slopes_;  // M of each point, N/m
  double slopes_softest_ = 0;
  LuFactor transposed_;
  enum class Factor { none, of_other_slopes, of_these } factor_ = Factor::none;
};

}  // namespace dygita
