#include "drawing/item_buffer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dygita {

ItemBuffer::ItemBuffer(int width, int height)
    : width_(width),
      height_(height),
      depth_(static_cast<size_t>(width) * height, -std::numeric_limits<double>::infinity()),
      item_(depth_.size(), -1) {}

// Shares of the corners are linear along a row of pixels: of each row the stretch where none is negative.
void ItemBuffer::draw(int item, const double (&x)[3], const double (&y)[3], const double (&depth)[3]) {
  const double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
  if (!(std::abs(area) > 1e-12)) return;
  constexpr double rounding = 1e-9;  // px: what two triangles share is not left to neither of them
  const auto [low, high] = std::minmax({y[0], y[1], y[2]});
  const int first_row = static_cast<int>(std::max(0.0, std::ceil(low - 0.5 - rounding)));
  const int last_row = static_cast<int>(std::min(height_ - 1.0, std::floor(high - 0.5 + rounding)));
  const auto [left, right] = std::minmax({x[0], x[1], x[2]});
  const double slope[3] = {(y[1] - y[2]) / area, (y[2] - y[0]) / area, (y[0] - y[1]) / area};  // of the shares, per px
  const double depth_slope = slope[0] * depth[0] + slope[1] * depth[1] + slope[2] * depth[2];
  for (int j = first_row; j <= last_row; ++j) {
    const double py = j + 0.5;
    double share[3];  // at x = 0.5
    double from = left - 0.5, to = right - 0.5, z = 0.0;
    for (int k = 0; k < 3; ++k) {
      const int a = (k + 1) % 3, b = (k + 2) % 3;
      share[k] = ((x[a] - 0.5) * (y[b] - py) - (x[b] - 0.5) * (y[a] - py)) / area;
      z += share[k] * depth[k];
      if (slope[k] > 0.0)
        from = std::max(from, -share[k] / slope[k]);
      else if (slope[k] < 0.0)
        to = std::min(to, -share[k] / slope[k]);
      else if (share[k] < 0.0)
        to = from - 1.0;
    }
    const int first = static_cast<int>(std::clamp(std::ceil(from - rounding), 0.0, 1.0 * width_));
    const int last = static_cast<int>(std::clamp(std::floor(to + rounding), -1.0, width_ - 1.0));
    double* const nearest = depth_.data() + static_cast<size_t>(j) * width_;
    int* const items = item_.data() + static_cast<size_t>(j) * width_;
    for (int i = first; i <= last; ++i) {
      const double at = z + i * depth_slope;
      if (at <= nearest[i]) continue;
      nearest[i] = at;
      items[i] = item;
    }
  }
}

std::vector<char> ItemBuffer::seen(int n_items) const {
  std::vector<char> seen(static_cast<size_t>(n_items), 0);
  for (const int item : item_)
    if (item >= 0 && item < n_items) seen[item] = 1;
  return seen;
}

bool ItemBuffer::is_in_front(double x, double y, double depth, double tolerance) const {
  // An edge lies between pixels: it is seen if it is from one of the four around it.
  for (const double dx : {-1.0, 1.0})
    for (const double dy : {-1.0, 1.0}) {
      const int i = static_cast<int>(std::floor(x + dx)), j = static_cast<int>(std::floor(y + dy));
      if (i < 0 || j < 0 || i >= width_ || j >= height_) return true;
      if (depth >= depth_[static_cast<size_t>(j) * width_ + i] - tolerance) return true;
    }
  return false;
}

}  // namespace dygita
