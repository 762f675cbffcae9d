// The books of a step: energies, figures, and what the state and the outputs get of each accepted increment.
#pragma once

#include <optional>

#include "latin/step_data.hpp"
#include "step/distant_points.hpp"

namespace dygita {

class StepBooks {
 public:
  explicit StepBooks(StepData& step);

  void begin_step();
  void end_step();
  // The laws move on to the end of an increment, which is a time step of the deck.
  void accept_increment(int increment, int iterations, double eta);
  // Books a time step of the deck, whose laws have moved on, and shows it.
  void accept_interval(int increment, int iterations, double eta, double interface_energy);
  // Interface fields of an increment, for another case.
  void keep(const Vec& q);
  void note_missed(const Missed& missed);
  std::string describe_progress() const;

  StepFigures& figures() { return figures_; }
  const StepFigures& figures() const { return figures_; }
  // bytes: of the one system; gap_difference: m, of points in closed form.
  void add_to(SolverFigures& figures, double system_bytes, double gap_difference) const;

 private:
  Instant instant(int increment, int iterations, double eta) const;
  bool has_flown_off() const;
  std::vector<IncrementEnergy> all_energies() const;
  void complete_energies(std::vector<IncrementEnergy>& energies) const;

  StepData& step_;
  const double start_time_;  // s; sums of many short time steps would be off by rounding
  StepFigures figures_;
  std::optional<DistantPoints> distant_;  // where there are several ranks
};

}  // namespace dygita
