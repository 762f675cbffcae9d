// What the increments of a run came to, so that the same run can go over them again and end with the same bits.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "interfaces/interface_fields.hpp"
#include "step/solver_figures.hpp"

namespace dygita {

// One increment (of a window or a time step of several increments each): what its iterations leave behind. All else
// follows from it and from the state before.
struct TrailEntry {
  Vec q;                                           // of the linear stage, as accepted, N
  Vec uncorrected;                                 // before the last coarse correction; empty: there was none
  Vec shortening;                                  // of the preloads, m
  std::vector<std::uint8_t> moved;                 // pieces whose interfaces asked for a solve
  double eta = 0.0, size = 0.0, force_size = 0.0;  // the outcome
  int iterations = 0;
  bool is_solved = true;
  bool is_assembled = false;  // of a static step with all pieces in one system
  std::optional<Missed> missed;
  // Of several ranks each leaves those unknowns of q and of uncorrected that it has, and moves of its own pieces.
  AssembledRuns runs{};
};

// Entries one after the other, of all steps and passes of a run: replayed where an earlier run has left them, appended
// from there on.
class Trail {
 public:
  virtual ~Trail() = default;
  // Do at least n entries follow? If not, those that do are dropped: from here on entries are appended.
  virtual bool leads(long n) = 0;
  virtual long n_left() const = 0;
  // The next one, which there is, whole. Throws InputError where it cannot be read. On other ranks than the first: what
  // is in it the first sends.
  virtual TrailEntry take() = 0;
  virtual void leave(const TrailEntry& entry) = 0;
  // The numbers of an increment gone over differ from those that it had.
  virtual void note_difference() = 0;
};

}  // namespace dygita
