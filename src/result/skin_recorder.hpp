// Watches a run for the picture that turns (skin_motion.hpp). Stress is computed in the cells on the boundary only, at
// no more than twenty instants a run, and what is kept stays below 64 MB.
#pragma once

#include <vector>

#include "result/scenes.hpp"
#include "result/skin_motion.hpp"
#include "result/watched_nodes.hpp"

namespace dygita {

class SkinRecorder {
 public:
  explicit SkinRecorder(const Problem& problem) : problem_(problem) {}

  // All of these are collective: parts are drawn where they are watched (watched_nodes.hpp).
  void accept(const Instant& instant);
  // Whole fields that others kept of the parts watched here join in, each at its instant unless there is a frame
  // already.
  void add(const AssemblyScene& scene);
  // On rank 0 the frames of all parts.
  SkinMotion take();

 private:
  // A part's boundary nodes and the cells around them, as a mesh of its own.
  struct Layer {
    Mesh mesh;
    std::vector<int> node_of;   // of the part, for each node of `mesh`
    std::vector<int> boundary;  // nodes of `mesh`, in the order of SkinMotion::nodes
  };
  // Of the parts that are watched here.
  struct PartFrame {
    std::vector<float> displacement, von_mises;  // as SkinFrame
  };
  void prepare(const Instant& instant);
  static Layer layer_of(const Mesh& mesh, const std::vector<int>& boundary);
  PartFrame drawn(int part, const Points& displacement) const;

  const Problem& problem_;
  CutPtr cut_;
  SkinMotion motion_;                          // frames without fields, which are in drawn_
  std::vector<std::vector<PartFrame>> drawn_;  // of each frame, of each part
  std::vector<Layer> layers_;                  // of parts that are watched here or are on several ranks
  WatchedNodes nodes_;                         // of the layers
  std::vector<int> samples_;                   // frames of each step
  int missed_ = 0;                             // increments so far that have not converged
};

// How many frames each step gets of `n_frames`: static steps their last increment, dynamic ones what remains; where
// there are more steps than frames, steps are passed over evenly, the last never.
std::vector<int> shared_out(const std::vector<bool>& is_static, int n_frames);

}  // namespace dygita
