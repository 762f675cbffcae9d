#include "solution/step_model.hpp"

#include <exception>
#include <map>
#include <mutex>

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
    LawState start;
    start.gap = surface.initial_gap;
    if (surface.law && surface.law->rubs()) start.status = PointState::open;
    state.surfaces.push_back({std::vector<LawState>(surface.n_points(), start), std::vector<double>(surface.n_points(), 0.0)});
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

std::vector<Piece::Row> rows_of(const StepModel& model, int part) {
  std::vector<Piece::Row> rows(model.exchange.n_unknowns[part]);
  const Substructure& body = *model.problem->substructures[part];
  double total_area = 0.0;
  for (const Port& port : model.exchange.ports)
    if (port.part == part) total_area += port.area;
  const bool needs_reference = model.scheme.is_static && is_floating(body, model.conditions.held[part]);
  const double length = total_area > 0.0 ? volume(*body.mesh) / total_area : 1.0;
  for (const Point& point : model.exchange.points)
    for (int p = point.first_port; p < point.end_port; ++p) {
      const Port& port = model.exchange.ports[p];
      if (port.part != part) continue;
      for (int d = 0; d < 3; ++d) {
        if (port.unknown[d] < 0) continue;
        const double modulus = d == 0 ? body.material.young : body.material.shear_modulus();
        rows[port.unknown[d]] = {port.node, point.frame.col(d), needs_reference ? modulus * port.area / length : 0.0, 1.0};
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

// Single precision takes a third of what a solve reads from memory, and less of what an interface product reads. A static step has no
// mass that would bound what rounding does to soft motions, and nodes without mass have a recurrence of their own.
Precision precision_of(const StepModel& model, const Body& body) {
  constexpr int large = 4000;  // unknowns
  if (model.scheme.is_static || !body.mass->is_massless.empty()) return Precision::double_precision;
  if (const auto& asked = model.problem->solver.precision) return *asked;
  if (model.problem->solver.tolerance < 1e-7) return Precision::double_precision;
  return 3 * body.part->mesh->n_nodes() > large ? Precision::single_precision : Precision::double_precision;
}

void make_pieces(StepModel& model, const std::vector<Body>& bodies, Purpose purpose) {
  const int n = static_cast<int>(bodies.size());
  model.pieces.resize(n);
  model.offset.assign(1, 0);
  for (int i = 0; i < n; ++i) model.offset.push_back(model.offset.back() + model.exchange.n_unknowns[i]);
  std::vector<std::unordered_map<int, Mat3>> absorbing;
  for (int i = 0; i < n; ++i) absorbing.push_back(absorbing_impedance(*model.problem, *model.step, i));
  std::exception_ptr failure;
  std::mutex mutex;
#pragma omp parallel for schedule(dynamic)
  for (int i = 0; i < n; ++i) {
    prepare_thread();
    try {
      const std::string what = "substructure '" + bodies[i].part->name + "' in step '" + model.step->name + "'";
      model.pieces[i] = std::make_unique<Piece>(Piece::Setup{&bodies[i], model.scheme, &model.conditions.held[i], &absorbing[i],
                                                             rows_of(model, i), static_cast<int>(model.conditions.motions.size()), what, purpose == Purpose::assembled,
                                                             precision_of(model, bodies[i]), purpose == Purpose::prediction});
    } catch (...) {
      const std::scoped_lock lock(mutex);
      failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
}

StepModel make_model(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces,
                     const std::vector<Body>& bodies, const State& start, Purpose purpose) {
  StepModel model;
  model.problem = &problem;
  model.step = &step;
  model.surfaces = &surfaces;
  if (!step.is_static) model.scheme = {false, step.dt, 0.5 * (1.0 - problem.numerical_damping())};
  // A wall that is not among this step's supports has let go.
  std::vector<Surface> in_force = surfaces;
  const std::vector<SupportPtr>& supports = supports_of(problem, step);
  for (Surface& surface : in_force)
    if (surface.wall && index_of(supports, surface.wall) < 0) surface.facing = {};
  model.conditions = make_conditions(problem, step, start);
  model.exchange = make_exchange(problem, in_force, model.conditions);
  std::vector<const Vec*> masses;
  for (const Body& body : bodies) masses.push_back(&body.mass->lumped);
  model.loads = std::make_unique<Loads>(problem, step, start, masses);
  if (step.is_static) {
    std::vector<Points> force;
    model.loads->evaluate(step.increments - 1);
    for (size_t i = 0; i < bodies.size(); ++i) force.push_back(model.external_force(static_cast<int>(i), start));
    pin_free_motions(problem, step, model.exchange, force, model.conditions);
    model.exchange = make_exchange(problem, in_force, model.conditions);
  }
  make_pieces(model, bodies, purpose);
  return model;
}

}  // namespace

StepModel make_step_model(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces,
                          const std::vector<Body>& bodies, const State& start, bool is_assembled) {
  return make_model(problem, step, surfaces, bodies, start, is_assembled ? Purpose::assembled : Purpose::alone);
}

StepSize predict_step(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces, const std::vector<Body>& bodies,
                      const State& start) {
  const StepModel model = make_model(problem, step, surfaces, bodies, start, Purpose::prediction);
  StepSize size;
  for (const auto& piece : model.pieces) size.bytes += piece->predicted_bytes();
  size.n_unknowns = model.n_q();
  return size;
}

}  // namespace dygita
