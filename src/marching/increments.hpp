// How a step goes from one time step of the deck to the next.
#pragma once

#include <memory>

#include "marching/follow.hpp"
#include "marching/step_books.hpp"

namespace dygita {

class Increments {
 public:
  virtual ~Increments() = default;
  // Time steps of the deck [first, last), of which it takes so many at once as the step's window has.
  virtual void solve(int first, int last) = 0;
  virtual double gap_difference() const { return 0.0; }  // m, of points that are not iterated; as LocalStage's
};

// Each by itself; several in each iteration; each in increments of explicit pieces.
std::unique_ptr<Increments> single_increments(Iteration& iteration, StepBooks& books);
std::unique_ptr<Increments> windows(Iteration& iteration, StepBooks& books);
std::unique_ptr<Increments> substeps(Iteration& iteration, StepBooks& books);

}  // namespace dygita
