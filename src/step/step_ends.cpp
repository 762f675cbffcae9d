#include "step/step_ends.hpp"

#include <algorithm>
#include <map>

#include "base/log.hpp"
#include "base/overloaded.hpp"
#include "law/law.hpp"
#include "model/places.hpp"
#include "partition/all_pieces.hpp"
#include "partition/copies.hpp"
#include "pieces/explicit_piece.hpp"
#include "step/cut_momenta.hpp"
#include "step/joined_velocities.hpp"

namespace dygita {

namespace {

// Displacements (m) of the points of a wall, on all ranks.
Points displacements_of(const StepModel& model, const State& state, const Surface& wall) {
  const Cut& cut = *model.cut;
  const SideTrace& side = wall.facing.side_1;
  Points values = Points::Zero(3, wall.n_points());
  std::vector<int> owner, offset{0};
  for (int i = 0; i < wall.n_points(); ++i) {
    const int piece = cut.owner(wall.part_1, side.main_node(i)).piece;
    owner.push_back(cut.piece(piece).rank);
    offset.push_back(3 * (i + 1));
    if (model.solves(piece))
      values.col(i) =
          side.at_nodes(i, [&](int node) { return state.displacement[piece].col(cut.owner(wall.part_1, node).node); });
  }
  if (!model.is_assembled) ranks::Segments(owner, offset).complete(values.data());
  return values;
}

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
    const Points displacements = displacements_of(model, state, surface);
    for (int i = 0; i < surface.n_points(); ++i)
      state.surfaces[s].points[i].gap =
          surface.declared_law().initial().gap - surface.facing.normals.col(i).dot(displacements.col(i));
  }
}

// K u of the pieces that are solved here and belong to substructures that are cut.
std::vector<Points> elastic_forces(const StepModel& model, const State& state) {
  std::vector<Points> elastic(model.pieces.size());
  for (const int i : model.here)
    if (model.cut->is_cut(model.cut->piece(i).part)) elastic[i] = model.pieces[i]->elastic_force(state.displacement[i]);
  return elastic;
}

// The branches of material damping, in dynamic steps: in a static one they are relaxed.
void set_branches(StepModel& model, const State& state) {
  if (state.elongation.empty() || model.scheme.is_static) return;
  std::vector<Points> elongation(state.elongation.size());
  for (const int i : model.here) {
    for (size_t b = 0; b < elongation.size(); ++b) elongation[b] = state.elongation[b][i];
    model.pieces[i]->set_elongations(elongation);
  }
}

// The pieces of a substructure start from its fields. Forces across a cut are not part of the state: each piece is in
// balance by itself, and what the substructure as a whole has too much at a node is its owner's.
void set_pieces(StepModel& model, const State& state) {
  const Cut& cut = *model.cut;
  const std::vector<Points> elastic = elastic_forces(model, state);
  std::vector<Points> whole = elastic;  // that of the substructure, on the copies that own a node
  sum_on_owners(cut, model.is_assembled, whole);
  int last_part = -1;
  Points interfaces;
  for (const int i : model.here) {
    const int part = cut.piece(i).part;
    if (part != last_part) interfaces = interface_force(*model.problem, *model.surfaces, state, part);
    last_part = part;
    const Points &u = state.displacement[i], &v = state.velocity[i], &force = state.force[i];
    if (!cut.is_cut(part)) {
      model.pieces[i]->set_state(u, v, force, interfaces);
      continue;
    }
    Points imbalance = whole[i] - force - cut.on_owners(i, interfaces);
    cut.keep_owned(i, imbalance);
    model.pieces[i]->set_state(u, v, force, elastic[i] - force - imbalance);
  }
  set_branches(model, state);
  start_cut_momenta(model);
}

// A system of all pieces starts from the fields of all.
void complete(const Cut& cut, State& state) {
  for (std::vector<Points>* field : state.fields())
    *field = fields_of_all_pieces(cut, [&](int piece) { return (*field)[piece]; });
}

void leave_to_others(const Cut& cut, State& state) {
  for (int i = 0; i < cut.n_pieces(); ++i)
    if (!cut.is_here(i))
      for (std::vector<Points>* field : state.fields()) (*field)[i].resize(3, 0);
}

// Explicit pieces keep the loads that are theirs: a field of forces in each increment would cost what a product does.
void give_loads(StepModel& model, const State& state) {
  for (int i = 0; i < static_cast<int>(model.pieces.size()); ++i) {
    auto* piece = model.pieces[i]->as_explicit();
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
    piece->set_loads(model.piece_anchor(i, state), loads);
  }
}

// What absorbing supports have held in static steps acts on as long as they are supports of the step.
void let_go_of_absorbed(const StepModel& model, State& state) {
  if (model.scheme.is_static) return;
  const Problem& problem = *model.problem;
  std::vector<std::vector<int>> kept(problem.substructures.size());
  for (const SupportPtr& support : supports_of(problem, *model.step)) {
    if (!support->kind->absorbs()) continue;
    for (const FaceOrRegion& on : support->on) {
      const std::vector<int> nodes = nodes_at(on);
      std::vector<int>& of_part = kept[static_cast<size_t>(index_of(problem.substructures, &part_of(on)))];
      of_part.insert(of_part.end(), nodes.begin(), nodes.end());
    }
  }
  for (size_t part = 0; part < kept.size(); ++part) {
    std::sort(kept[part].begin(), kept[part].end());
    std::erase_if(state.anchor[part], [&](const auto& held) {
      return !std::binary_search(kept[part].begin(), kept[part].end(), held.first);
    });
  }
}

// J, of the pieces as they are.
double kinetic_energy(const StepModel& model) {
  double energy = 0.0;
  for (const double own :
       of_all_pieces(*model.cut, 1, [&](int i, double*to) { *to = model.pieces[i]->stored_energy().kinetic; }))
    energy += own;
  return energy;
}

// Nodes that a load moves have its velocity from the start on: increments add changes of velocity, and would never make
// up for the first one (manual, eq. S5a). Collective. False: nothing changes.
bool take_up_motions(const StepModel& model, State& state) {
  const Cut& cut = *model.cut;
  bool has_changed = false;
  for (int part = 0; part < cut.n_parts() && !model.scheme.is_static; ++part)
    for (const auto& [node, held] : model.conditions.held[part])
      for (int j = 0; j < held.n; ++j) {
        double velocity = 0.0;
        bool is_taken_up = !held.motion[j].empty();
        for (const auto& [index, factor] : held.motion[j]) {
          const Motion& motion = model.conditions.motions[static_cast<size_t>(index)];
          is_taken_up &= motion.is_taken_up;
          if (is_taken_up) velocity += factor * motion.at_start(model.scheme.dt);
        }
        if (!is_taken_up) continue;
        const Vec3 direction = held.directions.col(j);
        for (const Copy& copy : cut.copies(part, node)) {
          if (!model.solves(copy.piece)) continue;
          Points& of_piece = state.velocity[copy.piece];
          const double change = velocity - direction.dot(of_piece.col(copy.node));
          of_piece.col(copy.node) += change * direction;
          has_changed |= change != 0.0;
        }
      }
  return ranks::any(has_changed);
}

// Of the problem, not of the bodies, which members of an ensemble share.
Points start_velocity(const StepModel& model, int piece) {
  const CutPiece& own = model.cut->piece(piece);
  const Vec3& velocity = model.problem->substructures[static_cast<size_t>(own.part)]->velocity;
  return own.body->mesh->inside->rigid_motion(own.body->mesh->nodes, velocity, Vec3::Zero());
}

bool are_thrown_apart(const Problem& problem) {
  const auto& parts = problem.substructures;
  return std::any_of(parts.begin(), parts.end(),
                     [&](const SubstructurePtr& part) { return part->velocity != parts.front()->velocity; });
}

// energy: J, kinetic, before it.
void tell_impact(const Step& step, const std::string& where, double lost, double energy) {
  constexpr double least = 1e-6;
  if (lost <= least * energy) return;
  warn(
      fmt::format("step '{}': joined parts start with different velocities ('{}'): they impact, which dissipates "
                  "{:.3g} % of the kinetic energy ({:.4g} J, part of 'scheme') before the first row\n    likely cause: "
                  "a part without the 'velocity' of the others; a finer mesh dissipates less",
                  step.name, where, 100.0 * lost / energy, lost));
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
  let_go_of_absorbed(model, state);
  if (model.is_assembled && !ranks::is_alone()) complete(*model.cut, state);
  for (const int i : model.here) {
    Points& velocity = state.velocity[i];
    if (is_static) velocity.setZero();
    if (first_dynamic) velocity += start_velocity(model, i);
  }
  std::vector<Points> had = is_static ? std::vector<Points>() : state.velocity;
  double fastest = 0.0, stopped = 0.0;  // m/s, of what supports take
  const auto give_to_pieces = [&] {
    set_pieces(model, state);
    for (const int i : model.here) {
      const Points moves = model.pieces[i]->velocity();
      if (moves.size() > 0) {
        fastest = std::max(fastest, state.velocity[i].cwiseAbs().maxCoeff());
        stopped = std::max(stopped, (moves - state.velocity[i]).cwiseAbs().maxCoeff());
      }
      state.velocity[i] = moves;
    }
  };
  const auto jump_to_held = [&] {
    if (is_static) return;
    bool has_jumped = false;
    for (const int i : model.here) {
      const Points after = model.pieces[i]->after_jump(had[i], state.velocity[i]);
      has_jumped |= after != state.velocity[i];
      state.velocity[i] = after;
    }
    if (ranks::any(has_jumped)) give_to_pieces();
    had = state.velocity;
  };
  const auto join = [&] {
    std::string where = join_velocities(model, state);
    if (!where.empty()) give_to_pieces();
    if (!is_static) had = state.velocity;
    return where;
  };
  give_to_pieces();
  jump_to_held();
  const bool is_apart = first_dynamic && are_thrown_apart(*model.problem);
  double lost = 0.0, given = 0.0;  // J, in impacts of what is joined; by the loads at once
  if (!is_static && ranks::any(is_apart || stopped > 1e-9 * fastest)) {
    const double before = kinetic_energy(model);
    if (const std::string where = join(); is_apart && !where.empty()) {
      lost = before - kinetic_energy(model);
      tell_impact(*model.step, where, lost, before);
    }
  }
  if (take_up_motions(model, state)) {
    given = -kinetic_energy(model);
    give_to_pieces();
    jump_to_held();
    join();
    given += kinetic_energy(model);
  }
  give_to_copies(*model.cut, model.is_assembled, state.velocity);
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
  energies.loads += given;
  const double jump = energies.kinetic + energies.strain - before - given;
  (first_dynamic ? energies.start : energies.scheme) += first_dynamic ? jump + lost : -jump;
  energies.scheme += lost;
  if (first_dynamic) state.has_moved = true;
}

namespace {

// What an absorbing support held in the static step it keeps holding while waves pass through it.
void keep_reactions(const StepModel& model, State& state) {
  const Cut& cut = *model.cut;
  std::vector<std::pair<int, int>> held_nodes;  // substructure and node
  for (int part = 0; part < cut.n_parts(); ++part)
    for (const auto& [node, held] : model.conditions.held[part])
      if (held.is_absorbed) held_nodes.emplace_back(part, node);
  std::sort(held_nodes.begin(), held_nodes.end());
  std::map<int, Points> reactions;  // of the pieces here that have such nodes
  std::vector<double> values;
  std::vector<int> owner, offset{0};
  for (const auto& [part, node] : held_nodes)
    for (const Copy& copy : cut.copies(part, node)) {
      values.resize(values.size() + 3, 0.0);
      owner.push_back(cut.piece(copy.piece).rank);
      offset.push_back(static_cast<int>(values.size()));
      if (!model.solves(copy.piece)) continue;
      auto [it, is_new] = reactions.try_emplace(copy.piece);
      if (is_new) it->second = model.reactions_of(copy.piece, state);
      Eigen::Map<Vec3>(values.data() + values.size() - 3) = it->second.col(copy.node);
    }
  if (!model.is_assembled) ranks::Segments(owner, offset).complete(values.data());
  for (auto& of_part : state.anchor) of_part.clear();
  const double* next = values.data();
  for (const auto& [part, node] : held_nodes) {
    Vec3& force = state.anchor[part].emplace(node, Vec3::Zero()).first->second;
    for (size_t i = 0; i < cut.copies(part, node).size(); ++i, next += 3) force += Eigen::Map<const Vec3>(next);
  }
}

}  // namespace

void end_step(const StepModel& model, State& state) {
  const Cut& cut = *model.cut;
  for (const int i : model.here) {
    state.displacement[i] = model.pieces[i]->displacement();
    state.velocity[i] = model.pieces[i]->velocity();
    if (model.scheme.is_static) state.velocity[i].setZero();
    state.force[i] = model.piece_force(i, state);
    const std::vector<Points> elongation = model.pieces[i]->elongations();
    for (size_t b = 0; b < state.elongation.size(); ++b)
      if (b < elongation.size())
        state.elongation[b][i] = elongation[b];
      else
        state.elongation[b][i].setZero();
  }
  for (std::vector<Points>& branch : state.elongation) give_to_copies(cut, model.is_assembled, branch);
  give_to_copies(cut, model.is_assembled, state.displacement);
  give_to_copies(cut, model.is_assembled, state.velocity);
  if (model.scheme.is_static) keep_reactions(model, state);
  if (model.is_assembled) leave_to_others(cut, state);
  state.reached = model.loads->reached();
  // What was to let go after the middle of the last increment has not acted yet.
  for (size_t s = 0; s < model.surfaces->size(); ++s)
    if (const Interface* interface = (*model.surfaces)[s].interface;
        interface && model.loads->is_released_in_step(interface))
      state.released[s] = 1;
  if (model.scheme.is_static) {
    state.base_velocity.clear();  // at rest
    return;
  }
  for (const LoadPtr& load : model.step->loads)
    for (const Effect& effect : load->effects())
      std::visit(overloaded{[&](const BaseMotion& base) {
                              auto [it, is_new] = state.base_velocity.emplace(base.on.get(), Vec3::Zero());
                              it->second += base.direction *
                                            RunningIntegral(base.acceleration)
                                                .over(model.step->n_increments() * model.n_substeps(), model.scheme.dt);
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
    energies.stored += e.stored;
  }
}

}  // namespace dygita
