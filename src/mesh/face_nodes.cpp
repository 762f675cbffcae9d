#include "mesh/face_nodes.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "mesh/shape_functions.hpp"

namespace dygita {

namespace {

using NodeValues = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_facet_nodes, 1>;
using NodeVectors = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, most_facet_nodes>;
using NodeSlopes = Eigen::Matrix<double, Eigen::Dynamic, 2, 0, most_facet_nodes, 2>;

// A quadrature point of a type of facets.
struct FacetPoint {
  double weight;
  NodeValues values;  // N_a
  NodeSlopes slopes;  // d N_a / d xi
};

std::vector<FacetPoint> sampled(const FacetShape& facet) {
  const ShapeFunctions& functions = shape_functions(facet.type);
  std::vector<FacetPoint> points;
  for (const QuadraturePoint& point : facet.rule.points) {
    const Vec3 xi = vector_of(point.at);
    points.push_back({point.weight, functions.values(xi), functions.slopes(xi).leftCols<2>()});
  }
  return points;
}

const std::vector<FacetPoint>& points_of(FacetType type) {
  static const auto all = [] {
    std::vector<std::vector<FacetPoint>> of_types;
    for (const FacetShape& facet : facet_shapes) of_types.push_back(sampled(facet));
    return of_types;
  }();
  return all[static_cast<size_t>(type)];
}

// Integrals over a facet of N_a (m^2) and N_a n (m^2).
struct FacetIntegrals {
  NodeValues areas;
  NodeVectors normals;
};

FacetIntegrals facet_integrals(const Points& x, const Facet& facet) {
  const std::span<const int> nodes = facet.nodes();
  const auto n = static_cast<Eigen::Index>(nodes.size());
  NodeVectors places(3, n);
  for (size_t a = 0; a < nodes.size(); ++a) places.col(static_cast<Eigen::Index>(a)) = x.col(nodes[a]);

  FacetIntegrals integrals{NodeValues::Zero(n), NodeVectors::Zero(3, n)};
  const std::vector<FacetPoint>& points = points_of(facet.type());
  for (const FacetPoint& point : points) {
    const Eigen::Matrix<double, 3, 2> tangents = places.lazyProduct(point.slopes);
    const Vec3 normal = point.weight * tangents.col(0).cross(tangents.col(1));
    if (points.size() == 1) {  // every node has the same share, without rounding
      const Vec3 share = normal / static_cast<double>(n);
      integrals.areas.setConstant(share.norm());
      integrals.normals.colwise() = share;
    } else {
      integrals.areas += point.values * normal.norm();
      integrals.normals += normal * point.values.transpose();
    }
  }
  return integrals;
}

}  // namespace

FaceNodes face_nodes(const Mesh& mesh, const std::vector<Facet>& facets) {
  FaceNodes result;
  result.nodes = nodes_of(facets);
  const auto n = static_cast<long>(result.nodes.size());
  result.areas = Vec::Zero(n);
  result.normals = Points::Zero(3, n);
  for (const Facet& facet : facets) {
    const auto [areas, normals] = facet_integrals(mesh.nodes, facet);
    for (Eigen::Index a = 0; a < areas.size(); ++a) {
      const int node = facet.nodes()[static_cast<size_t>(a)];
      const long i = std::lower_bound(result.nodes.begin(), result.nodes.end(), node) - result.nodes.begin();
      result.areas[i] += areas[a];
      result.normals.col(i) += normals.col(a);
    }
  }
  result.normals.colwise().normalize();
  return result;
}

Vec3 facet_area_vector(const Points& x, const Facet& facet) {
  return facet_integrals(x, facet).normals.rowwise().sum();
}

}  // namespace dygita
