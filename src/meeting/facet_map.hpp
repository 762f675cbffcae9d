// Shape functions of a facet at the points of a plane that it is projected on.
#pragma once

#include "mesh/polygons.hpp"

namespace dygita {

using FacetValues = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_facet_nodes, 1>;
using FacetSlopes = Eigen::Matrix<double, Eigen::Dynamic, 2, 0, most_facet_nodes, 2>;

FacetValues facet_values(FacetType type, const Vec2& xi);
FacetSlopes facet_slopes(FacetType type, const Vec2& xi);

class FacetMap {
 public:
  // x: 3 x n, m, of the facet's nodes; the plane's coordinates are along the columns of `along`, from `origin`.
  FacetMap(FacetType type, const Points& x, const Vec3& origin, const Eigen::Matrix<double, 3, 2>& along);

  FacetType type() const { return type_; }
  // Do its coordinates go linearly with those of the reference facet?
  bool is_affine() const { return is_affine_; }
  // Reference coordinates of the point that is projected on p, by Newton's iteration; of a curved facet that is seen
  // edge on, and has no such point, of the one nearest to it that was met, which is in or beside the facet.
  Vec2 inverse(const Vec2& p) const;
  FacetValues values(const Vec2& xi) const { return facet_values(type_, xi); }
  Vec3 normal(const Vec2& xi) const;  // unit, outward

 private:
  FacetType type_;
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, most_facet_nodes> x_;
  Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, most_facet_nodes> flat_;
  bool is_affine_;
  Vec2 start_, low_, high_;
  // Where affine: xi = start + back (p - at_start), and the normal.
  Eigen::Matrix2d back_;
  Vec2 at_start_;
  Vec3 normal_;
};

}  // namespace dygita
