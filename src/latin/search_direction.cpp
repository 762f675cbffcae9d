#include "latin/search_direction.hpp"

#include <cmath>

namespace dygita {

Vec search_directions(const StepModel& model, double multiplier, int n_window) {
  Vec k = Vec::Zero(model.n_q());
  for (const Port& port : model.exchange.ports) {
    const Piece& piece = *model.pieces[port.piece];
    const Elastic& material = model.problem->substructures[port.part]->material;
    for (int d = 0; d < 3; ++d) {
      if (port.unknown[d] < 0) continue;
      const double schur = piece.schur_diagonal()[port.unknown[d]];
      double& direction = k[model.unknown(port, d)];
      if (model.scheme.is_static) {
        // A body that only this unknown could hold has no stiffness of its own there.
        const double reference = piece.setup().rows[port.unknown[d]].reference_stiffness;
        direction = std::max(schur, 1e-3 * reference);
        continue;
      }
      const double dt = model.scheme.dt, mass = piece.node_mass(port.piece_node);
      const double speed = d == 0 ? material.p_wave_speed() : material.s_wave_speed();
      if (n_window > 5) {
        direction = material.density * speed * port.area;
        continue;
      }
      const double local_cfl = material.p_wave_speed() * dt * material.density * port.area / (2.0 * mass);
      const double k_step = std::hypot((1.0 - model.scheme.g) * material.density * speed * port.area, mass / dt);
      direction = local_cfl <= 2.0 ? schur : std::sqrt(k_step * schur);
    }
  }
  return multiplier * k;
}

}  // namespace dygita
