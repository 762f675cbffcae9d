// What a rank has to know of the points of a step: those on nodes of its pieces, those that all ranks solve, and
// whatever depends on the nodes of both.
#pragma once

#include <cstdint>
#include <unordered_set>

#include "interfaces/node_groups.hpp"
#include "interfaces/surfaces.hpp"
#include "partition/cut.hpp"

namespace dygita {

class Reach {
 public:
  // Everything, of one process.
  Reach() = default;
  // Of this rank. explicit_pieces: as of make_exchange. everywhere: of each surface, do all ranks solve its points?
  // Finding it takes one byte a point of a surface, and time that grows with all points of all ranks.
  Reach(const Problem& problem, const Step& step, const Cut& cut, const std::vector<Surface>& surfaces,
        const std::vector<char>& explicit_pieces, std::vector<char> everywhere);

  bool is_all() const { return cut_ == nullptr; }
  // Is a point of a surface within it? A node, of which each piece that has it has a copy?
  bool has(int surface, int point) const {
    return is_all() || points_[static_cast<size_t>(surface)][static_cast<size_t>(point)] != 0;
  }
  bool has(const NodeKey& key) const { return is_all() || cut_->is_here(key.first) || distant_.contains(word_of(key)); }
  bool is_everywhere(int surface) const { return !is_all() && everywhere_[static_cast<size_t>(surface)] != 0; }

 private:
  static std::uint64_t word_of(const NodeKey& key) {
    return static_cast<std::uint64_t>(key.first) << 32U | static_cast<std::uint32_t>(key.second);
  }
  template <class Visit>
  void for_each_copy(int part, int node, Visit&& visit) const;
  template <class Visit>
  void for_each_key(const Surface& surface, int point, const std::vector<char>& explicit_pieces, Visit&& visit) const;
  bool take(const NodeKey& key);
  bool grow(const Surface& surface, int s, const std::vector<char>& explicit_pieces);
  bool grow_over_cuts(int part);

  const Cut* cut_ = nullptr;  // null: all
  std::vector<char> everywhere_;
  std::vector<std::vector<char>> points_;      // of each surface
  std::unordered_set<std::uint64_t> distant_;  // nodes of pieces elsewhere
};

}  // namespace dygita
