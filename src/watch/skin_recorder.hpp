// Watches a run for the picture that turns (skin_motion.hpp). Stress is computed in the cells on the boundary only, at
// no more than twenty instants a run, and what is kept stays below 64 MB.
#pragma once

#include <vector>

#include "result/scenes.hpp"
#include "result/skin_motion.hpp"
#include "watch/part_views.hpp"

namespace dygita {

class SkinRecorder {
 public:
  SkinRecorder(const Problem& problem, PartViews& views) : problem_(problem), views_(views) {}

  // All of these are collective: each rank draws the boundary nodes that its pieces own.
  void accept(const Instant& instant);
  // Fields that others kept of the views (part_views.hpp) join in, each at its instant unless there is a frame already.
  void add(const AssemblyScene& scene, const std::vector<double>& growth);
  // On rank 0 the frames of all parts.
  SkinMotion take();

 private:
  // The boundary nodes of a part that are here, and the cells around them as a mesh of their own.
  struct Layer {
    MeshPtr mesh;
    std::vector<int> in_view;   // node of the view, for each of `mesh`, increasing
    std::vector<int> boundary;  // nodes of `mesh`, increasing
  };
  // Of the boundary nodes that are here.
  struct PartFrame {
    std::vector<float> displacement, von_mises;  // as SkinFrame
  };
  void prepare(const Instant& instant);
  static Layer layer_of(const PartView& view, const std::vector<int>& boundary);
  PartFrame drawn(int part, const Points& displacement, double growth) const;
  void append(int part, const PartFrame& own, SkinFrame& frame) const;

  const Problem& problem_;
  PartViews& views_;
  bool is_ready_ = false;
  SkinMotion motion_;                          // frames without fields, which are in drawn_
  std::vector<std::vector<PartFrame>> drawn_;  // of each frame, of each part
  std::vector<Layer> layers_;                  // without a mesh: nothing of the part is here
  WatchedNodes nodes_;                         // of the layers
  std::vector<int> samples_;                   // frames of each step
  int missed_ = 0;                             // increments so far that have not converged
};

// How many frames each step gets of `n_frames`: static steps their last increment, dynamic ones what remains; where
// there are more steps than frames, steps are passed over evenly, the last never.
std::vector<int> shared_out(const std::vector<bool>& is_static, int n_frames);

}  // namespace dygita
