// Frames are begun where the interfaces are known, on rank 0, and filled in with each substructure's fields where that
// is watched.
#pragma once

#include "result/frame.hpp"
#include "result/watched_nodes.hpp"

namespace dygita {

class PartFrames : public Observer {
 public:
  // Collective. Takes a frame with the fields of the parts that are watched here; those of others have none. On other
  // ranks than 0 it has no interfaces.
  using Sink = std::function<void(const Frame&)>;
  PartFrames(const Problem& problem, Sink sink) : problem_(problem), sink_(std::move(sink)) {}

  // On rank 0: an instant's frame, before this observer is told of the instant.
  void begin(const Frame& frame) { begun_ = frame; }

  void begin_step(const Instant& start) override { fill(start); }
  void accept(const Instant& instant) override { fill(instant); }

 private:
  void fill(const Instant& instant);
  void share();  // what rank 0 has begun

  const Problem& problem_;
  Sink sink_;
  std::optional<Frame> begun_;
  CutPtr cut_;
  WatchedNodes nodes_;  // all
};

}  // namespace dygita
