#include "report/item_buffer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dygita {

ItemBuffer::ItemBuffer(int width, int height)
    : width_(width),
      height_(height),
      depth_(static_cast<size_t>(width) * height, -std::numeric_limits<double>::infinity()),
      item_(depth_.size(), -1) {}

void ItemBuffer::draw(int item, const double (&x)[3], const double (&y)[3], const double (&depth)[3]) {
  const double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
  if (!(std::abs(area) > 1e-12)) return;
  const auto first = [](const double(&v)[3]) {
    return static_cast<int>(std::max(0.0, std::floor(std::min({v[0], v[1], v[2]}))));
  };
  const auto last = [](const double(&v)[3], int n) {
    return static_cast<int>(std::min(n - 1.0, std::ceil(std::max({v[0], v[1], v[2]}))));
  };
  for (int j = first(y); j <= last(y, height_); ++j)
    for (int i = first(x); i <= last(x, width_); ++i) {
      const double px = i + 0.5, py = j + 0.5;
      const double a = ((x[1] - px) * (y[2] - py) - (x[2] - px) * (y[1] - py)) / area;
      const double b = ((x[2] - px) * (y[0] - py) - (x[0] - px) * (y[2] - py)) / area;
      const double c = 1.0 - a - b;
      if (a < 0.0 || b < 0.0 || c < 0.0) continue;
      const double z = a * depth[0] + b * depth[1] + c * depth[2];
      const size_t pixel = static_cast<size_t>(j) * width_ + i;
      if (z <= depth_[pixel]) continue;
      depth_[pixel] = z;
      item_[pixel] = item;
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
