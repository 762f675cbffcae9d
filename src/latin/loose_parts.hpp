// Parts that nothing touches at the end of a static increment have been carried along by whatever the iteration came
// through; they rest (manual, loose parts).
#pragma once

#include "latin/strategy.hpp"
#include "step/loose_motions.hpp"

namespace dygita {

class LooseParts final : public Strategy {
 public:
  // Null where no part can be loose.
  static std::unique_ptr<LooseParts> of(Iteration& iteration);

  // Between two increments: nothing says that what was loose at the end of the one continues as it went there.
  void stop();
  // The system knows where loose parts are by what they are near to, and carries them along with it: they rest, as far
  // as nothing is in their way there. False: there are none.
  bool leave();
  // Any place at which nothing presses is in balance: loose parts are wherever the iteration has come through, and
  // beside how far they have flown nothing else may count any more. They rest as far as nothing is in their way; what
  // was to the tolerance beside a large motion may need more iterations without it.
  bool is_resting() const { return is_resting_; }
  void rescue(int increment, const Goal& goal, Best& best) override;

 private:
  LooseParts(Iteration& iteration, LooseMotions motions);
  void take_off(const std::vector<Vec3>& motions);
  std::vector<Vec3> resting_motions(double size) const;
  double moved(int port, int d) const;

  Iteration& iteration_;
  StepData& step_;
  LooseMotions motions_;
  bool is_resting_ = false;  // what iterates now is `rescue`
};

}  // namespace dygita
