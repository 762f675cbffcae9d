#include "solution/step_ends.hpp"

#include "base/overloaded.hpp"
#include "law/law.hpp"
#include "solution/all_pieces.hpp"
#include "solution/explicit_piece.hpp"

namespace dygita {

namespace {

// A wall that is a support now and was none in the step before stands where it was declared: its gap is that of the
// displacements.
void place_returning_walls(const StepModel& model, State& state) {
  const int i_step = index_of(model.problem->steps, model.step);
  if (i_step <= 0) return;
  const auto& before = supports_of(*model.problem, *model.problem->steps[i_step - 1]);
  const auto& now = supports_of(*model.problem, *model.step);
  for (size_t s = 0; s < model.surfaces->size(); ++s) {
    const Surface& surface = (*model.surfaces)[s];
    if (!surface.wall || index_of(now, surface.wall) < 0 || index_of(before, surface.wall) >= 0) continue;
    for (int i = 0; i < surface.n_points(); ++i)
      state.surfaces[s].points[i].gap =
          surface.declared_law().initial().gap -
          surface.facing.normals.col(i).dot(surface.facing.side_1.at(i, state.displacement[surface.part_1]));
  }
}

// The pieces of a substructure start from its fields. Forces across a cut are not part of the state: each piece is in
// balance by itself, and what the substructure as a whole has too much at a node is its owner's.
// elastic: K u of all pieces of substructures that are cut.
void set_pieces(StepModel& model, int part, const State& state, const std::vector<Points>& elastic) {
  const Cut& cut = *model.cut;
  const Points interfaces = interface_force(*model.surfaces, state, part);
  if (!cut.is_cut(part)) {
    model.pieces[cut.first(part)]->set_state(state.displacement[part], state.velocity[part], state.force[part],
                                             interfaces);
    return;
  }
  const Points imbalance = cut.summed(part, [&](int piece) { return elastic[piece]; }) - state.force[part] - interfaces;
  for (int p = cut.first(part); p < cut.first(part) + cut.n_pieces(part); ++p) {
    if (!model.solves(p)) continue;
    const Points force = cut.on_owners(p, state.force[part]);
    model.pieces[p]->set_state(cut.on_piece(p, state.displacement[part]), cut.on_piece(p, state.velocity[part]), force,
                               elastic[p] - force - cut.on_owners(p, imbalance));
  }
}

std::vector<Points> elastic_forces(const StepModel& model, const State& state) {
  const Cut& cut = *model.cut;
  return fields_of_all_pieces(cut, [&](int piece) {
    const int part = cut.piece(piece).part;
    return cut.is_cut(part) ? model.pieces[piece]->elastic_force(cut.on_piece(piece, state.displacement[part]))
                            : Points(Points::Zero(3, cut.piece(piece).body->mesh->n_nodes()));
  });
}

// Explicit pieces keep the loads that are theirs: a field of forces in each increment would cost what a product does.
void give_loads(StepModel& model, const State& state) {
  for (int i = 0; i < static_cast<int>(model.pieces.size()); ++i) {
    auto* piece = dynamic_cast<ExplicitPiece*>(model.pieces[i].get());
    if (!piece) continue;
    const int part = model.cut->piece(i).part;
    std::vector<ExplicitPiece::PatternLoad> loads;
    if (model.cut->is_cut(part)) {
      for (const StepModel::PieceLoad& load : model.piece_loads[i]) loads.push_back({load.pattern, load.nodes});
    } else {
      for (size_t p = 0; p < model.loads->patterns().size(); ++p)
        if (const LoadPattern& pattern = model.loads->patterns()[p]; pattern.part == part)
          loads.push_back({p, pattern.nodes});
    }
    piece->set_loads(model.cut->on_owners(i, state.anchor[part]), loads);
  }
}

}  // namespace

void start_step(StepModel& model, State& state) {
  const bool is_static = model.scheme.is_static;
  const bool first_dynamic = !is_static && !state.has_moved;
  // A wall that is no longer a support has let go, and so does a law that has no part in such a step.
  for (size_t s = 0; s < model.surfaces->size(); ++s) {
    const Surface& surface = (*model.surfaces)[s];
    if (takes_part(*model.problem, *model.step, surface)) continue;
    for (LawState& point : state.surfaces[s].points) {
      point.force.setZero();
      point.status = surface.declared_law().initial().status;
    }
  }
  for (size_t i = 0; i < state.velocity.size(); ++i) {
    Points& velocity = state.velocity[i];
    if (is_static) velocity.setZero();
    if (first_dynamic) velocity.colwise() += model.problem->substructures[i]->velocity;
  }
  const std::vector<Points> elastic = elastic_forces(model, state);
  for (size_t i = 0; i < state.velocity.size(); ++i) set_pieces(model, static_cast<int>(i), state, elastic);
  const std::vector<Points> velocities =
      fields_of_all_pieces(*model.cut, [&](int piece) { return model.pieces[piece]->velocity(); });
  for (size_t i = 0; i < state.velocity.size(); ++i)
    state.velocity[i] = model.cut->from_owners(static_cast<int>(i), [&](int piece) { return velocities[piece]; });
  give_loads(model, state);
  place_returning_walls(model, state);
  Energies& energies = state.energies;
  const double before = energies.kinetic + energies.strain;
  energies.kinetic = energies.strain = 0.0;
  const std::vector<double> stored = of_all_pieces(*model.cut, 2, [&](int i, double* to) {
    const IncrementEnergy now = model.pieces[i]->stored_energy();
    to[0] = now.kinetic;
    to[1] = now.strain;
  });
  for (size_t i = 0; i < stored.size(); i += 2) {
    energies.kinetic += stored[i];
    energies.strain += stored[i + 1];
  }
  const double jump = energies.kinetic + energies.strain - before;
  (first_dynamic ? energies.start : energies.scheme) += first_dynamic ? jump : -jump;
  if (first_dynamic) state.has_moved = true;
}

void end_step(const StepModel& model, State& state) {
  const Cut& cut = *model.cut;
  const std::vector<Points> displacements =
      fields_of_all_pieces(cut, [&](int piece) { return model.pieces[piece]->displacement(); });
  const std::vector<Points> velocities =
      fields_of_all_pieces(cut, [&](int piece) { return model.pieces[piece]->velocity(); });
  const std::vector<Points> all_reactions =
      model.scheme.is_static ? fields_of_all_pieces(cut, [&](int piece) { return model.reactions_of(piece, state); })
                             : std::vector<Points>();
  for (size_t i = 0; i < state.displacement.size(); ++i) {
    const int part = static_cast<int>(i);
    state.displacement[i] = cut.from_owners(part, [&](int piece) { return displacements[piece]; });
    state.velocity[i] = cut.from_owners(part, [&](int piece) { return velocities[piece]; });
    if (model.scheme.is_static) state.velocity[i].setZero();
    state.force[i] = model.external_force(part, state);
    if (!model.scheme.is_static) continue;
    // What an absorbing support held in the static step it keeps holding while waves pass through it.
    state.anchor[i].setZero();
    const Points reactions = cut.summed(part, [&](int piece) { return all_reactions[piece]; });
    for (const auto& [node, held] : model.conditions.held[i])
      if (held.n > 0 && held.support[0] && held.support[0]->kind->absorbs())
        state.anchor[i].col(node) = reactions.col(node);
  }
  state.reached = model.loads->reached();
  if (model.scheme.is_static) {
    state.base_velocity.clear();  // at rest
    return;
  }
  for (const LoadPtr& load : model.step->loads)
    for (const Effect& effect : load->effects())
      std::visit(overloaded{[&](const BaseMotion& base) {
                              auto [it, is_new] = state.base_velocity.emplace(base.on.get(), Vec3::Zero());
                              it->second += base.direction * base.acceleration.integral(0.0, model.step->duration);
                            },
                            Ignored<NodalForces, BodyForce, PrescribedMotion, Shortening, PreloadForce, Release>()},
                 effect);
}

void book_increment(const std::vector<IncrementEnergy>& increment, Energies& energies) {
  energies.kinetic = energies.strain = 0.0;
  for (const IncrementEnergy& e : increment) {
    energies.kinetic += e.kinetic;
    energies.strain += e.strain;
    energies.loads += e.loads;
    energies.friction += e.friction;
    energies.plastic += e.plastic;
    energies.damping += e.damping;
    energies.scheme += e.scheme;
  }
}

}  // namespace dygita
