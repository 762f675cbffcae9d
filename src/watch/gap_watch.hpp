// Watches a run for how deep contacts penetrate each other by their laws' own gaps, and for walls that appear where a
// part already is: each rank the points that it keeps.
#pragma once

#include <vector>

#include "result/result.hpp"
#include "step/observer.hpp"

namespace dygita {

class GapWatch {
 public:
  void begin_step(const Instant& start);
  void accept(const Instant& instant);
  // Collective.
  void settle();
  // Adds a warning for each wall that a dynamic step puts where a part is, and the figure.
  void finish(RunResult& result) const;

 private:
  // A wall in a dynamic step that the step before did not have.
  struct New {
    const Support* wall;
    const Step* step;
    const Substructure* part;
    double depth;  // m, of the part behind it when the step begins
    double least;  // m, that says something of it
  };
  double deepest_ = 0.0;  // m
  std::vector<New> walls_;
};

}  // namespace dygita
