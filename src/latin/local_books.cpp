// What the local stage keeps and reports of an increment: the laws' memory, works, forces, gaps and residuals.
#include <algorithm>
#include <set>
#include <utility>

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
    const double left = increment_.is_static ? 0.0 : work_of_found(i);
    if (state) (*energy)[model_->exchange.ports[point.first_port].piece].loads += left;
    if (state && !increment_.is_static) book_work_left(point);
    p.law = end;
    if (state && point.law) show_point(point, p, *state);
  }
  for (const int at : model_->near.points()) {
    const Point& point = model_->exchange.points[at];
    const Increment increment = increment_at(point);
    for (int i = point.first_port; i < point.end_port; ++i)
      ports_[i].u += increment.motion(ports_[i].w_old, ports_[i].w);
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

// What a dynamic step finds on its unknowns: a motion is solved to the tolerance of what it adds to that, however much
// a preload has left there. Forces across a cut are no part of the state: they are what keeps the pieces in balance.
Vec LocalStage::found_forces(const State& start) const {
  Vec found = Vec::Zero(model_->near.n());
  if (model_->scheme.is_static) return found;
  std::vector<Points> across_cuts(model_->pieces.size());
  for (const int i : model_->here)
    if (model_->cut->is_cut(model_->cut->piece(i).part) && !start.displacement[i].isZero(0.0))
      across_cuts[i] = model_->pieces[i]->elastic_force(start.displacement[i]) - start.force[i];
  std::set<std::pair<int, int>> nodes;
  for (const int at : model_->near.points()) {
    const Point& point = model_->exchange.points[at];
    for (int p = point.first_port; p < point.end_port; ++p) {
      const Port& port = model_->exchange.ports[p];
      const Points& balance = across_cuts[port.piece];
      // All of it under the first law of a node.
      const bool is_balance = balance.cols() > 0 && !port.trace;
      const bool is_first = is_balance && nodes.emplace(port.piece, port.piece_node).second;
      for (int d = 0; d < 3; ++d)
        if (const int i = model_->unknown(port, d); i >= 0)
          found[i] = !is_balance ? ports_[p].f[d]
                     : is_first  ? point.frame.col(d).dot(balance.col(port.piece_node))
                                 : 0.0;
    }
  }
  model_->near.exchange({found.data()});
  return found;
}

// Work (J) of these forces on what the iteration leaves between V and W_hat in an increment. It stands for a shortening
// of as much, and without it the books of a small motion would miss it.
double LocalStage::work_of_found(int i_point) {
  const Point& point = model_->exchange.points[static_cast<size_t>(i_point)];
  double power = 0.0;
  for (int p = point.first_port; p < point.end_port; ++p)
    for (int d = 0; d < 3; ++d)
      if (const int i = model_->unknown(model_->exchange.ports[p], d); i >= 0)
        power += found_[i] * ports_[p].residual[d] / k_[i];
  return increment_at(point).motion(std::exchange(points_left_[static_cast<size_t>(i_point)], power), power);
}

// Once for each substructure that meets there.
void LocalStage::book_work_left(const Point& point) {
  double power = 0.0;
  for (int p = point.first_port; p < point.end_port; ++p)
    for (int d = 0; d < 3; ++d)
      if (const int i = model_->unknown(model_->exchange.ports[p], d); i >= 0)
        power += (ports_[p].f[d] - found_[i]) * ports_[p].residual[d] / k_[i];
  const auto part_at = [&](int p) { return model_->cut->piece(model_->exchange.ports[p].piece).part; };
  for (int p = point.first_port; p < point.end_port; ++p) {
    bool is_first = true;
    for (int before = point.first_port; before < p; ++before) is_first = is_first && part_at(before) != part_at(p);
    if (is_first) work_left_[static_cast<size_t>(model_->exchange.ports[p].piece)] += model_->scheme.dt * power;
  }
}

double LocalStage::work_on_pieces(const Point& point) const {
  double work = 0.0;
  const Increment increment = increment_at(point);
  const bool has_force_of_end = increment_.is_static || is_massless(point);
  for (int i = point.first_port; i < point.end_port; ++i) {
    const Vec3 motion = increment.motion(ports_[i].w_old, ports_[i].w);
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
