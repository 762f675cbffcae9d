// Multipliers of a part of a facet that meets another mesh, before they are made dual (manual, eq. J2).
#pragma once

#include <algorithm>

#include "meeting/facet_map.hpp"
#include "meeting/facet_parts.hpp"

namespace dygita {

// Linear functions of a part, a triangle or a parallelogram of its facet's reference coordinates; of a window of it
// that what is covered fits in, if there is one. All are positive there, and linear fields are among their sums.
class PartFunctions {
 public:
  PartFunctions(FacetType type, const FacetPart& part) : n_(part.n) {
    const auto corner = [&](int a) {
      const Place& at = facet_shape(type).shape.nodes[part.nodes[a]];
      return Vec2(at[0], at[1]);
    };
    origin_ = corner(0);
    Eigen::Matrix2d edges;
    edges.col(0) = corner(1) - corner(0);
    edges.col(1) = corner(part.n - 1) - corner(0);
    back_ = edges.inverse();
  }
  FacetValues values(const Vec2& xi) const {
    const Vec2 at = back_ * (xi - origin_);
    return n_ == 3 ? facet_values(FacetType::tri3, at) : facet_values(FacetType::quad4, 2.0 * at - Vec2(1, 1));
  }
  // Those of the smallest window of the same form around these places, in reference coordinates of the facet.
  PartFunctions within(const std::vector<Vec2>& places) const {
    Vec2 low = Vec2::Ones(), high = Vec2::Zero();
    double largest_sum = 0.0;
    for (const Vec2& xi : places) {
      const Vec2 at = back_ * (xi - origin_);
      low = low.cwiseMin(at);
      high = high.cwiseMax(at);
      largest_sum = std::max(largest_sum, at.sum());
    }
    for (int d = 0; d < 2; ++d) {
      if (low[d] < at_rim) low[d] = 0.0;
      if (high[d] > 1.0 - at_rim) high[d] = 1.0;
    }
    if (largest_sum > 1.0 - at_rim) largest_sum = 1.0;
    const Vec2 size = (n_ == 3 ? Vec2::Constant(largest_sum - low.sum()) : Vec2(high - low)).cwiseMax(narrowest);
    PartFunctions window = *this;
    window.origin_ += back_.inverse() * low;
    window.back_ = size.cwiseInverse().asDiagonal() * back_;
    return window;
  }
  // Reference coordinates of the facet.
  std::vector<Vec2> corners() const {
    std::vector<Vec2> places{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    if (n_ == 3) places.erase(places.begin() + 2);
    for (Vec2& at : places) at = (origin_ + back_.inverse() * at).eval();
    return places;
  }

 private:
  // Of a part: what is covered ends at its rim; a window is not narrower.
  static constexpr double at_rim = 1e-6, narrowest = 1e-4;
  int n_;
  Vec2 origin_;
  Eigen::Matrix2d back_;
};

}  // namespace dygita
