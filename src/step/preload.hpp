// Preloads of a static step: interfaces whose shortening d is found so that the force through them is the one asked for
// (manual, eq. B1).
#pragma once

#include <functional>

#include "step/point_record.hpp"

namespace dygita {

struct Preload {
  const Interface* interface = nullptr;
  std::vector<int> points;  // of the exchange
  LoadValue force;          // N, tension positive; ramped from what the interface carried at the step's start

  // N, at the end of an increment of a step of n.
  double target(int increment, int n) const { return force.at_static(increment, n); }
};

// Those of a step; records: of all its points, as the step starts.
std::vector<Preload> make_preloads(const StepModel& model, const std::vector<PointRecord>& records);

// The d at which `force`, which does not decrease with d, is `target` to `precision` times scale: by secants, kept
// between what is known to be too little and too much. Exact in one step where the law is linear, in a few where it is
// piecewise linear. start, m; slope: a guess of d force / d d (N/m), the stiffest there can be; scale: of forces, N.
// Where no d within `furthest` (m) of the start brings the force, the one that came closest.
double find_shortening(const std::function<double(double)>& force, double target, double start, double slope,
                       double scale, double precision = 1e-14, double furthest = 1e3);

// Gives a preload's points the shortening at which their normal forces add up to target (N), for their trials (s, y) as
// they stand: no more than a scalar equation.
void shorten(const StepModel& model, const Preload& preload, double target, const Increment& increment,
             std::vector<PointRecord>& records);

// Throws NumericalError where forces (N) found for shortenings within the assembly's size are not even half of those
// asked for.
void check_reached(const Step& step, int increment, const std::vector<const Interface*>& interfaces, const Vec& force,
                   const Vec& target);

}  // namespace dygita
