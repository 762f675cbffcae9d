// Frames are begun where the interfaces are known, on rank 0, and filled in by each rank with the fields of its pieces.
#pragma once

#include "watch/frames.hpp"
#include "watch/part_views.hpp"

namespace dygita {

class PartFrames : public Observer {
 public:
  // Collective. Takes a frame with the fields of what is here of the parts; those of others have none. On other ranks
  // than 0 it has no interfaces.
  using Sink = std::function<void(const Frame&)>;
  PartFrames(const Problem& problem, PartViews& views, Sink sink)
      : problem_(problem), views_(views), sink_(std::move(sink)) {}

  // On rank 0: an instant's frame, before this observer is told of the instant.
  void begin(const Frame& frame) { begun_ = frame; }

  void begin_step(const Instant& start) override { fill(start); }
  void accept(const Instant& instant) override { fill(instant); }

 private:
  void fill(const Instant& instant);
  void share();  // what rank 0 has begun
  void find_free_cells(const Instant& instant);
  void fill_part_here(int part, const NodalMotion& motion);

  const Problem& problem_;
  PartViews& views_;
  Sink sink_;
  std::optional<Frame> begun_;
  std::vector<PartView::Shown> shown_;  // of the parts that several ranks have
  // Cells at whose facets nothing acts in the step at hand, of each part, where the frames show stress errors.
  const Step* step_ = nullptr;
  std::vector<std::vector<FreeCell>> free_;
};

}  // namespace dygita
