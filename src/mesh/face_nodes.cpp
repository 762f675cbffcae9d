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

// The same with values of the functions that are linear on each sub-facet.
std::vector<FacetPoint> sampled_by_sub_facets(const FacetShape& facet) {
  std::vector<FacetPoint> points;
  for (const SubFacet& sub : facet.sub_facets) {
    const FacetShape& linear = facet_shape(sub.n == 3 ? FacetType::tri3 : FacetType::quad4);
    const ShapeFunctions& hats = shape_functions(linear.type);
    Points corners(3, sub.n);
    for (int a = 0; a < sub.n; ++a) corners.col(a) = vector_of(facet.shape.nodes[sub.nodes[a]]);
    for (const QuadraturePoint& point : (sub.n == 3 ? reference::triangle_6 : reference::square_9).points) {
      const Vec values = hats.values(vector_of(point.at));
      const Eigen::Matrix<double, 3, 2> map = corners * hats.slopes(vector_of(point.at)).leftCols<2>();
      NodeValues at_nodes = NodeValues::Zero(nodes_per_facet(facet.type));
      for (int a = 0; a < sub.n; ++a) at_nodes[sub.nodes[a]] = values[a];
      points.push_back({point.weight * map.topRows<2>().determinant(), at_nodes,
                        shape_functions(facet.type).slopes(corners * values).leftCols<2>()});
    }
  }
  return points;
}

struct FacetPoints {
  std::vector<FacetPoint> own, by_sub_facets;  // the latter where areas go by them
};

const FacetPoints& points_of(FacetType type) {
  static const auto all = [] {
    std::vector<FacetPoints> of_types;
    for (const FacetShape& facet : facet_shapes)
      of_types.push_back(
          {sampled(facet), facet.is_shared_by_sub_facets ? sampled_by_sub_facets(facet) : std::vector<FacetPoint>()});
    return of_types;
  }();
  return all[static_cast<size_t>(type)];
}

// Integrals over a facet of N_a (m^2), N_a n (m^2) and N_a x (m^3).
struct FacetIntegrals {
  NodeValues areas;
  NodeVectors normals, moments;
};

FacetIntegrals facet_integrals(const Points& x, const Facet& facet, const std::vector<FacetPoint>& points) {
  const std::span<const int> nodes = facet.nodes();
  const auto n = static_cast<Eigen::Index>(nodes.size());
  NodeVectors places(3, n);
  for (size_t a = 0; a < nodes.size(); ++a) places.col(static_cast<Eigen::Index>(a)) = x.col(nodes[a]);

  FacetIntegrals integrals{NodeValues::Zero(n), NodeVectors::Zero(3, n), NodeVectors::Zero(3, n)};
  for (const FacetPoint& point : points) {
    const Eigen::Matrix<double, 3, 2> tangents = places.lazyProduct(point.slopes);
    const Vec3 normal = point.weight * tangents.col(0).cross(tangents.col(1));
    if (points.size() == 1) {  // every node has the same share, without rounding
      const Vec3 share = normal / static_cast<double>(n);
      integrals.areas.setConstant(share.norm());
      integrals.normals.colwise() = share;
      // Of a triangle of three nodes, exact: A/12 (x_a + x_1 + x_2 + x_3).
      integrals.moments = share.norm() / 4.0 * (places.colwise() + Vec3(places.rowwise().sum()));
    } else {
      integrals.areas += point.values * normal.norm();
      integrals.moments += places.lazyProduct(point.values) * normal.norm() * point.values.transpose();
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
  result.areas = result.weights = Vec::Zero(n);
  result.normals = result.vectors = result.moments = Points::Zero(3, n);
  for (const Facet& facet : facets) {
    const FacetPoints& points = points_of(facet.type());
    const FacetIntegrals own = facet_integrals(mesh.nodes, facet, points.own);
    const FacetIntegrals shared =
        points.by_sub_facets.empty() ? own : facet_integrals(mesh.nodes, facet, points.by_sub_facets);
    for (Eigen::Index a = 0; a < own.areas.size(); ++a) {
      const int node = facet.nodes()[static_cast<size_t>(a)];
      const long i = std::lower_bound(result.nodes.begin(), result.nodes.end(), node) - result.nodes.begin();
      result.areas[i] += shared.areas[a];
      result.normals.col(i) += shared.normals.col(a);
      result.weights[i] += own.areas[a];
      result.vectors.col(i) += own.normals.col(a);
      result.moments.col(i) += own.moments.col(a);
    }
  }
  result.normals.colwise().normalize();
  return result;
}

std::vector<FacetSample> facet_samples(const Points& x, const Facet& facet) {
  std::vector<FacetSample> samples;
  const Points places = x(Eigen::all, std::vector<int>(facet.nodes().begin(), facet.nodes().end()));
  for (const FacetPoint& point : points_of(facet.type()).own) {
    const Eigen::Matrix<double, 3, 2> tangents = places * point.slopes;
    samples.push_back({point.values, point.weight * tangents.col(0).cross(tangents.col(1))});
  }
  return samples;
}

Vec3 facet_area_vector(const Points& x, const Facet& facet) {
  return facet_integrals(x, facet, points_of(facet.type()).own).normals.rowwise().sum();
}

}  // namespace dygita
