// External forces of a step on each substructure.
#pragma once

#include "interfaces/conditions.hpp"

namespace dygita {

// Nodal force pattern of one load component on one substructure, scaled by its value in time.
struct LoadPattern {
  int part = -1;
  std::vector<std::pair<int, Vec3>> nodes;  // force at a node for a value of one, N
  LoadValue value;
  std::string key;    // in State::reached; empty: of no load of the step's own
  double size = 0.0;  // N, of the forces for a value of one: those on one of two faces are half of those on both
};

// Nodes of a substructure's mesh under a load, and what a load asks of them.
struct NodesUnderLoad {
  std::vector<int> nodes;
  LoadedNodes loaded;
};
NodesUnderLoad nodes_under_load(const FaceOrRegion& on);

// Mass of a substructure times an acceleration of its nodes (3 x n, m/s^2): N.
using InertiaForce = std::function<Points(int part, const Points& acceleration)>;

class Loads {
 public:
  // inertia: for gravity; of_static_steps: by that mass, where it differs in this step.
  Loads(const Problem& problem, const Step& step, const State& start, const InertiaForce& inertia,
        const InertiaForce& of_static_steps = {});

  // Evaluates all loads for an increment: at its end in a static step, mean over it in a dynamic one. One thread only:
  // a history may be a function of the deck.
  void evaluate(int increment);
  // The same in a dynamic step for the mean over [t0, t1], s from the start of the step.
  void evaluate_mean(double t0, double t1);
  const std::vector<LoadPattern>& patterns() const { return patterns_; }
  const std::vector<double>& values() const { return values_; }  // of each pattern, as last evaluated
  // From now on inertia opposes the loads: of each motion the forces of a unit acceleration, 3 x n_nodes of each
  // substructure, and by how much a unit of each pattern so far accelerates it (motions x patterns). Static steps only.
  void oppose(const std::vector<std::vector<Points>>& inertia, Mat accelerations);
  // Of those motions, as last evaluated.
  Vec accelerations() const;
  // Adds the forces (3 x n_nodes, N) on a substructure, as last evaluated.
  void add_forces(int part, Points& force) const;

  // Shortening (m) reached at the end of an increment by a surface whose interface is loaded, else what it had.
  double shortening(const Interface* interface, double had, int increment) const;
  // The preload of an interface, as its load says it; null: none in this step. `from` is for the solver to set.
  const LoadValue* preload(const Interface* interface) const;
  // Has the interface let go by the middle of this increment?
  bool is_released(const Interface* interface, int increment) const;
  // Has it let go when the step ends?
  bool is_released_in_step(const Interface* interface) const;

  // Values reached at the end of the step, for the next one.
  std::map<std::string, double> reached() const;

 private:
  void add(const NodalForces& forces, const TimeValue& value, const State& start);
  void add(const BodyForce& force, const LoadValue& value, const std::string& key, const InertiaForce& inertia);
  void add(const Shortening& shortening, const State& start);
  void note_reached(const PrescribedMotion& motion, const State& start);
  void add_vanished(const State& start, const InertiaForce& inertia);
  void keep_as_laid(const InertiaForce& inertia, const InertiaForce& of_static_steps);

  const Problem& problem_;
  const Step& step_;
  std::vector<LoadPattern> patterns_;
  std::vector<double> values_;  // of each pattern
  struct {
    std::vector<int> motions;  // of each of the last patterns, that of the inertia which it is
    Mat accelerations;         // of motions, by a unit of each of the patterns before
  } opposed_;
  std::vector<std::pair<const Interface*, LoadValue>> shortenings_, preloads_;
  std::vector<std::pair<const Interface*, double>> releases_;
  std::map<std::string, double> motions_reached_;
};

}  // namespace dygita
