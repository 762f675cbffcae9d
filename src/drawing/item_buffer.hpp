// Which of many polygons are seen: each pixel keeps the number of the nearest one.
#pragma once

#include <vector>

namespace dygita {

class ItemBuffer {
 public:
  ItemBuffer(int width, int height);

  // A triangle by the x, y (pixels) and depth (larger is nearer) of its corners.
  void draw(int item, const double (&x)[3], const double (&y)[3], const double (&depth)[3]);

  // For each item whether it has a pixel.
  std::vector<char> seen(int n_items) const;

  // The item seen at a pixel; -1: none.
  int item(int x, int y) const { return item_[static_cast<size_t>(y) * width_ + x]; }

  // Whether what lies at this place and depth is at most `tolerance` behind the nearest.
  bool is_in_front(double x, double y, double depth, double tolerance) const;

 private:
  int width_, height_;
  std::vector<double> depth_;
  std::vector<int> item_;
};

}  // namespace dygita
