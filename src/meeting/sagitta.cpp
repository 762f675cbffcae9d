#include "meeting/sagitta.hpp"

#include <algorithm>

namespace dygita {

double sagitta_of(const FlatFacet& one, const FlatFacet& other, const Vec3& start, const Vec3& end) {
  constexpr double sharp = 0.7, flat = 1e-7;  // cosine, radians
  if (one.normal.dot(other.normal) < sharp) return 0.0;
  const double angle = one.normal.cross(other.normal).norm();
  if (angle <= flat) return 0.0;
  const Vec3 along = (end - start).normalized();
  const auto across = [&](const Vec3& place) { return (place - start).cross(along).norm(); };
  double widest = 0.0;
  for (const FlatFacet* facet : {&one, &other})
    for (int a = 0; a < facet->x.cols(); ++a) widest = std::max(widest, across(facet->x.col(a)));
  return angle / (across(one.centre) + across(other.centre)) * widest * widest / 8.0;
}

}  // namespace dygita
