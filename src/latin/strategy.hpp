// One way of accelerating the iteration of an increment, or of rescuing an increment that it has not solved. A step has
// those that it needs, in the order in which they are asked.
#pragma once

#include <memory>
#include <vector>

#include "latin/step_data.hpp"

namespace dygita {

class Iteration;

class Strategy {
 public:
  virtual ~Strategy() = default;

  // An increment begins, from the fields at hand. Returns what its first iteration is to reach.
  virtual Goal begin(const Goal& goal) { return goal; }
  // Iterations but the first: does it change V and q after the linear stage, which neighbours then wait for? V remains
  // the answer to q.
  virtual bool corrects() const { return false; }
  virtual void correct() {}
  // The image is known and the goal not reached: a better image.
  virtual void after_local_stage() {}
  // The iteration has ended with `best`. Changes the fields at hand and best, or leaves both.
  virtual void rescue(int /*increment*/, const Goal& /*goal*/, Best& /*best*/) {}
};

using Strategies = std::vector<std::unique_ptr<Strategy>>;

// Each null where the step has no use for it. k: search directions of the assembled q.
std::unique_ptr<Strategy> balance_ties(Iteration& iteration, const Vec& k);  // the coarse correction
std::unique_ptr<Strategy> iterate_roughly(Iteration& iteration);             // inner iterations
std::unique_ptr<Strategy> iterate_in_full(Iteration& iteration);             // with kept fields
std::unique_ptr<Strategy> iterate_in_one_system(Iteration& iteration);
std::unique_ptr<Strategy> seat_bolts(Iteration& iteration);
std::unique_ptr<Strategy> iterate_part_by_part(Iteration& iteration);

}  // namespace dygita
