// Watches the von Mises stress of the substructures whose material has a yield and the failure index of those whose
// material has strengths along its axes; of others nothing is computed.
//
// Every node at the end of each static increment and at two hundred instants of a dynamic step; in between, at every
// increment, the nodes that had been the most stressed until then: a peak between two instants is met where stress is
// high again and again, and missed where it was never high before.
#pragma once

#include <vector>

#include "fem/own_stress.hpp"
#include "result/result.hpp"
#include "watch/part_views.hpp"

namespace dygita {

inline constexpr int stress_instants = 200;  // of a dynamic step, at which all nodes are looked at
inline constexpr int most_hot_nodes = 64;    // of a substructure, followed in between

class StressRecorder {
 public:
  StressRecorder(const Problem& problem, PartViews& views);
  // These are collective: each rank looks at the nodes that its pieces own.
  void accept(const Instant& instant);
  void settle();
  // Has this instant's look at all nodes met a smaller margin than every one before? The same on all ranks.
  bool is_nearest_to_limit() const { return is_nearest_; }
  // The substructure with the smallest margin, once it has settled; -1: none has been looked at.
  int nearest_to_limit() const;
  // In the order of the substructures; of all once it has settled.
  std::vector<PartStress> take();

 private:
  // When and where the largest stress was met, for ranks to agree on the first.
  struct Met {
    long look = -1;  // number of the instant; -1: none
    int node = -1;   // of the part
  };
  // A substructure, and the cells around its most stressed nodes as a mesh of their own. Nodes are of the view.
  struct Watched {
    PartStress peak;  // of the nodes that are here, and once it has settled of all
    Met met;
    FailureMode mode = FailureMode::any;
    Vec volumes;                             // m^3, of nodes
    Vec largest;                             // Pa or 1, of each node so far
    std::vector<std::vector<double>> above;  // m^3, beyond yield in each piece here, at each look at all
    Mesh around;
    std::vector<int> node;  // for each of `around`, increasing
    std::vector<int> hot;   // nodes of `around`
  };

  void prepare(const Instant& instant);
  // Returns the largest stress over yield, or index.
  double look_at_all(const Instant& instant, Watched& watched);
  void look_at_hot(const Instant& instant, Watched& watched);
  void follow();
  std::vector<int> hottest_of_all(const Watched& watched) const;
  std::vector<int> most_stressed(const Watched& watched) const;
  static void surround(const Mesh& mesh, const std::vector<int>& hot, Watched& watched);
  // Of each node of a mesh of the view.
  NodalFailure measure(const Watched& watched, const Mesh& mesh, const Points& strained) const;
  void meet(const Instant& instant, const NodalFailure& found, int at, int node, Watched& watched) const;
  void settle_peak(Watched& watched) const;
  void settle_above(Watched& watched) const;
  const PartView& view_of(const Watched& watched) const { return views_.of(watched.peak.part); }

  const Problem& problem_;
  PartViews& views_;
  std::vector<Watched> watched_;
  WatchedNodes hot_;
  long n_looks_ = 0;
  int n_at_all_ = 0;
  bool is_ready_ = false, has_hot_ = false, is_nearest_ = false;
  double used_ = 0.0;  // of yield, the largest share at looks at all nodes
};

}  // namespace dygita
