// Watches a run for parts that pass into each other where no interface keeps them apart. Pairs are found once, where
// bounding boxes are near; without such pairs the watch costs nothing.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "interfaces/unjoined.hpp"
#include "step/observer.hpp"

namespace dygita {

class PenetrationWatch : public Observer {
 public:
  explicit PenetrationWatch(const Problem& problem) : problem_(problem) {}

  // Finds the pairs in the first step, and says which touch or overlap from the start.
  void begin_step(const Instant& start) override;
  void accept(const Instant& instant) override;
  // Says how deep, where and when; of more than three pairs the deepest, and the others in one warning.
  void finish() const;

 private:
  struct Deepest {
    double depth = 0.0;            // m
    const NearNode* at = nullptr;  // in pairs_
    int part = -1, other = -1;     // of the node, of its facet
    const Step* step = nullptr;
    double time = 0.0;  // s
  };
  void need(const std::vector<NearNode>& nodes, int part, int other);
  void look(const Instant& instant, size_t pair);
  const std::string& name_of(int part) const;
  std::string text_of(size_t pair) const;

  const Problem& problem_;
  bool has_begun_ = false;
  std::vector<Unjoined> pairs_;
  std::vector<Deepest> deepest_;            // of each pair
  std::map<int, std::vector<int>> needed_;  // nodes of a part
  std::vector<Points> displacement_;        // of each part, filled at those nodes alone
};

}  // namespace dygita
