// Parts that nothing touches at the end of a static increment: they rest, wherever an iteration may have carried them
// (manual, loose parts).
#pragma once

#include <functional>
#include <map>
#include <vector>

#include "exchange/rigid_frame.hpp"
#include "step/step_model.hpp"

namespace dygita {

class LooseMotions {
 public:
  // Of a static step. model outlives this object. Collective, as `find`.
  explicit LooseMotions(const StepModel& model);

  // What an increment says of the points of the exchange. carries: does a force pass between the sides of a point?
  // moved: by how much (m) a port of a piece that is solved here moves along a direction of its point's frame; where
  // the direction has no unknown it is not asked for.
  struct Increment {
    std::function<bool(int point)> carries;
    std::function<double(int port, int d)> moved;
    // How far (m) the sides of a point that carries nothing may come together, infinite where nothing keeps them apart;
    // empty: the caller sees himself to what is in the way of parts at rest.
    std::function<double(int point)> gap = nullptr;
  };
  // Could a part be loose at all, if contacts carry nothing?
  bool may_be() const { return may_be_; }
  // Of each port, in its point's frame (m), the motion as a whole of the parts that forces link to its own, where no
  // support and no force holds these, as far as they may be taken back; empty: there is none.
  std::vector<Vec3> find(const Increment& increment) const;

 private:
  using Mat6 = Eigen::Matrix<double, 6, 6>;
  using Motions = Eigen::Matrix<double, 3, 6>;  // of a port, in its point's frame
  Motions motions_of(const Point& point, const Port& port) const;
  // Parts that move as one.
  struct Group {
    Mat6 held = Mat6::Zero(), square = Mat6::Zero();
    RigidMotion moved = RigidMotion::Zero();
    Mat free, inverse;  // 6 x n, motions that supports leave; of their squares at the ports
    Vec taken;          // of the free motions, taken back
  };
  using Groups = std::map<int, Group>;  // by the first of their parts
  // Of each part, and of the ground after them, the first of those that move with it.
  using Linked = std::vector<int>;
  struct Contact;
  Linked linked_parts(const std::function<bool(int point)>& carries) const;
  Groups loose_groups(const Linked& linked) const;
  void add_motions(const Increment& increment, const Linked& linked, Groups& groups) const;
  std::vector<Contact> contacts_of(const Increment& increment, const Linked& linked, double precision,
                                   Groups& groups) const;
  void keep_apart(std::vector<Contact> contacts, double precision) const;
  bool is_shared_out() const { return !model_->near.is_all(); }

  const StepModel* model_;
  RigidFrame frame_;        // of the assembly
  std::vector<Mat6> held_;  // of each part, sum of squares of what holds its motions
  bool may_be_ = false;
};

}  // namespace dygita
