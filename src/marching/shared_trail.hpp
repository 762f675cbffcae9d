// The trail of several ranks: each keeps its part, rank 0 reads all of them, and all go over it.
#pragma once

#include "step/trail.hpp"

namespace dygita {

// Collective, but for `leave` and `note_difference`.
class SharedTrail final : public Trail {
 public:
  // kept: rank 0's, or the part of another; null: it keeps none.
  explicit SharedTrail(Trail* kept) : kept_(kept) {}
  bool leads(long n) override;
  long n_left() const override;
  TrailEntry take() override;
  void leave(const TrailEntry& entry) override;
  void note_difference() override;

 private:
  Trail* kept_;
};

}  // namespace dygita
