// Runs that keep their fields, and their true errors against other runs: what error estimates are held against.
//
// True errors are in the energy norm, at the worst of all instants, relative to the energy of the shock (manual, eq.
// Q0), as the estimates are.
#pragma once

#include <map>

#include "decks/engine.hpp"
#include "marching/solve.hpp"
#include "mesh/face_nodes.hpp"
#include "recording/collector.hpp"
#include "step/step_model.hpp"

namespace dygita::test {

inline constexpr int n_instants = 48;

// Nodal fields of all substructures at instants that runs with other time steps share.
struct Fields {
  std::vector<std::vector<Points>> displacement, velocity;
};

class Recorder : public Observer {
 public:
  explicit Recorder(const Problem& problem) : parts(problem), collector(problem, parts, nullptr) {}
  void begin_step(const Instant& start) override {
    parts.begin_step(start);
    collector.begin_step(start);
  }
  void accept(const Instant& instant) override {
    parts.accept(instant);
    collector.accept(instant);
    const long n = instant.model.step->n_increments(), i = instant.increment + 1;
    if (i * n_instants % n != 0) return;
    std::vector<Points> u, v;
    for (size_t p = 0; p < instant.model.problem->substructures.size(); ++p) {
      u.push_back(instant.displacement(static_cast<int>(p)));
      v.push_back(instant.velocity(static_cast<int>(p)));
    }
    fields.displacement.push_back(std::move(u));
    fields.velocity.push_back(std::move(v));
  }
  PartWatch parts;
  Collector collector;
  Fields fields;
};

struct EstimatedRun {
  Problem problem;
  Figures figures;
  Fields fields;
};

inline EstimatedRun run_estimated(const std::filesystem::path& path, const Settings& settings, double tolerance = 0.0,
                                  bool is_tuned = false,
                                  IntegrationChoice integration = IntegrationChoice::implicitly) {
  set_progress_enabled(false);
  EstimatedRun done;
  const Engine engine{[&](Problem problem, const RunRequest&) {
                        problem.solver.integration = integration;
                        if (tolerance > 0.0) problem.solver.tolerance = tolerance;
                        problem.solver.mass.is_tuned = is_tuned;
                        Recorder recorder(problem);
                        solve(problem, recorder);
                        auto result = std::make_shared<RunResult>();
                        recorder.parts.settle();
                        recorder.collector.finish(*result);
                        done = {problem, result->figures, std::move(recorder.fields)};
                        return std::shared_ptr<const RunResult>(result);
                      },
                      check_report};
  DeckOptions options;
  options.path = path;
  options.settings = settings;
  options.write_files = false;
  run_deck(options, engine);
  return done;
}

// From fields on a bar of few cells along z to one of many, both of one cell across, node numbering by layers.
inline Points on_finer(const Points& coarse, int n_coarse, int n_fine) {
  const int ratio = n_fine / n_coarse;
  Points fine(3, 4 * (n_fine + 1));
  for (int layer = 0; layer <= n_fine; ++layer) {
    const int below = std::min(layer / ratio, n_coarse - 1);
    const double x = static_cast<double>(layer) / ratio - below;
    for (int a = 0; a < 4; ++a)
      fine.col(4 * layer + a) = (1 - x) * coarse.col(4 * below + a) + x * coarse.col(4 * (below + 1) + a);
  }
  return fine;
}

// Is nothing of the assembly held along this axis? Of scenes whose faces under supports lie across the axes.
inline bool is_free_along(const Problem& problem, int axis) {
  for (const SupportPtr& support : supports_of(problem, *problem.steps.back()))
    for (const FaceOrRegion& on : support->on) {
      const auto* face = std::get_if<Face>(&on);
      if (!face || support->kind->holds(false) == Directions::all || support->kind->absorbs()) return false;
      if (std::abs(face_nodes(*face->part->mesh, face->facets()).normals(axis, 0)) > 0.5) return false;
    }
  return true;
}

// Velocities less that of the centre of mass, where it is free (manual, eq. Q0).
inline std::vector<Points> relative(const Problem& problem, const std::vector<Body>& bodies,
                                    std::vector<Points> velocity) {
  Vec3 momentum = Vec3::Zero();
  double mass = 0.0;
  for (size_t p = 0; p < bodies.size(); ++p) {
    momentum += velocity[p] * bodies[p].matrices->mass();
    mass += bodies[p].matrices->mass().sum();
  }
  for (int d = 0; d < 3; ++d)
    if (!is_free_along(problem, d)) momentum[d] = 0.0;
  for (Points& v : velocity) v.colwise() -= Vec3(momentum / mass);
  return velocity;
}

// Largest error of a run against a reference, in percent.
inline double true_error(const EstimatedRun& a, const EstimatedRun& reference, int n = 0, int n_reference = 0) {
  const std::vector<Body> bodies = make_bodies(reference.problem, make_surfaces(reference.problem));
  double worst = 0.0, kinetic = 0.0, stored = 0.0;
  const auto strain = [&](size_t p, const Points& u) {
    const Eigen::Map<const Vec> flat(u.data(), u.size());
    return 0.5 * flat.dot(*bodies[p].matrices->stiffness() * flat);
  };
  const auto motion = [&](size_t p, const Points& v) {
    return 0.5 * bodies[p].matrices->mass().dot(v.colwise().squaredNorm().transpose());
  };
  for (size_t i = 0; i < reference.fields.velocity.size(); ++i) {
    const std::vector<Points> own = relative(reference.problem, bodies, reference.fields.velocity[i]);
    double error = 0.0, now = 0.0, held = 0.0;
    for (size_t p = 0; p < bodies.size(); ++p) {
      Points u = a.fields.displacement.at(i)[p], v = a.fields.velocity.at(i)[p];
      if (n != n_reference) u = on_finer(u, n, n_reference), v = on_finer(v, n, n_reference);
      now += motion(p, own[p]);
      held += strain(p, reference.fields.displacement[i][p]);
      u -= reference.fields.displacement[i][p];
      v -= reference.fields.velocity[i][p];
      error += strain(p, u) + motion(p, v);
    }
    worst = std::max(worst, error);
    kinetic = std::max(kinetic, now);
    stored = std::max(stored, now + held);
  }
  return 100.0 * std::sqrt(worst / std::max(2.0 * kinetic, stored));
}

inline const char* const pulse = R"(
local p = param{ n = 100, steps = 480 }
local E, rho, L, side = 200*GPa, 8000, 50*mm, 5*mm
local c = math.sqrt(E / rho)
local T = L / c
local steel = material.elastic{ name = "steel", young = E, poisson = 0, density = rho }
local lower = substructure{ name = "lower", material = steel, mesh = mesh.box{ size = { side, side, L / 2 }, cells = { 1, 1, p.n / 2 } } }
local upper = substructure{ name = "upper", material = steel,
  mesh = mesh.box{ origin = { 0, 0, L / 2 }, size = { side, side, L / 2 }, cells = { 1, 1, p.n / 2 } } }
local tie = interface.bonded{ name = "tie", between = { lower:face "zmax", upper:face "zmin" } }
local pull = step.dynamic{ name = "pull", duration = 2.4 * T, dt = 2.4 * T / p.steps, loads = {
  load.traction{ on = upper:face "zmax", z = function(t) return t < 0.6 * T and 100*MPa * math.sin(math.pi * t / (0.6 * T))^4 or 0 end } } }
problem{ name = "pulse", substructures = { lower, upper }, interfaces = { tie }, steps = { pull } }:run{}
)";

inline const char* const impact = R"(
local p = param{ n = 100, steps = 480 }
local E, rho, L, side = 1*GPa, 1000, 1*mm, 0.1*mm
local c = math.sqrt(E / rho)
local metal = material.elastic{ name = "metal", young = E, poisson = 0, density = rho }
local function bar(name, from, velocity)
  return substructure{ name = name, material = metal, velocity = { 0, 0, velocity },
    mesh = mesh.box{ origin = { 0, 0, from }, size = { side, side, L }, cells = { 1, 1, p.n / 2 } } }
end
local left, right = bar("left", 0, 100), bar("right", L, -100)
local touch = interface.contact{ name = "touch", between = { left:face "zmax", right:face "zmin" } }
local meet = step.dynamic{ name = "meet", duration = 2.4 * L / c, dt = 2.4 * L / c / p.steps }
problem{ name = "impact", substructures = { left, right }, interfaces = { touch }, steps = { meet } }:run{}
)";

inline const char* const yielding = R"(
local p = param{ n = 100, steps = 480 }
local E, rho, L, side = 200*GPa, 8000, 50*mm, 5*mm
local c = math.sqrt(E / rho)
local T = L / c
local steel = material.elastic{ name = "steel", young = E, poisson = 0, density = rho }
local lower = substructure{ name = "lower", material = steel, mesh = mesh.box{ size = { side, side, L / 2 }, cells = { 1, 1, p.n / 2 } } }
local upper = substructure{ name = "upper", material = steel,
  mesh = mesh.box{ origin = { 0, 0, L / 2 }, size = { side, side, L / 2 }, cells = { 1, 1, p.n / 2 } } }
local tie = interface.plastic{ name = "tie", between = { lower:face "zmax", upper:face "zmin" }, yield = 60*MPa }
local pull = step.dynamic{ name = "pull", duration = 1.2 * T, dt = 1.2 * T / p.steps, loads = {
  load.traction{ on = upper:face "zmax", z = function(t) return t < 0.6 * T and 100*MPa * math.sin(math.pi * t / (0.6 * T))^2 or 0 end } } }
problem{ name = "yielding", substructures = { lower, upper }, interfaces = { tie }, steps = { pull } }:run{}
)";

}  // namespace dygita::test
