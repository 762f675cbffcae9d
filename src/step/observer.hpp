// What a solver shows while it runs: every accepted increment, interiors on demand.
#pragma once

#include "step/distant_points.hpp"

namespace dygita {

// Nodal fields of a solver that does not leave them to the pieces; as the functions of Instant.
class NodalFields {
 public:
  virtual ~NodalFields() = default;
  virtual Points displacement(int part) const = 0;
  virtual Points velocity(int part) const = 0;
  virtual Points acceleration(int part) const = 0;
  virtual Points reactions(int part) const = 0;
  virtual Points absorbing_force(int part) const = 0;
};

struct Instant {
  const StepModel& model;
  const State& state;  // energies and time are those of this instant; nodal fields come from the pieces
  int i_step = 0;      // index in the problem's steps
  int increment = -1;  // -1: the step's start
  int iterations = 0;
  double indicator = 0.0;
  bool converged = true;
  double interface_energy = 0.0;  // J, constitutive-relation error of the interfaces in this increment (manual, eq. Q1)
  const NodalFields* fields = nullptr;     // null: the pieces have them
  const DistantPoints* distant = nullptr;  // null: all points of the interfaces are here
  // Of a dynamic increment that is iterated, of all pieces: energies, and what the iteration has left at their points
  // (LocalStage::take_work_left, J). Null: none.
  const std::vector<IncrementEnergy>* energies = nullptr;
  const std::vector<double>* work_left = nullptr;

  double time() const { return state.time; }
  // Increment of the scheme that ends the time step of the deck; negative at the step's start.
  int last_substep() const { return (increment + 1) * model.n_substeps() - 1; }
  double interval() const { return is_static() ? model.scheme.dt : model.step->dt; }  // s, of the deck
  bool is_static() const { return model.scheme.is_static; }
  // Fields of an interface or wall at this instant; on several ranks those of the first may ask.
  const SurfaceState& surface(int s) const {
    if (distant) distant->complete(s);
    return state.surfaces[static_cast<size_t>(s)];
  }
  // f(index, state) of every point of it that this rank keeps; together they keep all.
  template <class Function>
  void for_each_point_here(int s, Function&& f) const {
    const std::vector<LawState>& points = state.surfaces[static_cast<size_t>(s)].points;
    if (distant)
      for (const int i : distant->here(s)) f(i, points[static_cast<size_t>(i)]);
    else
      for (size_t i = 0; i < points.size(); ++i) f(static_cast<int>(i), points[i]);
  }
  // 3 x n_nodes each: m, m/s, m/s^2 (mean over the increment).
  Points displacement(int part) const {
    if (fields) return fields->displacement(part);
    return model.cut->from_owners(part, [&](int piece) { return model.pieces[piece]->displacement(); });
  }
  Points velocity(int part) const {
    // What a static increment calls V is a displacement; the body rests.
    if (is_static()) return Points::Zero(3, model.problem->substructures[part]->mesh->n_nodes());
    if (fields) return fields->velocity(part);
    return model.cut->from_owners(part, [&](int piece) { return model.pieces[piece]->velocity(); });
  }
  Points acceleration(int part) const {
    if (fields) return fields->acceleration(part);
    return model.cut->from_owners(part, [&](int piece) { return model.pieces[piece]->acceleration(); });
  }
  // Of a piece: its own copies, 3 x its nodes.
  Points piece_displacement(int piece) const {
    return fields ? model.cut->on_piece(piece, fields->displacement(model.cut->piece(piece).part))
                  : model.pieces[piece]->displacement();
  }
  // The same at some nodes alone, 3 x nodes, in their order.
  Points displacement(int part, const std::vector<int>& nodes) const {
    if (fields) return fields->displacement(part)(Eigen::all, nodes);
    return model.cut->from_owners(
        part, nodes, [&](int piece, const std::vector<int>& of) { return model.pieces[piece]->displacement(of); });
  }
  Points velocity(int part, const std::vector<int>& nodes) const {
    if (is_static()) return Points::Zero(3, static_cast<Eigen::Index>(nodes.size()));
    if (fields) return fields->velocity(part)(Eigen::all, nodes);
    return model.cut->from_owners(
        part, nodes, [&](int piece, const std::vector<int>& of) { return model.pieces[piece]->velocity(of); });
  }
  Points acceleration(int part, const std::vector<int>& nodes) const {
    if (fields) return fields->acceleration(part)(Eigen::all, nodes);
    return model.cut->from_owners(
        part, nodes, [&](int piece, const std::vector<int>& of) { return model.pieces[piece]->acceleration(of); });
  }
  // Force (N) on nodes of a substructure from whatever holds or moves them, mean over the increment.
  Points reactions(int part) const {
    if (fields) return fields->reactions(part);
    for (size_t s = 0; s < model.surfaces->size(); ++s)
      if (const Surface& of = (*model.surfaces)[s]; of.part_1 == part || of.part_2 == part)
        surface(static_cast<int>(s));
    return model.reactions(part, state);
  }
  // Force (N) of absorbing supports beside what they kept of a static step, mean over the increment.
  Points absorbing_force(int part) const {
    if (fields) return fields->absorbing_force(part);
    return model.cut->summed(part, [&](int piece) { return model.pieces[piece]->absorbing_force(); });
  }
};

class Observer {
 public:
  virtual ~Observer() = default;
  virtual void begin_step(const Instant& start) = 0;
  virtual void accept(const Instant& instant) = 0;
};

// Tells several observers, in order.
class Observers : public Observer {
 public:
  explicit Observers(std::vector<Observer*> observers) : observers_(std::move(observers)) {}
  void add(Observer& observer) { observers_.push_back(&observer); }
  void begin_step(const Instant& start) override {
    for (Observer* observer : observers_) observer->begin_step(start);
  }
  void accept(const Instant& instant) override {
    for (Observer* observer : observers_) observer->accept(instant);
  }

 private:
  std::vector<Observer*> observers_;
};

}  // namespace dygita
