// Blocks of steel in contact, tied or bolted, built without a deck: problems for the solvers and what they are made of.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/log.hpp"
#include "base/progress.hpp"
#include "law/law.hpp"
#include "mesh/box.hpp"
#include "model/given_arguments.hpp"
#include "model/load.hpp"
#include "solution/make_pieces.hpp"
#include "solution/observer.hpp"
#include "solution/piece_case.hpp"
#include "solution/solver_figures.hpp"
#include "solution/step_ends.hpp"

namespace dygita {

using BlockPtr = std::shared_ptr<Substructure>;

inline BlockPtr block(const std::string& name, const Vec3& origin, const Vec3& size, const std::array<int, 3>& cells) {
  auto part = std::make_shared<Substructure>();
  part->name = name;
  part->mesh = box_mesh(origin, size, cells);
  part->material = steel();
  return part;
}
inline Face face(const BlockPtr& part, const char* group) { return {part, group}; }

// Cubes of 10 mm with n cells along each edge, at a place counted in cubes.
inline BlockPtr cube(const std::string& name, int x, int y, int z, int n = 2) {
  return block(name, 0.01 * Vec3(x, y, z), Vec3::Constant(0.01), {n, n, n});
}

inline InterfacePtr interface(const std::string& name, const Face& side_1, const Face& side_2, LawPtr law) {
  auto made = std::make_shared<Interface>();
  made->name = name;
  made->side_1 = side_1;
  made->side_2 = side_2;
  made->law = std::move(law);
  return made;
}
inline LawPtr bonded() { return make_law("bonded"); }
inline LawPtr contact(double friction, double gap = 0.0) {
  return make_law("contact", {{"friction", friction}, {"gap", gap}});
}
inline LawPtr plastic(double yield, double hardening = 0.0, bool compression = false) {
  return make_law("plastic", {{"yield", yield}, {"hardening", hardening}, {"compression", compression ? 1.0 : 0.0}});
}

inline std::shared_ptr<Support> support(SupportKind kind, std::vector<FaceOrRegion> on, LawPtr law = nullptr) {
  auto made = std::make_shared<Support>();
  made->name = std::string("support.") + support_kind_name(kind);
  made->kind = kind;
  made->on = std::move(on);
  made->law = std::move(law);
  return made;
}

// A load by its word; component: of those along x, y and z.
inline LoadPtr load(const std::string& word, std::vector<Target> on, const History& value, int component = 0,
                    bool is_number = false) {
  GivenArguments given("load." + word, Origin());
  given.on = std::move(on);
  static const std::map<std::string, std::string> keys = {
      {"pressure", "history"}, {"shortening", "by"}, {"preload", "force"}, {"release", "at"}};
  const auto key = keys.find(word);
  given.values_of_time[key == keys.end() ? std::string(1, "xyz"[component]) : key->second] = {value, is_number};
  return make_load(given);
}
inline LoadPtr number(const std::string& word, std::vector<Target> on, double value, int component = 0) {
  return load(word, std::move(on), History::constant(value), component, true);
}

inline std::shared_ptr<Step> static_step(const std::string& name, int increments, std::vector<LoadPtr> loads,
                                         StepPtr after = nullptr) {
  auto step = std::make_shared<Step>();
  step->name = name;
  step->is_static = true;
  step->increments = increments;
  step->loads = std::move(loads);
  step->after = std::move(after);
  return step;
}
inline std::shared_ptr<Step> dynamic_step(const std::string& name, int n, double dt, std::vector<LoadPtr> loads,
                                          StepPtr after = nullptr) {
  auto step = std::make_shared<Step>();
  step->name = name;
  step->duration = n * dt;
  step->dt = dt;
  step->loads = std::move(loads);
  step->after = std::move(after);
  return step;
}

// What a solver's model of a step is made of, with everything that it points to.
struct Modelled {
  Problem problem;
  std::vector<Surface> surfaces;
  CutPtr cut;
  std::vector<Body> bodies;
  State state;
  StepModel model;

  explicit Modelled(Problem of, size_t i_step = 0, bool is_assembled = false)
      : problem(std::move(of)),
        surfaces(make_surfaces(problem)),
        cut(make_cut(problem)),
        bodies(make_bodies(problem, surfaces, *cut)),
        state(initial_state(problem, surfaces)),
        model(is_assembled ? make_assembled_model(problem, *problem.steps[i_step], surfaces, bodies, state)
                           : make_step_model(problem, *problem.steps[i_step], surfaces, bodies, state, cut)) {}
  Modelled(const Modelled&) = delete;
  Modelled& operator=(const Modelled&) = delete;

  // Node of a substructure at a place, m.
  int node_at(int part, const Vec3& place) const {
    const Points& nodes = problem.substructures[part]->mesh->nodes;
    for (int i = 0; i < nodes.cols(); ++i)
      if ((nodes.col(i) - place).norm() < 1e-9) return i;
    ADD_FAILURE() << "no node of substructure " << part << " at " << place.transpose();
    return 0;
  }
};

// Everything that a solver shows.
struct Recorder : Observer {
  struct Row {
    double time = 0.0;
    std::vector<Points> displacement, velocity, reactions;
    std::vector<SurfaceState> surfaces;
    Energies energies;
    int iterations = 0;
    bool converged = false;
  };
  std::vector<Row> rows;

  void begin_step(const Instant&) override {}
  void accept(const Instant& instant) override {
    Row row{instant.time(),   {}, {}, {}, instant.state.surfaces, instant.state.energies, instant.iterations,
            instant.converged};
    for (int part = 0; part < static_cast<int>(instant.model.problem->substructures.size()); ++part) {
      row.displacement.push_back(instant.displacement(part));
      row.velocity.push_back(instant.velocity(part));
      row.reactions.push_back(instant.reactions(part));
    }
    rows.push_back(std::move(row));
  }
};

// Largest difference of a nodal field between two runs, of the largest value of the second.
template <class Field>
double difference(const Recorder& one, const Recorder& other, Field&& field) {
  EXPECT_EQ(one.rows.size(), other.rows.size());
  double apart = 0.0, size = 0.0;
  for (size_t i = 0; i < std::min(one.rows.size(), other.rows.size()); ++i)
    for (size_t part = 0; part < field(one.rows[i]).size(); ++part) {
      apart = std::max(apart, (field(one.rows[i])[part] - field(other.rows[i])[part]).cwiseAbs().maxCoeff());
      size = std::max(size, field(other.rows[i])[part].cwiseAbs().maxCoeff());
    }
  EXPECT_GT(size, 0.0);
  return apart / size;
}
inline double displacement_difference(const Recorder& one, const Recorder& other) {
  return difference(
      one, other, [](const Recorder::Row& row) -> const auto& { return row.displacement; });
}
inline double velocity_difference(const Recorder& one, const Recorder& other) {
  return difference(
      one, other, [](const Recorder::Row& row) -> const auto& { return row.velocity; });
}

// Two cubes, one on the other with a law between them, the lower one fixed below; in `steps`.
inline Problem two_cubes(LawPtr law, std::vector<StepPtr> steps, int n = 2) {
  Problem problem;
  problem.name = "two_cubes";
  const BlockPtr lower = cube("lower", 0, 0, 0, n), upper = cube("upper", 0, 0, 1, n);
  problem.substructures = {lower, upper};
  problem.interfaces = {interface("between", face(lower, "zmax"), face(upper, "zmin"), std::move(law))};
  problem.supports = {support(SupportKind::fixed, {face(lower, "zmin")})};
  problem.steps = std::move(steps);
  problem.solver.tolerance = problem.solver.static_tolerance = 1e-11;
  problem.solver.max_iterations = 2000;
  set_progress_enabled(false);
  return problem;
}
inline Face top_of(const Problem& problem) { return {problem.substructures[1], "zmax"}; }

}  // namespace dygita
