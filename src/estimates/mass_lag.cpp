#include "estimates/mass_lag.hpp"

#include "fem/assembly.hpp"
#include "fem/mass.hpp"

namespace dygita {

// What a uniform acceleration makes of the difference to the consistent mass, a pattern in balance within each cell,
// moves the nodes by a tiny field; its energy is found by conjugate gradients, preconditioned by the mass. The mean of
// the three directions.
double mass_lag(const Piece& piece, const Substructure& body) {
  constexpr int rounds = 10;  // to a hundredth: the pattern is that of single cells
  if (!piece.is_explicit() || !has_consistent_mass(*body.mesh)) return 0.0;
  const Vec& mass = piece.node_masses();
  const Vec missing = body.material.density * nodal_integrals(*body.mesh) - mass;
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    Points residual = Points::Zero(3, mass.size());
    residual.row(axis) = missing.transpose();
    const Vec inverse = mass.cwiseInverse();
    Points next = residual * inverse.asDiagonal(), along = next;
    double size = residual.cwiseProduct(next).sum();
    for (int i = 0; i < rounds && size > 0.0; ++i) {
      const Points image = piece.quick_elastic_force(along);
      const double length = size / along.cwiseProduct(image).sum();
      sum += length * size;  // twice the energy that this direction adds
      residual -= length * image;
      next = residual * inverse.asDiagonal();
      const double next_size = residual.cwiseProduct(next).sum();
      along = next + next_size / size * along;
      size = next_size;
    }
  }
  return sum / 3.0;
}

}  // namespace dygita
