#include "drawing/joint_map.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "mesh/face_nodes.hpp"

namespace dygita {

namespace {

using Corner = std::array<double, 2>;

// Nodes in the order they follow each other around the facet.
std::vector<int> around(const Facet& facet) {
  std::vector<int> nodes;
  for (const int a : facet_shape(facet.type()).rim) nodes.push_back(facet.nodes()[a]);
  return nodes;
}

std::string nearest_axis(const Vec3& direction) {
  int axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  return std::string(direction[axis] < 0.0 ? "-" : "") + "xyz"[axis];
}

// Each facet divided into quadrangles, one per node: corner, middle of the next edge, centre, middle of the edge
// before.
void divide(const JointScenes& joint, const std::vector<Corner>& flat, JointMap& map) {
  const auto middle = [](const Corner& a, const Corner& b) { return Corner{0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])}; };
  for (const Facet& facet : joint.facets) {
    const std::vector<int> nodes = around(facet);
    const size_t n = nodes.size();
    Corner centre{0.0, 0.0};
    for (const int node : nodes)
      for (int d = 0; d < 2; ++d) centre[d] += flat[node][d] / static_cast<double>(n);
    for (size_t k = 0; k < n; ++k) {
      const Corner &here = flat[nodes[k]], &next = flat[nodes[(k + 1) % n]], &before = flat[nodes[(k + n - 1) % n]];
      map.cells.push_back({here, middle(here, next), centre, middle(before, here)});
      map.points.push_back({nodes[k]});
    }
  }
}

// Facets with the points of each square of edge `size` merged into one.
void merge(const JointScenes& joint, const std::vector<Corner>& flat, double size, JointMap& map) {
  map.cells.clear();
  map.points.clear();
  std::map<std::pair<long, long>, int> square;
  std::vector<int> to(flat.size());
  std::vector<std::vector<int>> members;
  for (size_t i = 0; i < flat.size(); ++i) {
    const auto key = size > 0.0 ? std::pair(std::lround(flat[i][0] / size), std::lround(flat[i][1] / size))
                                : std::pair(static_cast<long>(i), 0L);
    const auto [at, is_new] = square.try_emplace(key, static_cast<int>(members.size()));
    if (is_new) members.emplace_back();
    members[at->second].push_back(static_cast<int>(i));
    to[i] = at->second;
  }
  for (const Facet& facet : joint.facets) {
    std::vector<int> corners;
    for (const int node : around(facet))
      if (std::find(corners.begin(), corners.end(), to[node]) == corners.end()) corners.push_back(to[node]);
    if (corners.size() < 3) continue;
    std::vector<Corner>& cell = map.cells.emplace_back();
    std::vector<int>& points = map.points.emplace_back();
    for (const int corner : corners) {
      Corner place{0.0, 0.0};
      for (const int i : members[corner])
        for (int d = 0; d < 2; ++d) place[d] += flat[i][d] / static_cast<double>(members[corner].size());
      cell.push_back(place);
      points.insert(points.end(), members[corner].begin(), members[corner].end());
    }
  }
}

}  // namespace

JointMap make_joint_map(const JointScenes& joint, int most_cells) {
  JointMap map;
  Vec3 normal = Vec3::Zero();
  double area = 0.0;
  for (const Facet& facet : joint.facets) {
    const Vec3 own = facet_area_vector(joint.points, facet);
    normal += own;
    area += own.norm();
  }
  if (!(normal.norm() > 0.3 * area)) return map;
  map.is_flat = true;
  normal.normalize();
  int dominant = 0;
  normal.cwiseAbs().maxCoeff(&dominant);
  if (normal[dominant] < 0.0) normal = -normal;
  Vec3 across = Vec3::Unit((dominant + 1) % 3);
  across = (across - across.dot(normal) * normal).normalized();
  const Vec3 up = normal.cross(across);
  map.across = nearest_axis(across);
  map.up = nearest_axis(up);

  std::vector<Corner> flat(static_cast<size_t>(joint.points.cols()));
  Corner low{1e300, 1e300}, high{-1e300, -1e300};
  for (size_t i = 0; i < flat.size(); ++i) {
    const Vec3 x = joint.points.col(static_cast<Eigen::Index>(i));
    flat[i] = {across.dot(x), up.dot(x)};
    for (int d = 0; d < 2; ++d) {
      low[d] = std::min(low[d], flat[i][d]);
      high[d] = std::max(high[d], flat[i][d]);
    }
  }
  for (Corner& corner : flat)
    for (int d = 0; d < 2; ++d) corner[d] -= low[d];
  map.width = high[0] - low[0];
  map.height = high[1] - low[1];
  if (4 * joint.facets.size() <= static_cast<size_t>(most_cells)) {
    divide(joint, flat, map);
    return map;
  }
  merge(joint, flat, 0.0, map);
  for (double size = std::sqrt(area / most_cells); map.cells.size() > static_cast<size_t>(most_cells); size *= 1.2)
    merge(joint, flat, size, map);
  return map;
}

int state_of_cell(const std::vector<unsigned char>& status, const std::vector<int>& points) {
  int n[3] = {0, 0, 0};
  for (const int point : points) ++n[std::min<int>(status[point], 2)];
  int worst = 0;  // open, slip, stick: the first of equals
  for (const int state : {0, 2, 1})
    if (n[state] > n[worst]) worst = state;
  return worst;
}

double mean_of_cell(const std::vector<float>& values, const std::vector<int>& points) {
  double sum = 0.0;
  for (const int point : points) sum += values[point];
  return points.empty() ? 0.0 : sum / static_cast<double>(points.size());
}

}  // namespace dygita
