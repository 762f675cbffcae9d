#include "step/step_model.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "base/log.hpp"
#include "base/memory.hpp"
#include "base/union_find.hpp"
#include "exchange/torn_ties.hpp"
#include "law/law.hpp"
#include "partition/all_pieces.hpp"
#include "step/assembled_system.hpp"
#include "step/expected_iterations.hpp"
#include "step/shared_operators.hpp"
#include "step/step_needs.hpp"

namespace dygita {

State initial_state(const Problem& problem, const std::vector<Surface>& surfaces) {
  return initial_state(problem, surfaces, *no_cut(problem));
}

State initial_state(const Problem& problem, const std::vector<Surface>& surfaces, const Cut& cut) {
  State state;
  for (const SubstructurePtr& part : problem.substructures)
    state.elongation.resize(std::max(state.elongation.size(), part->material.damping.branches.size()));
  for (int i = 0; i < cut.n_pieces(); ++i)
    for (std::vector<Points>* field : state.fields())
      field->emplace_back(Points::Zero(3, cut.is_here(i) ? cut.piece(i).body->mesh->n_nodes() : 0));
  state.anchor.resize(problem.substructures.size());
  for (const Surface& surface : surfaces) {
    state.surfaces.push_back({std::vector<LawState>(surface.n_points(), surface.declared_law().initial()),
                              std::vector<double>(surface.n_points(), 0.0), std::vector<Work>(surface.n_points())});
    if (surface.interface && surface.interface->has_gap_of_geometry)
      for (int i = 0; i < surface.n_points(); ++i) state.surfaces.back().points[i].gap = surface.facing.gaps[i];
    state.shortening.push_back(0.0);
    state.released.push_back(0);
  }
  return state;
}

FreeStep StepModel::what_is_free() const {
  return {mean.is_whole_free(), relief ? std::optional(relief->acceleration(*loads)) : std::nullopt};
}

std::vector<double> StepModel::motion_velocities(int increment) const {
  std::vector<double> velocities;
  for (const Motion& motion : conditions.motions) velocities.push_back(motion.velocity(increment, scheme.dt));
  return velocities;
}

double StepModel::phase_factor() const { return 1.0 / std::pow(n_substeps(), 2); }

bool StepModel::has_inner_iterations() const {
  return !scheme.is_static && problem->solver.anderson != 0 && problem->solver.window == 1;
}

bool StepModel::is_tuned() const { return !has_explicit() && problem->mass().is_tuned; }

double StepModel::held_velocity(const Port& port, const Vec3& direction, const std::vector<double>& motions) const {
  double velocity = 0.0;
  port.for_each_node([&](int node, const Mat3& block) {
    const Held* held = conditions.at(port.part, node);
    for (int j = 0; held && j < held->n; ++j)
      for (const auto& [motion, factor] : held->motion[j])
        velocity += (block * held->directions.col(j)).dot(direction) * factor * motions[motion];
  });
  return velocity;
}

Points StepModel::external_force(int part, const State& state) const {
  Points force = Points::Zero(3, problem->substructures[part]->mesh->n_nodes());
  if (!scheme.is_static)
    for (const auto& [node, held] : state.anchor[part]) force.col(node) = held;
  loads->add_forces(part, force);
  return force;
}

Points StepModel::piece_anchor(int piece, const State& state) const {
  const CutPiece& own = cut->piece(piece);
  Points force = Points::Zero(3, own.body->mesh->n_nodes());
  for (const auto& [node, held] : state.anchor[own.part])
    if (const Copy owner = cut->owner(own.part, node); owner.piece == piece) force.col(owner.node) = held;
  return force;
}

Points StepModel::piece_force(int piece, const State& state) const {
  const int part = cut->piece(piece).part;
  if (!cut->is_cut(part)) return external_force(part, state);
  Points force =
      scheme.is_static ? Points(Points::Zero(3, cut->piece(piece).body->mesh->n_nodes())) : piece_anchor(piece, state);
  for (const PieceLoad& load : piece_loads[piece])
    if (const double value = loads->values()[load.pattern]; value != 0.0)
      for (const auto& [node, unit] : load.nodes) force.col(node) += value * unit;
  return force;
}

Points interface_force(const Problem& problem, const std::vector<Surface>& surfaces, const State& state, int part) {
  Points force = Points::Zero(3, problem.substructures[part]->mesh->n_nodes());
  for (size_t s = 0; s < surfaces.size(); ++s) {
    const Surface& surface = surfaces[s];
    for (int i = 0; i < surface.n_points(); ++i) {
      const Vec3& f = state.surfaces[s].points[i].force;
      if (surface.part_1 == part) surface.facing.side_1.spread(i, f, force);
      if (surface.part_2 == part) surface.facing.side_2.spread(i, -f, force);
    }
  }
  return force;
}

Points StepModel::reactions_of(int piece, const State& state) const {
  const Points interfaces = interface_force(*problem, *surfaces, state, cut->piece(piece).part);
  return pieces[piece]->reactions(cut->on_owners(piece, interfaces));
}

Points StepModel::reactions(int part, const State& state) const {
  const Points interfaces = interface_force(*problem, *surfaces, state, part);
  return cut->summed(part, [&](int piece) { return pieces[piece]->reactions(cut->on_owners(piece, interfaces)); });
}

namespace {

// Mass times an acceleration of the nodes (3 x n) of a substructure.
InertiaForce inertia_of(const Cut& cut, const std::vector<Body>& bodies, std::vector<char> is_explicit) {
  return [&, is_explicit = std::move(is_explicit)](int part, const Points& acceleration) {
    Points force = Points::Zero(3, acceleration.cols());
    for (int p = cut.first(part); p < cut.first(part) + cut.n_pieces(part); ++p) {
      const Points own = bodies[p].mass->times(cut.on_piece(p, acceleration), !is_explicit.empty() && is_explicit[p]);
      for (Eigen::Index i = 0; i < own.cols(); ++i) force.col(cut.piece(p).node(static_cast<int>(i))) += own.col(i);
    }
    return force;
  };
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

// All ranks look for the shortening of a bolt, which its points share.
std::vector<char> solved_everywhere(const StepModel& model) {
  std::vector<char> everywhere;
  for (const Surface& surface : *model.surfaces)
    everywhere.push_back(model.scheme.is_static && surface.law && surface.interface &&
                         model.loads->preload(surface.interface));
  return everywhere;
}

// Collective. Where the nodes are whose displacement a step prescribes.
NodeMotions moved_nodes(const Problem& problem, const Step& step, const State& start, const Cut& cut) {
  const std::vector<std::vector<int>> nodes = prescribed_nodes(problem, step);
  std::vector<double> values;
  std::vector<int> owner, offset{0};
  for (size_t part = 0; part < nodes.size(); ++part)
    for (const int node : nodes[part]) {
      const Copy copy = cut.owner(static_cast<int>(part), node);
      const Points& u = start.displacement[static_cast<size_t>(copy.piece)];
      values.resize(values.size() + 3, 0.0);
      if (u.cols() > 0) Eigen::Map<Vec3>(values.data() + values.size() - 3) = u.col(copy.node);
      owner.push_back(cut.piece(copy.piece).rank);
      offset.push_back(static_cast<int>(values.size()));
    }
  if (!ranks::is_alone()) ranks::Segments(owner, offset).complete(values.data());
  NodeMotions moved(nodes.size());
  const double* next = values.data();
  for (size_t part = 0; part < nodes.size(); ++part)
    for (const int node : nodes[part]) {
      moved[part].emplace(node, Eigen::Map<const Vec3>(next));
      next += 3;
    }
  return moved;
}

// Free motions, and where they are pinned, depend on the substructures.
void free_motions_of(StepModel& model, const std::vector<Surface>& surfaces, const std::vector<Body>& bodies) {
  const Problem& problem = *model.problem;
  const Step& step = *model.step;
  const Exchange exchange = make_exchange(problem, step, *no_cut(problem), surfaces, model.conditions);
  FreeMotions free = find_free_motions(problem, exchange, model.conditions);
  if (step.inertia_relief && free.columns.cols() > 0)
    model.relief.emplace(problem, free, inertia_of(*model.cut, bodies, {}), *model.loads);
  else if (step.inertia_relief)
    warn(fmt::format("{}static step '{}': 'inertia_relief' has nothing to do: supports and interfaces hold all parts",
                     step.origin.prefix(), step.name));
  check_loads(problem, step, free, *model.loads);
  pin_free_motions(problem, step, exchange, free, model.conditions);
  model.mean = MeanMotion(std::move(free), model.cut, bodies);
}

StepModel make_model(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces,
                     const std::vector<Body>& bodies, const State& start, const CutPtr& cut, bool chooses_integration,
                     bool solves_all) {
  StepModel model;
  model.cut = cut;
  model.problem = &problem;
  model.step = &step;
  model.surfaces = &surfaces;
  if (!step.is_static) model.scheme = TimeScheme::implicit(step.dt, problem.numerical_damping());
  model.conditions = make_conditions(problem, step, start, moved_nodes(problem, step, start, *cut));
  if (chooses_integration && !step.is_static) {
    model.integration = choose_integration(problem, step, bodies, *cut, model.conditions, surfaces);
    model.scheme.dt = step.dt / model.integration.n_substeps;
  }
  model.loads = std::make_unique<Loads>(problem, step, start, inertia_of(*cut, bodies, model.integration.is_explicit),
                                        model.has_explicit() ? inertia_of(*cut, bodies, {}) : InertiaForce());
  if (step.is_static) free_motions_of(model, surfaces, bodies);
  const std::vector<char>& is_explicit = model.integration.is_explicit;
  const Reach reach =
      solves_all ? Reach() : Reach(problem, step, *cut, surfaces, is_explicit, solved_everywhere(model));
  model.exchange = make_exchange(problem, step, *cut, surfaces, model.conditions, is_explicit, reach);
  refuse_torn_ties(problem, step, model.conditions, surfaces, model.exchange);
  split_loads(model);
  model.offset.assign(1, 0);
  for (const int n : model.exchange.n_unknowns) model.offset.push_back(model.offset.back() + n);
  for (int i = 0; i < cut->n_pieces(); ++i)
    if (cut->is_here(i)) model.here.push_back(i);
  model.unknowns = segments_of(*cut, model.exchange.n_unknowns);
  model.near =
      solves_all ? NearUnknowns(model.exchange, model.offset) : NearUnknowns(*cut, model.exchange, model.offset);
  return model;
}

}  // namespace

bool fits_in_one(const Problem& problem) {
  constexpr long most_unknowns = 600000;
  const LatinSettings& asked = problem.solver;
  if (asked.plain || asked.static_steps != StaticSteps::automatic || asked.static_tolerance < 1e-12) return false;
  long n = 0;
  for (const SubstructurePtr& part : problem.substructures) n += 3L * part->mesh->n_nodes();
  return n <= most_unknowns;
}

namespace {

// The number of substructures in the largest group that interfaces connect in a step.
size_t most_together(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces) {
  const auto n = static_cast<int>(problem.substructures.size());
  UnionFind groups(n);
  for (const Surface& surface : surfaces)
    if (surface.part_1 >= 0 && surface.part_2 >= 0 && takes_part(problem, step, surface))
      groups.join(surface.part_1, surface.part_2);
  std::vector<size_t> count(problem.substructures.size(), 0);
  for (int i = 0; i < n; ++i) ++count[static_cast<size_t>(groups.root(i))];
  return *std::max_element(count.begin(), count.end());
}

// Assembled increments cost some factors each, iterated steps dense operators at their start and next to nothing an
// increment, unless many parts are joined by contact alone. Forces and ties of the former agree to twelve
// digits at best. Part by part, what goes around a ring comes back to a sector of it again and again.
bool is_assembled(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces) {
  constexpr int few_increments = 5;
  constexpr size_t many_parts = 10;
  const LatinSettings& asked = problem.solver;
  if (!step.is_static || asked.plain) return false;
  if (asked.static_steps != StaticSteps::automatic) return asked.static_steps == StaticSteps::assembled;
  return step.increments <= few_increments && fits_in_one(problem) &&
         (most_together(problem, step, surfaces) >= many_parts ||
          std::any_of(problem.interfaces.begin(), problem.interfaces.end(),
                      [](const InterfacePtr& interface) { return interface->cyclic.has_value(); }));
}

// Every rank holds such a system and solves it: what one process does is done as often, and passes nowhere.
bool fits_every_rank(const Problem& problem, const Step& step) {
  if (ranks::is_alone() || problem.solver.static_steps == StaticSteps::assembled) return true;
  double n = 0.0;
  for (const SubstructurePtr& part : problem.substructures) n += 3.0 * part->mesh->n_nodes();
  // Of factor and matrices of solids, about (manual, several machines).
  const double bytes = 200.0 * std::pow(n, 4.0 / 3.0);
  const double all = ranks::count_on_machine() * bytes, available = available_memory();
  if (!ranks::any(available > 0.0 && all > 0.5 * available)) return true;
  warn(
      fmt::format("static step '{}' is iterated substructure by substructure: a single system, as one process would "
                  "solve, would need about {:.1f} GB on each MPI rank; the forces of both agree to 'static_tolerance'",
                  step.name, 1e-9 * bytes));
  return false;
}

// One process solves equal pieces together, whose last digits depend on how many there are.
void tell_equal_apart(const StepModel& model) {
  if (ranks::is_alone() || model.is_assembled) return;
  std::map<std::pair<std::string, MaterialKey>, int> first;
  for (int i = 0; i < model.cut->n_pieces(); ++i) {
    if (model.integration.is_explicit_piece(i)) continue;
    const CutPiece& piece = model.cut->piece(i);
    const auto [equal, is_new] = first.try_emplace({piece.body->mesh->shape_digest(), piece.body->material.key()}, i);
    if (is_new || model.cut->piece(equal->second).rank == piece.rank) continue;
    const auto name = [&](int p) { return model.problem->substructures[model.cut->piece(p).part]->name; };
    warn(
        fmt::format("identical substructures are on several MPI ranks, '{}' and '{}' among them: one process solves "
                    "them together, so the last digits differ; iterated increments agree to the tolerance",
                    name(equal->second), name(i)));
    return;
  }
}

// What condensing the largest piece takes beside what it leaves: the Schur complement and its inverse in full.
double bytes_of_condensing(const StepModel& model) {
  double most = 0.0;
  for (size_t i = 0; i < model.exchange.n_unknowns.size(); ++i)
    if (!model.integration.is_explicit_piece(static_cast<int>(i)))
      most = std::max(most, static_cast<double>(model.exchange.n_unknowns[i]));
  return 2.0 * 8.0 * most * most;
}

// A factor for the search directions, and one for each turn of the points, with some solves that read it.
StepCost cost_of_system(const AssembledSystem& system, int increments, bool turns) {
  constexpr double solves = 8.0, fewest = 2.0, most = 12.0;
  const double n = turns ? most : 1.0, least = turns ? fewest : 1.0;
  const Cost factor{system.operations(), solves * system.bytes()};
  return {factor, factor, increments * least, increments * n,
          turns ? fmt::format("{:.0f} to {:.0f} factors an increment", least, n) : ""};
}

// All but the pieces.
StepModel without_pieces(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces,
                         const std::vector<Body>& bodies, const State& start, const CutPtr& cut) {
  const bool is_in_one = is_assembled(problem, step, surfaces) && fits_every_rank(problem, step);
  StepModel model = make_model(problem, step, surfaces, bodies, start, cut, true, is_in_one || ranks::is_alone());
  model.is_assembled = is_in_one;
  if (model.is_assembled && !ranks::is_alone()) {
    model.here.resize(static_cast<size_t>(cut->n_pieces()));
    std::iota(model.here.begin(), model.here.end(), 0);
    model.unknowns = {};
    model.assembled_bodies = with_all_matrices(bodies);
  }
  return model;
}

void add_pieces(StepModel& model, const std::vector<Body>& bodies, const StepOperators* earlier) {
  model.pieces = !model.is_assembled ? make_pieces(model, bodies, earlier)
                 : ranks::is_alone() ? make_assembled_pieces(model, bodies)
                                     : make_assembled_pieces(model, model.assembled_bodies);
  model.equal = group_equal(model.pieces);
  tell_equal_apart(model);
}

}  // namespace

StepModel make_step_model(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces,
                          const std::vector<Body>& bodies, const State& start, const CutPtr& cut) {
  StepModel model = without_pieces(problem, step, surfaces, bodies, start, cut);
  add_pieces(model, bodies, nullptr);
  return model;
}

StepModel make_step_model(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces,
                          const State& start, const SharedOperators& operators) {
  StepModel model = without_pieces(problem, step, surfaces, operators.bodies(), start, operators.cut());
  add_pieces(model, operators.bodies(), operators.of_step(static_cast<size_t>(index_of(problem.steps, &step))));
  return model;
}

StepModel make_assembled_model(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces,
                               const std::vector<Body>& bodies, const State& start) {
  StepModel model = make_model(problem, step, surfaces, bodies, start, no_cut(problem), false, true);
  model.pieces = make_assembled_pieces(model, bodies);
  model.equal = group_equal(model.pieces);
  return model;
}

StepNeeds predict_needs(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces,
                        const std::vector<Body>& bodies, const State& start, const CutPtr& cut) {
  StepModel model = make_model(problem, step, surfaces, bodies, start, cut, true, true);
  if (is_assembled(problem, step, surfaces)) {
    model.pieces = make_assembled_pieces(model, bodies);
    const AssembledSystem system(model);
    return {{system.bytes(), model.n_q(), model.integration},
            resident_memory() + system.bytes_to_come(),
            cost_of_system(system, step.increments, may_turn(problem, step, surfaces))};
  }
  const double bytes = predicted_bytes(model, bodies);
  return {{bytes, model.n_q(), model.integration},
          resident_memory() + bytes + bytes_of_condensing(model),
          predict_cost(problem, step, surfaces, bodies, *cut, model.integration)};
}

StepSize predict_step(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces,
                      const std::vector<Body>& bodies, const State& start, const CutPtr& cut) {
  return predict_needs(problem, step, surfaces, bodies, start, cut).size;
}

}  // namespace dygita
