// Watches the von Mises stress of the substructures whose material has a yield; of others nothing is computed.
//
// Every node at the end of each static increment and at two hundred instants of a dynamic step; in between, at every
// increment, the nodes that had been the most stressed until then: a peak between two instants is met where stress is
// high again and again, and missed where it was never high before.
#pragma once

#include <vector>

#include "result/result.hpp"
#include "result/watched_nodes.hpp"

namespace dygita {

inline constexpr int stress_instants = 200;  // of a dynamic step, at which all nodes are looked at
inline constexpr int most_hot_nodes = 64;    // of a substructure, followed in between

class StressRecorder {
 public:
  explicit StressRecorder(const Problem& problem);
  // These are collective: each part is watched by one rank (watched_nodes.hpp).
  void accept(const Instant& instant);
  void settle();
  // In the order of the substructures; of all once it has settled.
  std::vector<PartStress> take();

 private:
  // A substructure, and the cells around its most stressed nodes as a mesh of their own.
  struct Watched {
    PartStress peak;
    Vec volumes;  // m^3, of nodes
    Vec largest;  // Pa, of each node so far; these are here where the part is watched here
    Mesh around;
    std::vector<int> node;  // of the body, for each of `around`, increasing
    std::vector<int> hot;   // nodes of `around`
  };

  void prepare(const Instant& instant);
  void look_at_all(const Instant& instant, Watched& watched);
  void look_at_hot(const Instant& instant, Watched& watched);
  void follow();
  static std::vector<int> most_stressed(const Watched& watched);
  static void surround(const Mesh& mesh, const std::vector<int>& hot, Watched& watched);
  void meet(const Instant& instant, double stress, int node, Watched& watched) const;
  const Mesh& mesh_of(const Watched& watched) const { return *problem_.substructures[watched.peak.part]->mesh; }

  const Problem& problem_;
  std::vector<Watched> watched_;
  CutPtr cut_;
  WatchedNodes all_, hot_;
  bool has_hot_ = false;
};

}  // namespace dygita
