// Most results are made on rank 0 alone, which asks the other ranks for the fields of their pieces while it watches.
#pragma once

#include "step/observer.hpp"

namespace dygita {

// On rank 0 passes everything on and then lets the others go; on the others answers until then.
class RankObserver : public Observer {
 public:
  explicit RankObserver(Observer& observer) : observer_(observer) {}

  void begin_step(const Instant& start) override;
  void accept(const Instant& instant) override;

 private:
  Observer& observer_;
};

}  // namespace dygita
