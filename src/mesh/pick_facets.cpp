#include "mesh/pick_facets.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/face_nodes.hpp"
#include "mesh/smooth_patches.hpp"
#include "numerics/dense.hpp"

namespace dygita {

namespace {

const double alike = std::cos(2.0 * M_PI / 180.0);
constexpr double relative_tolerance = 1e-6, near_radius = 0.02;

struct PlacedFacets {
  Points x;  // m, of all nodes at their place
  std::vector<Facet> facets;
  std::vector<Vec3> normals;  // unit
  double tolerance;           // m
};

PlacedFacets placed_facets(const Mesh& mesh, const Vec3& place) {
  PlacedFacets b{mesh.nodes.colwise() + place, boundary_facets(mesh), {}, 0.0};
  for (const Facet& facet : b.facets) b.normals.push_back(facet_area_vector(b.x, facet).normalized());
  b.tolerance = relative_tolerance * (b.x.rowwise().maxCoeff() - b.x.rowwise().minCoeff()).norm();
  return b;
}

struct Cylinder {
  Vec3 axis;
  double radius = 0.0;
  bool is_one = false;
};

// The cylinder through the nodes of a patch: its axis is what the normals have in common least, its circle the one of
// least squares.
Cylinder cylinder_through(const PlacedFacets& b, const std::vector<int>& facets) {
  Mat3 normals = Mat3::Zero();
  std::vector<Facet> patch;
  for (const int f : facets) {
    normals += b.normals[f] * b.normals[f].transpose() / static_cast<double>(facets.size());
    patch.push_back(b.facets[f]);
  }
  const PrincipalAxes axes = principal_axes(normals);
  Cylinder cylinder{axes.vectors.col(0)};
  if (axes.values[0] > 1e-3 || axes.values[1] < 1e-3) return cylinder;  // bent twice, or flat
  const Vec3 u = axes.vectors.col(1), v = axes.vectors.col(2);
  const std::vector<int> nodes = nodes_of(patch);
  Mat system(nodes.size(), 3);
  Vec squares(nodes.size());
  for (size_t i = 0; i < nodes.size(); ++i) {
    const Vec3 x = b.x.col(nodes[i]);
    const auto row = static_cast<Eigen::Index>(i);
    system.row(row) << u.dot(x), v.dot(x), 1.0;
    squares[row] = std::pow(u.dot(x), 2) + std::pow(v.dot(x), 2);
  }
  const Vec3 circle = solve_least_norm(system, squares, 1e-15).x;
  const double p = 0.5 * circle[0], q = 0.5 * circle[1];
  cylinder.radius = std::sqrt(std::max(0.0, circle[2] + p * p + q * q));
  double off = 0.0;
  for (Eigen::Index i = 0; i < system.rows(); ++i)
    off = std::max(off, std::abs(std::hypot(system(i, 0) - p, system(i, 1) - q) - cylinder.radius));
  cylinder.is_one = off < near_radius * cylinder.radius;
  return cylinder;
}

std::vector<char> on_cylinders(const PlacedFacets& b, const FacetPick& pick) {
  const std::vector<int> patch = smooth_patches(b.facets, b.normals);
  std::map<int, std::vector<int>> members;
  for (size_t f = 0; f < patch.size(); ++f) members[patch[f]].push_back(static_cast<int>(f));
  std::vector<char> fits(patch.size(), 0);
  for (const auto& [number, facets] : members) {
    const Cylinder cylinder = cylinder_through(b, facets);
    const bool is_meant = cylinder.is_one &&
                          (!pick.radius || std::abs(cylinder.radius - *pick.radius) < near_radius * *pick.radius) &&
                          (!pick.axis || std::abs(cylinder.axis.dot(*pick.axis)) > alike);
    for (const int f : facets) fits[f] = is_meant;
  }
  return fits;
}

bool fits_place(const PlacedFacets& b, size_t f, const FacetPick& pick) {
  if (pick.normal && b.normals[f].dot(*pick.normal) < alike) return false;
  for (const int node : b.facets[f].nodes()) {
    const Vec3 x = b.x.col(node);
    if (pick.at && std::abs(pick.normal->dot(x) - *pick.at) > b.tolerance) return false;
    if (pick.box &&
        ((x - pick.box->first).minCoeff() < -b.tolerance || (pick.box->second - x).minCoeff() < -b.tolerance))
      return false;
    if (pick.where && !pick.where(x)) return false;
  }
  return true;
}

}  // namespace

std::vector<Facet> pick_facets(const Mesh& mesh, const Vec3& place, const FacetPick& pick) {
  const PlacedFacets b = placed_facets(mesh, place);
  const std::vector<char> round = pick.is_cylinder ? on_cylinders(b, pick) : std::vector<char>(b.facets.size(), 1);
  std::vector<Facet> facets;
  for (size_t f = 0; f < b.facets.size(); ++f)
    if (round[f] && fits_place(b, f, pick)) facets.push_back(b.facets[f]);
  return facets;
}

}  // namespace dygita
