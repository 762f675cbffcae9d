// Boxes in space, and which of many are near a place: a regular grid of cells.
#pragma once

#include <cmath>
#include <unordered_map>
#include <vector>

#include "numerics/types.hpp"

namespace dygita {

struct Box {
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);

  void add(const Vec3& x) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  bool is_empty() const { return low[0] > high[0] || low[1] > high[1] || low[2] > high[2]; }
  Vec3 size() const { return high - low; }
  Box grown(double by) const { return {low - Vec3::Constant(by), high + Vec3::Constant(by)}; }
  Box common(const Box& other) const { return {low.cwiseMax(other.low), high.cwiseMin(other.high)}; }
  bool meets(const Box& other) const { return !common(other).is_empty(); }
};

// Numbers of things by the cells of a regular grid that their boxes touch.
class CellGrid {
 public:
  // cell: the edge of a cell, m.
  explicit CellGrid(double cell) : cell_(cell) {}

  void add(const Box& box, int i) {
    for_each_cell(box, [&](size_t key) { in_cell_[key].push_back(i); });
  }
  // Calls back with those that share a cell with the box; with one that shares several, several times.
  template <typename Visit>
  void for_each_near(const Box& box, Visit visit) const {
    for_each_cell(box, [&](size_t key) {
      if (const auto found = in_cell_.find(key); found != in_cell_.end())
        for (const int i : found->second) visit(i);
    });
  }

 private:
  template <typename Visit>
  void for_each_cell(const Box& box, Visit visit) const {
    long first[3], last[3];
    for (int d = 0; d < 3; ++d) {
      first[d] = static_cast<long>(std::floor(box.low[d] / cell_));
      last[d] = static_cast<long>(std::floor(box.high[d] / cell_));
    }
    for (long k = first[2]; k <= last[2]; ++k)
      for (long j = first[1]; j <= last[1]; ++j)
        for (long i = first[0]; i <= last[0]; ++i)
          visit(static_cast<size_t>(i) * 73856093u ^ static_cast<size_t>(j) * 19349663u ^
                static_cast<size_t>(k) * 83492791u);
  }

  double cell_;
  std::unordered_map<size_t, std::vector<int>> in_cell_;
};

class BoxGrid {
 public:
  // cell: the edge of a cell (m), about as large as the boxes.
  BoxGrid(const std::vector<Box>& boxes, double cell) : boxes_(boxes), grid_(cell), last_asked_(boxes.size(), -1) {
    for (size_t i = 0; i < boxes.size(); ++i) grid_.add(boxes[i], static_cast<int>(i));
  }

  // Calls visit(i) once for each box that meets `box`.
  template <typename Visit>
  void for_each_meeting(const Box& box, Visit visit) {
    ++n_asked_;
    grid_.for_each_near(box, [&](int i) {
      long& last = last_asked_[static_cast<size_t>(i)];
      if (last == n_asked_ || !boxes_[static_cast<size_t>(i)].meets(box)) return;
      last = n_asked_;
      visit(i);
    });
  }

 private:
  const std::vector<Box>& boxes_;
  CellGrid grid_;
  std::vector<long> last_asked_;
  long n_asked_ = 0;
};

}  // namespace dygita
