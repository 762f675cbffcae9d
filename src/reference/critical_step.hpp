// The longest stable step of central differences (manual, eq. X2, X3).
#pragma once

#include "reference/penalty.hpp"
#include "reference/shared_nodes.hpp"

namespace dygita {

// Highest frequency (rad/s) of the assembly as it moves, every spring closed, by Lanczos' iteration: within a percent,
// from above; zero where nothing can move.
double highest_frequency(InternalForce& internal, const PenaltySprings& springs, const SharedNodes& shared,
                         const Vec& mass);

// Courant's limit for that frequency and damping that lags behind (linear bulk viscosity, stiffness damping), s.
double critical_step(double frequency, const InternalForce& internal);

}  // namespace dygita
