// Parts that nothing touches at the end of a static increment: they rest, wherever an iteration may have carried them
// (manual, loose parts).
#pragma once

#include <functional>
#include <vector>

#include "solution/rigid_frame.hpp"
#include "solution/step_model.hpp"

namespace dygita {

class LooseMotions {
 public:
  // Of a static step. model outlives this object.
  explicit LooseMotions(const StepModel& model);

  // What an increment says of the exchange. carries: does a force pass between the sides of a point? moved: by how much
  // (m) a port moves along a direction of its point's frame; where the direction has no unknown it is not asked for.
  struct Increment {
    std::function<bool(int point)> carries;
    std::function<double(int port, int d)> moved;
  };
  // Of each port, in its point's frame (m), the motion as a whole of the parts that forces link to its own, where no
  // support and no force holds these; empty: there is none.
  std::vector<Vec3> find(const Increment& increment) const;

 private:
  using Motions = Eigen::Matrix<double, 3, 6>;  // of a port, in its point's frame
  Motions motions_of(const Point& point, const Port& port) const;

  const StepModel* model_;
  RigidFrame frame_;                               // of the assembly
  std::vector<Eigen::Matrix<double, 6, 6>> held_;  // of each part, sum of squares of what holds its motions
};

}  // namespace dygita
