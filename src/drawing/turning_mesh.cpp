#include "drawing/turning_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "drawing/picture_mesh.hpp"

namespace dygita {

namespace {

// A part's boundary in numbers of its own.
struct Boundary {
  std::vector<int> nodes;  // of the mesh, increasing
  Points x;                // m
  std::vector<std::vector<int>> facets;
  std::vector<int> label;
  std::vector<std::array<int, 2>> edges;
  std::vector<int> rank;  // of each node: 0 inside a face, 1 on an edge, 2 at a corner
  std::vector<int> side;  // of each node: to where its surface looks
  double area = 0.0;      // m^2
};

Vec3 normal(const Boundary& b, const std::vector<int>& facet) {
  Vec3 sum = Vec3::Zero();
  for (size_t k = 2; k < facet.size(); ++k)
    sum += (b.x.col(facet[k - 1]) - b.x.col(facet[0])).cross(b.x.col(facet[k]) - b.x.col(facet[0]));
  return sum;
}

void find_edges(Boundary& b) {
  std::map<std::pair<int, int>, std::vector<int>> beside;
  std::vector<Vec3> normals;
  for (size_t f = 0; f < b.facets.size(); ++f) {
    const std::vector<int>& facet = b.facets[f];
    normals.push_back(normal(b, facet));
    b.area += 0.5 * normals.back().norm();
    normals.back().normalize();
    for (size_t k = 0; k < facet.size(); ++k)
      beside[std::minmax(facet[k], facet[(k + 1) % facet.size()])].push_back(static_cast<int>(f));
  }
  Points of_node = Points::Zero(3, b.x.cols());
  for (size_t f = 0; f < b.facets.size(); ++f)
    for (const int node : b.facets[f]) of_node.col(node) += normal(b, b.facets[f]);
  b.side = sides_of(of_node);
  std::vector<int> n_edges(b.nodes.size(), 0);
  for (const auto& [nodes, facets] : beside) {
    const bool is_smooth = facets.size() == 2 && normals[facets[0]].dot(normals[facets[1]]) > sharp_cosine;
    if (is_smooth && b.label[facets[0]] == b.label[facets[1]]) continue;
    b.edges.push_back({nodes.first, nodes.second});
    ++n_edges[nodes.first];
    ++n_edges[nodes.second];
  }
  for (const int n : n_edges) b.rank.push_back(n == 0 ? 0 : n == 2 ? 1 : 2);
}

Boundary boundary_of(const Substructure& part, const FacetLabels* labels) {
  Boundary b;
  const std::vector<Facet> facets = boundary_facets(*part.mesh);
  for (const Facet& facet : facets) b.nodes.insert(b.nodes.end(), facet.nodes().begin(), facet.nodes().end());
  std::sort(b.nodes.begin(), b.nodes.end());
  b.nodes.erase(std::unique(b.nodes.begin(), b.nodes.end()), b.nodes.end());
  b.x = part.mesh->nodes(Eigen::all, b.nodes).colwise() + part.place;
  for (const Facet& facet : facets) {
    const auto found = labels ? labels->find(facet_key(facet)) : FacetLabels::const_iterator{};
    for (const SubFacet& sub : facet_shape(facet.type()).sub_facets) {
      std::vector<int>& corners = b.facets.emplace_back();
      for (int a = 0; a < sub.n; ++a) {
        const auto at = std::lower_bound(b.nodes.begin(), b.nodes.end(), facet.nodes()[sub.nodes[a]]);
        corners.push_back(static_cast<int>(at - b.nodes.begin()));
      }
      b.label.push_back(labels && found != labels->end() ? found->second : 0);
    }
  }
  find_edges(b);
  return b;
}

// Nodes of each part of `most` in all: as many as it has, or a share that grows with the root of its area.
std::vector<int> quotas(const std::vector<Boundary>& parts, int most) {
  const int least = std::max(8, std::min(100, most / (2 * static_cast<int>(parts.size()) + 1)));
  std::vector<int> quota(parts.size());
  const auto share_out = [&](double unit) {
    for (size_t p = 0; p < parts.size(); ++p)
      quota[p] = std::min<int>(static_cast<int>(parts[p].nodes.size()),
                               std::max<int>(least, static_cast<int>(unit * std::sqrt(parts[p].area))));
    return std::accumulate(quota.begin(), quota.end(), 0);
  };
  double low = 0.0, high = 1.0;
  double all = 1e-300;
  for (const Boundary& part : parts) all = std::max(all, std::sqrt(part.area));
  high = 65535.0 * 16.0 / all;
  if (share_out(high) <= most) return quota;
  for (int i = 0; i < 60; ++i) (share_out(0.5 * (low + high)) <= most ? low : high) = 0.5 * (low + high);
  share_out(low);
  return quota;
}

// For each node the number of the cube of edge `size` it lies in, with those of its side, and how many there are.
int in_cubes(const Boundary& b, double size, std::vector<int>& cube) {
  std::map<std::tuple<int, long, long, long>, int> known;
  for (size_t i = 0; i < b.nodes.size(); ++i) {
    const Vec3 x = b.x.col(static_cast<Eigen::Index>(i)) / size;
    const auto key = std::tuple(b.side[i], std::lround(x[0]), std::lround(x[1]), std::lround(x[2]));
    cube[i] = known.try_emplace(key, static_cast<int>(known.size())).first->second;
  }
  return static_cast<int>(known.size());
}

// One cube around everything still tells the sides of the part apart, however few nodes it was to have.
std::vector<int> clusters(const Boundary& b, int quota, int& n) {
  if (b.nodes.empty()) return {};  // a body of points alone has no skin
  const double largest = 4.0 * (b.x.rowwise().maxCoeff() - b.x.rowwise().minCoeff()).norm();
  std::vector<int> cube(b.nodes.size());
  std::iota(cube.begin(), cube.end(), 0);
  n = static_cast<int>(cube.size());
  for (double size = std::sqrt(b.area / std::max(quota, 1)); n > quota && size < largest; size *= 1.15)
    n = in_cubes(b, size, cube);
  return cube;
}

// Appends a part. Of the nodes in a cluster those of highest rank give it its place, so that corners stay corners.
void append(const Boundary& b, int quota, TurningMesh& mesh, std::vector<Vec3>& places) {
  const int first = static_cast<int>(places.size());
  TurningMesh::Part& part = mesh.parts.emplace_back();
  const std::vector<int> cluster = clusters(b, quota, part.n_nodes);
  std::vector<int> rank(static_cast<size_t>(part.n_nodes), 0), count(static_cast<size_t>(part.n_nodes), 0);
  for (size_t i = 0; i < cluster.size(); ++i) rank[cluster[i]] = std::max(rank[cluster[i]], b.rank[i]);
  places.resize(places.size() + part.n_nodes, Vec3::Zero());
  for (size_t i = 0; i < cluster.size(); ++i) {
    part.leads.push_back(b.rank[i] == rank[cluster[i]]);
    part.to.push_back(first + cluster[i]);
    if (!part.leads.back()) continue;
    ++count[cluster[i]];
    places[part.to.back()] += b.x.col(static_cast<Eigen::Index>(i));
  }
  for (int c = 0; c < part.n_nodes; ++c) places[first + c] /= count[c];
  part.nodes = b.nodes;
  for (size_t f = 0; f < b.facets.size(); ++f)
    for (size_t k = 2; k < b.facets[f].size(); ++k) {
      const std::array<int, 3> t = {part.to[b.facets[f][0]], part.to[b.facets[f][k - 1]], part.to[b.facets[f][k]]};
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
      mesh.triangles.push_back(t);
      mesh.label.push_back(b.label[f]);
      ++part.n_triangles;
    }
  std::set<std::pair<int, int>> edges;
  for (const auto& [a, c] : b.edges)
    if (part.to[a] != part.to[c]) edges.insert(std::minmax(part.to[a], part.to[c]));
  for (const auto& [a, c] : edges) mesh.edges.push_back({a, c});
}

}  // namespace

TurningMesh make_turning_mesh(const std::vector<SubstructurePtr>& parts, const std::vector<FacetLabels>& labels,
                              int most_nodes) {
  std::vector<Boundary> boundaries(parts.size());
  parallel_for(static_cast<int>(parts.size()), [&](int i) {
    const size_t p = static_cast<size_t>(i);
    boundaries[p] = boundary_of(*parts[p], labels.empty() ? nullptr : &labels[p]);
  });
  const std::vector<int> quota = quotas(boundaries, most_nodes);
  TurningMesh mesh;
  std::vector<Vec3> places;
  for (size_t p = 0; p < parts.size(); ++p) append(boundaries[p], quota[p], mesh, places);
  if (places.size() > 65535) throw InputError("too many parts for a rotating picture");
  mesh.nodes.resize(3, static_cast<Eigen::Index>(places.size()));
  for (size_t i = 0; i < places.size(); ++i) mesh.nodes.col(static_cast<Eigen::Index>(i)) = places[i];
  return mesh;
}

}  // namespace dygita
