#include "latin/search_direction.hpp"

#include <cmath>

namespace dygita {

Vec search_directions(const StepModel& model, double multiplier, int n_window) {
  Vec k = Vec::Zero(model.n_q());
  for (const Port& port : model.exchange.ports) {
    const Piece& piece = *model.pieces[port.piece];
    const Elastic& material = piece.setup().body->part->material;
    for (int d = 0; d < 3; ++d) {
      if (port.unknown[d] < 0) continue;
      const double schur = piece.schur_diagonal()[port.unknown[d]];
      double& direction = k[model.unknown(port, d)];
      if (model.scheme.is_static) {
        // A body that only this unknown could hold has no stiffness of its own there.
        const double reference = piece.setup().rows[port.unknown[d]].reference_stiffness;
        direction = piece.is_mostly_interface() ? piece.setup().rows[port.unknown[d]].static_stiffness
                                                : std::max(schur, 1e-3 * reference);
        continue;
      }
      const double mass = piece.node_mass(port.piece_node);
      const double speed = d == 0 ? material.p_wave_speed() : material.s_wave_speed();
      const double impedance = material.density * speed * port.area;
      if (n_window > 5) {
        direction = impedance;
        continue;
      }
      const double k_step = std::hypot((1.0 - model.scheme.g) * impedance, mass / model.scheme.dt);
      direction = piece.is_mostly_interface() ? k_step : std::pow(schur, 0.75) * std::pow(k_step, 0.25);
    }
  }
  return multiplier * k;
}

}  // namespace dygita
