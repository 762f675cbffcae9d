#include "latin/search_direction.hpp"

#include <cmath>

#include "base/parallel.hpp"

namespace dygita {

Vec search_directions(const StepModel& model, double multiplier, int n_window) {
  Vec k = Vec::Zero(model.n_q());
  for (const Port& port : model.exchange.ports) {
    const Piece& piece = *model.pieces[port.piece];
    const Elastic& material = model.cut->piece(port.piece).body->material;
    const bool has_schur = piece.schur_diagonal().size() > 0;
    for (int d = 0; d < 3; ++d) {
      if (port.unknown[d] < 0) continue;
      const InterfaceRow& row = piece.rows()[port.unknown[d]];
      const double schur = has_schur ? piece.schur_diagonal()[port.unknown[d]] : 0.0;
      double& direction = k[model.unknown(port, d)];
      if (piece.is_explicit()) {  // its answer is known, whatever q is
        direction = schur;
        continue;
      }
      if (model.scheme.is_static) {
        // A body that only this unknown could hold has no stiffness of its own there.
        direction = has_schur ? std::max(schur, 1e-3 * row.reference_stiffness) : row.static_stiffness;
        continue;
      }
      const double mass = piece.node_masses()[port.piece_node];
      const double speed = d == 0 ? material.p_wave_speed() : material.s_wave_speed();
      const double impedance = material.density * speed * port.area;
      if (n_window > 5) {
        direction = impedance;
        continue;
      }
      const double k_step = std::hypot((1.0 - model.scheme.g) * impedance, mass / model.scheme.dt);
      direction = has_schur ? std::pow(schur, 0.75) * std::pow(k_step, 0.25) : k_step;
    }
  }
  return multiplier * k;
}

void fix_search_directions(StepModel& model, const Vec& k) {
  for (const bool shares : {false, true})  // those whose operators others share come first
    parallel_for(static_cast<int>(model.pieces.size()), [&](int i) {
      Piece& piece = *model.pieces[i];
      if (piece.shares_operator() == shares) piece.set_search_directions(k.segment(model.offset[i], piece.n_rows()));
    });
}

}  // namespace dygita
