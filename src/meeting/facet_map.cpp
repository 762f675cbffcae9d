#include "meeting/facet_map.hpp"

#include <Eigen/LU>
#include <limits>

#include "meeting/facet_functions.hpp"
#include "mesh/shape_functions.hpp"

namespace dygita {

namespace {

constexpr double straight = 1e-12;  // of the size of a facet: mid nodes off the chord, opposite edges unlike
constexpr int most_steps = 20;
constexpr double converged = 1e-14;
constexpr double around = 0.3;  // of the reference facet's size: so far outside a curved facet points are sought

// A linear map gives each node the mean that the corners' linear functions say.
bool goes_linearly(FacetType type, const Eigen::Ref<const Points>& x) {
  const FacetShape& shape = facet_shape(type);
  const auto reference = [&](int a) { return vector_of(shape.shape.nodes[static_cast<size_t>(a)]); };
  // From the first corner along its two neighbours.
  const int second = shape.n_corners - 1;
  Eigen::Matrix2d axes;
  axes.col(0) = (reference(1) - reference(0)).head<2>();
  axes.col(1) = (reference(second) - reference(0)).head<2>();
  const Eigen::Matrix2d back = axes.inverse();
  Eigen::Matrix<double, 3, 2> edges;
  edges.col(0) = x.col(1) - x.col(0);
  edges.col(1) = x.col(second) - x.col(0);
  for (int a = 0; a < x.cols(); ++a) {
    const Vec2 share = back * (reference(a) - reference(0)).head<2>();
    if ((x.col(0) + edges * share - x.col(a)).norm() > straight * edges.norm()) return false;
  }
  return true;
}

}  // namespace

FacetValues facet_values(FacetType type, const Vec2& xi) {
  return with_facet(type, [&](auto shape) -> FacetValues { return shape.values(xi[0], xi[1]); });
}

FacetSlopes facet_slopes(FacetType type, const Vec2& xi) {
  return with_facet(type, [&](auto shape) -> FacetSlopes { return shape.slopes(xi[0], xi[1]); });
}

FacetMap::FacetMap(FacetType type, const Points& x, const Vec3& origin, const Eigen::Matrix<double, 3, 2>& along)
    : type_(type), x_(x), flat_(along.transpose() * (x.colwise() - origin)), is_affine_(goes_linearly(type, x)) {
  const FacetShape& shape = facet_shape(type);
  start_.setZero();
  for (int a = 0; a < shape.n_corners; ++a)
    start_ += vector_of(shape.shape.nodes[static_cast<size_t>(a)]).head<2>() / shape.n_corners;
  low_ = vector_of(shape.shape.nodes[0]).head<2>();
  high_ = low_;
  for (int a = 1; a < shape.n_corners; ++a) {
    const Vec2 corner = vector_of(shape.shape.nodes[static_cast<size_t>(a)]).head<2>();
    low_ = low_.cwiseMin(corner);
    high_ = high_.cwiseMax(corner);
  }
  const Vec2 beyond = around * (high_ - low_);
  low_ -= beyond;
  high_ += beyond;
  if (!is_affine_) return;
  const FacetSlopes slopes = facet_slopes(type, start_);
  back_ = Eigen::Matrix2d(flat_ * slopes).inverse();
  at_start_ = flat_ * facet_values(type, start_);
  const Eigen::Matrix<double, 3, 2> tangents = x_ * slopes;
  normal_ = tangents.col(0).cross(tangents.col(1)).normalized();
}

Vec2 FacetMap::inverse(const Vec2& p) const {
  if (is_affine_) return start_ + back_ * (p - at_start_);
  return with_facet(type_, [&](auto shape) {
    using Values = typename decltype(shape)::Values;
    const auto flat = flat_.leftCols<Values::RowsAtCompileTime>();
    Vec2 xi = start_, nearest = start_;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < most_steps; ++i) {
      const Vec2 off = flat * shape.values(xi[0], xi[1]) - p;
      if (off.squaredNorm() < least) {
        least = off.squaredNorm();
        nearest = xi;
      }
      const Eigen::Matrix2d slopes = flat * shape.slopes(xi[0], xi[1]);
      const Vec2 step = slopes.inverse() * off;
      if (!step.allFinite()) break;
      xi = (xi - step).cwiseMax(low_).cwiseMin(high_);
      if (step.cwiseAbs().maxCoeff() < converged) return xi;
    }
    return nearest;
  });
}

Vec3 FacetMap::normal(const Vec2& xi) const {
  if (is_affine_) return normal_;
  return with_facet(type_, [&](auto shape) -> Vec3 {
    const auto slopes = shape.slopes(xi[0], xi[1]);
    const Eigen::Matrix<double, 3, 2> tangents = x_.leftCols<decltype(slopes)::RowsAtCompileTime>() * slopes;
    return tangents.col(0).cross(tangents.col(1)).normalized();
  });
}

}  // namespace dygita
