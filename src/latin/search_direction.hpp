// Search directions k, chosen from the interface's own operators: no constant asked of the user (manual, search
// directions).
#pragma once

#include "step/step_model.hpp"

namespace dygita {

// k of every unknown (length n_q). Static: diagonal of the Schur complement S0. Dynamic: S0^(3/4) k_step^(1/4),
// k_step^2 = ((1-g) rho c A)^2 + (m/dt)^2. Windows of many steps (n_window > 5): the impedance rho c A, since there a
// wave crosses and returns within the window. Bonded sides whose faces do not match come together to their
// geometric mean, by a factor of four at most, in dynamic steps.
Vec search_directions(const StepModel& model, double multiplier, int n_window);

// Gives every piece its own of k; pieces side by side on the threads at hand. Throws NumericalError.
void fix_search_directions(StepModel& model, const Vec& k);

}  // namespace dygita
