// What the local stage keeps and tells of an increment: the laws' memory, works, forces, gaps and residuals.
#include <algorithm>

#include "latin/local_stage.hpp"
#include "law/law.hpp"

namespace dygita {

// Those whose laws are iterated, on any rank, by the interface that loads act on.
void LocalStage::find_surfaces() {
  std::vector<double> is_iterated(model_->surfaces->size(), 0.0);
  for (const int i : model_->near.points()) {
    const Point& point = model_->exchange.points[i];
    for (const Member& member : point.members)
      if (point.law) is_iterated[static_cast<size_t>(member.surface)] = 1.0;
  }
  if (!model_->near.is_all()) is_iterated = ranks::sums(is_iterated);
  for (size_t s = 0; s < is_iterated.size(); ++s) {
    const Interface* interface = (*model_->surfaces)[s].interface;
    if (is_iterated[s] > 0.0 && interface && !model_->loads->preload(interface))
      interfaces_[static_cast<int>(s)] = interface;
  }
}

void LocalStage::accept(State* state, std::vector<IncrementEnergy>* energy) {
  if (state) follow_loads(*state);
  for (const int i : model_->near.points()) {
    const Point& point = model_->exchange.points[i];
    PointRecord& p = points_[i];
    const Increment increment = increment_at(point);
    const LawState end = end_of_point(point, p, increment);
    gap_difference_ = std::max(gap_difference_, dygita::gap_difference(point, p));
    if (state)
      book_work(point, p, end, increment, work_on_pieces(point), *state,
                (*energy)[model_->exchange.ports[point.first_port].piece]);
    p.law = end;
    if (state && point.law) show_point(point, p, *state);
  }
  for (const int at : model_->near.points()) {
    const Point& point = model_->exchange.points[at];
    const double g = increment_at(point).g;
    for (int i = point.first_port; i < point.end_port; ++i)
      ports_[i].u += increment_.dt * (g * ports_[i].w_old + (1 - g) * ports_[i].w);
  }
  if (!state) return;
  std::vector<Vec3> port_force;
  for (const int i : model_->near.points()) {
    const Point& point = model_->exchange.points[i];
    port_force.clear();
    for (int p = point.first_port; p < point.end_port; ++p) port_force.push_back(ports_[p].f);
    show_ties(*model_, point, points_[i], port_force, *state);
    show_residuals(point, *state);
  }
}

// What loads make of surfaces is known on all ranks, wherever their points are.
void LocalStage::follow_loads(State& state) const {
  for (const auto& [surface, interface] : interfaces_) {
    state.shortening[surface] = model_->loads->shortening(interface, state.shortening[surface], i_increment_);
    if (model_->loads->is_released(interface, i_increment_)) state.released[surface] = 1;
  }
}

// The constitutive-relation error as a field: |F - F_hat| of the worse side of every surface point.
void LocalStage::show_residuals(const Point& point, State& state) const {
  double worst = 0.0;
  for (int p = point.first_port; p < point.end_port; ++p) worst = std::max(worst, ports_[p].residual.norm());
  for (const Member& member : point.members)
    state.surfaces[member.surface].residual[member.point] = member.share * worst;
  for (int t = point.first_tie; t < point.end_tie; ++t) {
    const Tie& tie = model_->exchange.ties[t];
    state.surfaces[tie.surface].residual[tie.surface_point] =
        std::max(ports_[tie.port_1].residual.norm(), ports_[tie.port_2].residual.norm());
  }
}

bool LocalStage::is_massless(const Point& point) const {
  const Port& port = model_->exchange.ports[point.first_port];
  return model_->pieces[port.piece]->is_massless(port.piece_node);
}

double LocalStage::work_on_pieces(const Point& point) const {
  double work = 0.0;
  const double g = increment_at(point).g;
  const bool has_force_of_end = increment_.is_static || is_massless(point);
  for (int i = point.first_port; i < point.end_port; ++i) {
    const Vec3 motion = increment_.dt * (g * ports_[i].w_old + (1 - g) * ports_[i].w);
    work += (has_force_of_end ? Vec3(0.5 * (ports_[i].f_old + ports_[i].f)) : ports_[i].f).dot(motion);
  }
  return work;
}

Points LocalStage::held_force(int piece) const {
  Points force = Points::Zero(3, model_->cut->piece(piece).body->mesh->n_nodes());
  for (const int i : model_->near.points()) {
    const Point& point = model_->exchange.points[i];
    for (int p = point.first_port; p < point.end_port; ++p) {
      const Port& port = model_->exchange.ports[p];
      if (port.piece != piece) continue;
      if (port.trace) spread(*model_->cut, port, point.frame * ports_[p].f, force);
      for (int d = 0; d < 3 && !port.trace; ++d)
        if (port.is_held[d]) force.col(port.piece_node) += ports_[p].f[d] * point.frame.col(d);
    }
  }
  return force;
}

}  // namespace dygita
