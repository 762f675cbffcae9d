#include "solution/step_model.hpp"

#include <spdlog/fmt/fmt.h>

#include <map>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "mesh/facing.hpp"
#include "solution/rigid_motions.hpp"

namespace dygita {

State initial_state(const Problem& problem, const std::vector<Surface>& surfaces) {
  State state;
  for (const SubstructurePtr& part : problem.substructures) {
    const Points zero = Points::Zero(3, part->mesh->n_nodes());
    state.displacement.push_back(zero);
    state.velocity.push_back(zero);
    state.force.push_back(zero);
    state.anchor.push_back(zero);
  }
  for (const Surface& surface : surfaces) {
    state.surfaces.push_back({std::vector<LawState>(surface.n_points(), surface.declared_law().initial()),
                              std::vector<double>(surface.n_points(), 0.0)});
    state.shortening.push_back(0.0);
    state.released.push_back(0);
  }
  return state;
}

std::vector<double> StepModel::motion_velocities(int increment) const {
  std::vector<double> velocities;
  for (const Motion& motion : conditions.motions) velocities.push_back(motion.velocity(increment));
  return velocities;
}

double StepModel::held_velocity(const Port& port, const Vec3& direction, const std::vector<double>& motions) const {
  double velocity = 0.0;
  if (const Held* held = conditions.at(port.part, port.node))
    for (int j = 0; j < held->n; ++j)
      for (const auto& [motion, factor] : held->motion[j])
        velocity += held->directions.col(j).dot(direction) * factor * motions[motion];
  return velocity;
}

Points StepModel::external_force(int part, const State& state) const {
  Points force = scheme.is_static ? Points(Points::Zero(3, state.anchor[part].cols())) : state.anchor[part];
  loads->add_forces(part, force);
  return force;
}

Points StepModel::piece_force(int piece, const State& state) const {
  const int part = cut->piece(piece).part;
  if (!cut->is_cut(part)) return external_force(part, state);
  Points force = scheme.is_static ? Points(Points::Zero(3, cut->piece(piece).body->mesh->n_nodes()))
                                  : cut->on_owners(piece, state.anchor[part]);
  for (const PieceLoad& load : piece_loads[piece])
    if (const double value = loads->values()[load.pattern]; value != 0.0)
      for (const auto& [node, unit] : load.nodes) force.col(node) += value * unit;
  return force;
}

Points interface_force(const std::vector<Surface>& surfaces, const State& state, int part) {
  Points force = Points::Zero(3, state.displacement[part].cols());
  for (size_t s = 0; s < surfaces.size(); ++s) {
    const Surface& surface = surfaces[s];
    for (int i = 0; i < surface.n_points(); ++i) {
      const Vec3& f = state.surfaces[s].points[i].force;
      if (surface.part_1 == part) force.col(surface.facing.nodes_1[i]) += f;
      if (surface.part_2 == part) force.col(surface.facing.nodes_2[i]) -= f;
    }
  }
  return force;
}

Points StepModel::reactions(int part, const State& state) const {
  const Points interfaces = interface_force(*surfaces, state, part);
  return cut->summed(part, [&](int piece) { return pieces[piece]->reactions(cut->on_owners(piece, interfaces)); });
}

namespace {

// Impedance of absorbing supports at each node (manual, absorbing support).
std::unordered_map<int, Mat3> absorbing_impedance(const Problem& problem, const Step& step, int part) {
  std::unordered_map<int, Mat3> impedance;
  if (step.is_static) return impedance;
  const Substructure& body = *problem.substructures[part];
  const double z_n = body.material.density * body.material.p_wave_speed();
  const double z_t = body.material.density * body.material.s_wave_speed();
  for (const SupportPtr& support : supports_of(problem, step)) {
    if (support->kind != SupportKind::absorbing) continue;
    for (const FaceOrRegion& on : support->on) {
      const Face& face = std::get<Face>(on);
      if (face.part.get() != &body) continue;
      const FaceNodes nodes = face_nodes(*body.mesh, face.facets());
      for (size_t i = 0; i < nodes.nodes.size(); ++i) {
        const Mat3 along = nodes.normals.col(i) * nodes.normals.col(i).transpose();
        auto [it, is_new] = impedance.emplace(nodes.nodes[i], Mat3::Zero());
        it->second += nodes.areas[i] * (z_n * along + z_t * (Mat3::Identity() - along));
      }
    }
  }
  return impedance;
}

// Held directions of a piece's nodes: every copy of a node is held as the node is.
std::unordered_map<int, Held> held_of_piece(const StepModel& model, int piece) {
  const CutPiece& own = model.cut->piece(piece);
  const std::unordered_map<int, Held>& of_part = model.conditions.held[own.part];
  if (own.is_whole()) return of_part;
  std::unordered_map<int, Held> held;
  for (size_t i = 0; i < own.nodes.size(); ++i)
    if (const auto it = of_part.find(own.nodes[i]); it != of_part.end()) held.emplace(static_cast<int>(i), it->second);
  return held;
}

std::unordered_map<int, Mat3> absorbing_of_piece(const Cut& cut, int piece,
                                                 const std::unordered_map<int, Mat3>& of_part) {
  std::unordered_map<int, Mat3> own;
  for (const auto& [node, impedance] : of_part)
    if (const Copy owner = cut.owner(cut.piece(piece).part, node); owner.piece == piece)
      own.emplace(owner.node, impedance);
  return own;
}

std::vector<Piece::Row> rows_of(const StepModel& model, int piece, const std::unordered_map<int, Held>& held) {
  std::vector<Piece::Row> rows(model.exchange.n_unknowns[piece]);
  const Substructure& body = *model.cut->piece(piece).body;
  double total_area = 0.0;
  for (const Port& port : model.exchange.ports)
    if (port.piece == piece) total_area += port.area;
  const bool needs_reference = model.scheme.is_static && is_floating(body, held);
  const double length = total_area > 0.0 ? volume(*body.mesh) / total_area : 1.0;
  for (const Point& point : model.exchange.points)
    for (int p = point.first_port; p < point.end_port; ++p) {
      const Port& port = model.exchange.ports[p];
      if (port.piece != piece) continue;
      for (int d = 0; d < 3; ++d) {
        if (port.unknown[d] < 0) continue;
        const double modulus = d == 0 ? body.material.young : body.material.shear_modulus();
        rows[port.unknown[d]] = {port.piece_node, point.frame.col(d),
                                 needs_reference ? modulus * port.area / length : 0.0, modulus * port.area / length,
                                 1.0};
      }
    }
  std::unordered_map<int, std::vector<int>> at_node;
  for (size_t i = 0; i < rows.size(); ++i) at_node[rows[i].node].push_back(static_cast<int>(i));
  for (auto& [node, members] : at_node)
    for (const int i : members) {
      rows[i].n_sharing = 0.0;
      for (const int j : members) rows[i].n_sharing += std::pow(rows[i].direction.dot(rows[j].direction), 2);
    }
  return rows;
}

// What the pieces are for: to be solved one by one, together by someone else, or only to know their size.
enum class Purpose { alone, assembled, prediction };

// Single precision takes a third of what a solve reads from memory, and less of what an interface product reads. A
// static step has no mass that would bound what rounding does to soft motions, and nodes without mass have a recurrence
// of their own.
Precision precision_of(const StepModel& model, int part, const Body& body) {
  constexpr int large = 4000;  // unknowns
  if (model.scheme.is_static || !body.mass->is_massless.empty()) return Precision::double_precision;
  if (const auto& asked = model.problem->solver.precision) return *asked;
  if (model.problem->solver.tolerance < 1e-7) return Precision::double_precision;
  return 3 * model.problem->substructures[part]->mesh->n_nodes() > large ? Precision::single_precision
                                                                         : Precision::double_precision;
}

// Sixteen right-hand sides are as many as one pass over a factor takes.
void group_equal(StepModel& model) {
  std::map<const Factor*, size_t> open;
  for (size_t i = 0; i < model.pieces.size(); ++i) {
    const Factor* factor = model.pieces[i]->factor();
    const auto it = factor ? open.find(factor) : open.end();
    if (it != open.end() && model.equal[it->second].size() < 16) {
      model.equal[it->second].push_back(static_cast<int>(i));
      continue;
    }
    if (factor) open[factor] = model.equal.size();
    model.equal.push_back({static_cast<int>(i)});
  }
}

void make_pieces(StepModel& model, const std::vector<Body>& bodies, Purpose purpose) {
  const int n = model.cut->n_pieces();
  CHECK(static_cast<int>(bodies.size()) == n, "one body a piece");
  model.pieces.resize(n);
  model.offset.assign(1, 0);
  for (int i = 0; i < n; ++i) model.offset.push_back(model.offset.back() + model.exchange.n_unknowns[i]);
  std::vector<std::unordered_map<int, Mat3>> absorbing;
  for (size_t part = 0; part < model.problem->substructures.size(); ++part)
    absorbing.push_back(absorbing_impedance(*model.problem, *model.step, static_cast<int>(part)));
  // Far below what the tolerance leaves of a step; what is stored of an entry follows.
  const double storage_error = std::clamp(model.problem->solver.tolerance / 64.0, 0x1p-27, 0x1p-21);
  std::vector<Piece::Setup> setups;
  std::vector<std::unordered_map<int, Held>> held(n);
  std::vector<std::unordered_map<int, Mat3>> own_absorbing(n);
  for (int i = 0; i < n; ++i) {
    const int part = model.cut->piece(i).part, n_cut = model.cut->n_pieces(part);
    const std::string what =
        (n_cut > 1 ? fmt::format("piece {} of {} of ", i - model.cut->first(part) + 1, n_cut) : "") + "substructure '" +
        bodies[i].part->name + "' in step '" + model.step->name + "'";
    held[i] = held_of_piece(model, i);
    own_absorbing[i] = absorbing_of_piece(*model.cut, i, absorbing[part]);
    setups.push_back({&bodies[i], model.scheme, &held[i], &own_absorbing[i], rows_of(model, i, held[i]),
                      static_cast<int>(model.conditions.motions.size()), what, purpose == Purpose::assembled,
                      precision_of(model, part, bodies[i]), storage_error, nullptr, purpose == Purpose::prediction});
  }
  // The first of each kind, then those equal to it.
  std::map<const BodyMatrices*, std::vector<int>> same_body;
  for (int i = 0; i < n; ++i) same_body[bodies[i].matrices.get()].push_back(i);
  std::vector<char> waits(n, 0);
  for (const auto& [matrices, members] : same_body)
    for (size_t m = 1; m < members.size(); ++m) waits[members[m]] = 1;
  prepare_thread();
  const auto build = [&](char waiting) {
    parallel_for(n, [&](int i) {
      if (waits[i] == waiting) model.pieces[i] = std::make_unique<Piece>(std::move(setups[i]));
    });
  };
  build(0);
  for (const auto& [matrices, members] : same_body) {
    std::vector<int> known{members.front()};
    for (size_t m = 1; m < members.size(); ++m) {
      Piece::Setup& setup = setups[members[m]];
      const auto twin = std::find_if(known.begin(), known.end(),
                                     [&](int i) { return model.pieces[i] && model.pieces[i]->equals(setup); });
      if (twin != known.end()) setup.twin = model.pieces[*twin].get();
      if (setup.twin) continue;
      // Unlike all before: built here, so that what comes after may be equal to it.
      model.pieces[members[m]] = std::make_unique<Piece>(std::move(setup));
      waits[members[m]] = 2;
      known.push_back(members[m]);
    }
  }
  build(1);
  group_equal(model);
}

// Nodal masses (kg) of each substructure.
std::vector<Vec> masses_of(const Problem& problem, const Cut& cut, const std::vector<Body>& bodies) {
  std::vector<Vec> masses;
  for (const SubstructurePtr& part : problem.substructures) masses.push_back(Vec::Zero(part->mesh->n_nodes()));
  for (int p = 0; p < cut.n_pieces(); ++p) {
    const Vec& own = bodies[p].mass->lumped;
    for (int i = 0; i < own.size(); ++i) masses[cut.piece(p).part][cut.piece(p).node(i)] += own[i];
  }
  return masses;
}

void split_loads(StepModel& model) {
  model.piece_loads.resize(model.cut->n_pieces());
  for (size_t i = 0; i < model.loads->patterns().size(); ++i) {
    const LoadPattern& pattern = model.loads->patterns()[i];
    if (!model.cut->is_cut(pattern.part)) continue;
    for (const auto& [node, unit] : pattern.nodes) {
      const Copy owner = model.cut->owner(pattern.part, node);
      auto& of_piece = model.piece_loads[owner.piece];
      if (of_piece.empty() || of_piece.back().pattern != i) of_piece.push_back({i, {}});
      of_piece.back().nodes.emplace_back(owner.node, unit);
    }
  }
}

StepModel make_model(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces,
                     const std::vector<Body>& bodies, const State& start, const CutPtr& cut, Purpose purpose) {
  StepModel model;
  model.cut = cut;
  model.problem = &problem;
  model.step = &step;
  model.surfaces = &surfaces;
  if (!step.is_static) model.scheme = {false, step.dt, 0.5 * (1.0 - problem.numerical_damping())};
  // A wall that is not among this step's supports has let go, a damper carries nothing in a static step.
  std::vector<Surface> in_force = surfaces;
  for (Surface& surface : in_force)
    if (!takes_part(problem, step, surface)) surface.facing = {};
  model.conditions = make_conditions(problem, step, start);
  const std::vector<Vec> mass_values = masses_of(problem, *cut, bodies);
  std::vector<const Vec*> masses;
  for (const Vec& mass : mass_values) masses.push_back(&mass);
  model.loads = std::make_unique<Loads>(problem, step, start, masses);
  if (step.is_static) {
    std::vector<Points> force;
    model.loads->evaluate(step.increments - 1);
    for (size_t i = 0; i < masses.size(); ++i) force.push_back(model.external_force(static_cast<int>(i), start));
    // What is free to move, and where it is pinned, is a matter of the substructures.
    pin_free_motions(problem, step, make_exchange(problem, step, *no_cut(problem), in_force, model.conditions), force,
                     model.conditions);
  }
  model.exchange = make_exchange(problem, step, *cut, in_force, model.conditions);
  split_loads(model);
  make_pieces(model, bodies, purpose);
  return model;
}

}  // namespace

StepModel make_step_model(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces,
                          const std::vector<Body>& bodies, const State& start, const CutPtr& cut) {
  return make_model(problem, step, surfaces, bodies, start, cut, Purpose::alone);
}

StepModel make_assembled_model(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces,
                               const std::vector<Body>& bodies, const State& start) {
  return make_model(problem, step, surfaces, bodies, start, no_cut(problem), Purpose::assembled);
}

StepSize predict_step(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces,
                      const std::vector<Body>& bodies, const State& start, const CutPtr& cut) {
  const StepModel model = make_model(problem, step, surfaces, bodies, start, cut, Purpose::prediction);
  StepSize size;
  for (const auto& piece : model.pieces) size.bytes += piece->predicted_bytes();
  size.n_unknowns = model.n_q();
  return size;
}

}  // namespace dygita
