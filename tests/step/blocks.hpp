// Blocks of steel in contact, tied or bolted, built without a deck: problems for the solvers and what they are made of.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/log.hpp"
#include "mesh/box.hpp"
#include "model/given_arguments.hpp"
#include "model/load.hpp"
#include "pieces/piece_case.hpp"
#include "step/make_pieces.hpp"
#include "step/observer.hpp"
#include "step/solver_figures.hpp"
#include "step/step_ends.hpp"

namespace dygita {

using BlockPtr = std::shared_ptr<Substructure>;

BlockPtr block(const std::string& name, const Vec3& origin, const Vec3& size, const std::array<int, 3>& cells);
Face face(const BlockPtr& part, const char* group);

// Cubes of 10 mm with n cells along each edge, at a place counted in cubes.
BlockPtr cube(const std::string& name, int x, int y, int z, int n = 2);

InterfacePtr interface(const std::string& name, const Face& side_1, const Face& side_2, LawPtr law);
LawPtr bonded();
LawPtr contact(double friction, double gap = 0.0);
LawPtr plastic(double yield, double hardening = 0.0, bool compression = false);

std::shared_ptr<Support> support(const std::string& word, std::vector<FaceOrRegion> on,
                                 const LawArguments& arguments = {});

// A load by its word; component: of those along x, y and z.
LoadPtr load(const std::string& word, std::vector<Target> on, const History& value, int component = 0,
             bool is_number = false);
LoadPtr number(const std::string& word, std::vector<Target> on, double value, int component = 0);

std::shared_ptr<Step> static_step(const std::string& name, int increments, std::vector<LoadPtr> loads,
                                  StepPtr after = nullptr);
std::shared_ptr<Step> dynamic_step(const std::string& name, int n, double dt, std::vector<LoadPtr> loads,
                                   StepPtr after = nullptr);

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
        cut(make_cut(problem, surfaces)),
        bodies(make_bodies(problem, surfaces, *cut)),
        state(initial_state(problem, surfaces, is_assembled ? *no_cut(problem) : *cut)),
        model(is_assembled ? make_assembled_model(problem, *problem.steps[i_step], surfaces, bodies, state)
                           : make_step_model(problem, *problem.steps[i_step], surfaces, bodies, state, cut)) {}
  Modelled(const Modelled&) = delete;
  Modelled& operator=(const Modelled&) = delete;

  // Node of a substructure at a place, m.
  int node_at(int part, const Vec3& place) const;
};

// Keeps everything that a solver shows.
struct Watcher : Observer {
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
  void accept(const Instant& instant) override;
};

// Largest difference of a nodal field between two runs, of the largest value of the second.
template <class Field>
double difference(const Watcher& one, const Watcher& other, Field&& field) {
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
double displacement_difference(const Watcher& one, const Watcher& other);
double velocity_difference(const Watcher& one, const Watcher& other);

// Two cubes, one on the other with a law between them, the lower one fixed below; in `steps`.
Problem two_cubes(LawPtr law, std::vector<StepPtr> steps, int n = 2);
Face top_of(const Problem& problem);

}  // namespace dygita
