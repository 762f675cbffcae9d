// What a strip of a layup has against bending along axis 1 or 2 (direction 0 or 1), of its width.
#pragma once

namespace dygita {

class Layup;

// Against curvature (N m); across, with the shear stress that equilibrium gives each ply, and with one stress for all
// (N/m; manual, eq. Y14).
struct StripStiffness {
  double bending, shear, shear_of_one_stress;
};
StripStiffness strip_of(const Layup& layup, int direction);

}  // namespace dygita
