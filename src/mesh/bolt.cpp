#include "mesh/bolt.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "mesh/face_nodes.hpp"
#include "mesh/raise_order.hpp"

namespace dygita {

namespace {

const double pi = std::acos(-1.0);
constexpr double core_radius = 0.55;  // of the shank's: the square grid inside it
constexpr double core_square = 0.35;  // how square that grid is, from 0 (round) to 1
constexpr double flatness = 1.5;      // a cell's length over its width around

// A section: nodes in the plane, quadrilaterals counter-clockwise, those of the shank first.
struct Section {
  std::vector<Eigen::Vector2d> nodes;
  std::vector<std::array<int, 4>> quads;
  size_t n_inner = 0;      // of the quads: those of the shank
  std::vector<int> round;  // per node: 1 + number of the circle that it is on; 0: none
};

// The vertices of a polygon with n sides that has the area of a circle; on the circle where sides will be curved.
double polygon_radius(double radius, int n, int order) {
  const double angle = 2.0 * pi / n;
  return order == 1 ? radius * std::sqrt(angle / std::sin(angle)) : radius;
}

double angle_of(int k, int n) { return pi / 4.0 + 2.0 * pi * k / n; }

Eigen::Vector2d at(double radius, double angle) { return radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)); }

// From a square to a shape between a square and a circle; (u, v) in [-1, 1]^2.
Eigen::Vector2d core_place(double u, double v, double radius) {
  const Eigen::Vector2d q(std::tan(u * pi / 4.0), std::tan(v * pi / 4.0));
  const double t = q.cwiseAbs().maxCoeff();
  if (t == 0.0) return q;
  const double to_circle = t / q.norm();  // 1 on the axes, 0.7 at the corners
  return radius * q * (1.0 - t * (1.0 - core_square) * (1.0 - to_circle));
}

// Nodes of the core's square grid, and those of its rim by their number around, from the corner at 45 degrees on.
std::vector<int> add_core(double radius, int around, Section& section) {
  const int m = around / 4;
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= m; ++i) section.nodes.push_back(core_place(2.0 * i / m - 1.0, 2.0 * j / m - 1.0, radius));
  const auto node = [&](int i, int j) { return i + (m + 1) * j; };
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < m; ++i)
      section.quads.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
  std::vector<int> rim;
  for (int i = m; i > 0; --i) rim.push_back(node(i, m));  // along the top to the left, then down, and around
  for (int j = m; j > 0; --j) rim.push_back(node(0, j));
  for (int i = 0; i < m; ++i) rim.push_back(node(i, 0));
  for (int j = 0; j < m; ++j) rim.push_back(node(m, j));
  return rim;
}

// Rings of quadrilaterals from a rim to places further out; answers the last rim.
template <typename Place>
std::vector<int> add_rings(std::vector<int> rim, int n_rings, Place outside, Section& section) {
  const int n = static_cast<int>(rim.size());
  const std::vector<int> first = rim;
  for (int ring = 1; ring <= n_rings; ++ring) {
    std::vector<int> next;
    for (int k = 0; k < n; ++k) {
      const double part = static_cast<double>(ring) / n_rings;
      next.push_back(static_cast<int>(section.nodes.size()));
      section.nodes.push_back((1.0 - part) * section.nodes[static_cast<size_t>(first[static_cast<size_t>(k)])] +
                              part * outside(k));
    }
    for (int k = 0; k < n; ++k) {
      const int l = (k + 1) % n;
      section.quads.push_back({rim[static_cast<size_t>(k)], next[static_cast<size_t>(k)], next[static_cast<size_t>(l)],
                               rim[static_cast<size_t>(l)]});
    }
    rim = std::move(next);
  }
  return rim;
}

void mark_round(const std::vector<int>& rim, int circle, Section& section) {
  section.round.resize(section.nodes.size(), 0);
  for (const int node : rim) section.round[static_cast<size_t>(node)] = circle;
}

double hexagon_radius(double across_flats, double angle) {
  // A corner is at 45 degrees, where a node is.
  const double from_flat = std::remainder(angle - pi / 4.0 - pi / 6.0, pi / 3.0);
  return 0.5 * across_flats / std::cos(from_flat);
}

Section bolt_section(const BoltEnd& bolt) {
  Section section;
  const double radius = polygon_radius(0.5 * bolt.diameter, bolt.around, bolt.order);
  const int n_rings = std::max(1, bolt.around / 12);
  std::vector<int> rim = add_core(core_radius * radius, bolt.around, section);
  rim = add_rings(
      rim, n_rings, [&](int k) { return at(radius, angle_of(k, bolt.around)); }, section);
  mark_round(rim, 1, section);
  section.n_inner = section.quads.size();
  add_rings(
      rim, n_rings + 1,
      [&](int k) {
        const double angle = angle_of(k, bolt.around);
        return at(hexagon_radius(bolt.across_flats, angle), angle);
      },
      section);
  section.round.resize(section.nodes.size(), 0);
  return section;
}

// Layers from one level to the next; `is_whole`: of the hexagon too.
struct Slab {
  double low, high;
  int n_layers;
  bool is_whole;
};

// The section drawn out along z, nodes without a cell left away, straight.
std::shared_ptr<Mesh> extruded(const Section& section, const std::vector<Slab>& slabs, std::vector<int>& round) {
  std::vector<double> levels = {slabs.front().low};
  std::vector<bool> is_whole;
  for (const Slab& slab : slabs)
    for (int i = 1; i <= slab.n_layers; ++i) {
      levels.push_back(slab.low + (slab.high - slab.low) * i / slab.n_layers);
      is_whole.push_back(slab.is_whole);
    }
  auto mesh = std::make_shared<Mesh>();
  mesh->source = "bolt";
  CellBlock block{CellType::hex8, {}};
  const size_t n = section.nodes.size();
  std::vector<int> number(n * levels.size(), -1);
  std::vector<Vec3> places;
  const auto node = [&](int in_section, size_t level) {
    int& known = number[level * n + static_cast<size_t>(in_section)];
    if (known < 0) {
      known = static_cast<int>(places.size());
      const Eigen::Vector2d& x = section.nodes[static_cast<size_t>(in_section)];
      places.emplace_back(x[0], x[1], levels[level]);
      round.push_back(section.round[static_cast<size_t>(in_section)]);
    }
    return known;
  };
  for (size_t layer = 0; layer + 1 < levels.size(); ++layer)
    for (size_t q = 0; q < (is_whole[layer] ? section.quads.size() : section.n_inner); ++q)
      for (const size_t level : {layer, layer + 1})
        for (const int corner : section.quads[q]) block.nodes.push_back(node(corner, level));
  mesh->blocks.push_back(std::move(block));
  mesh->nodes.resize(3, static_cast<Eigen::Index>(places.size()));
  for (size_t i = 0; i < places.size(); ++i) mesh->nodes.col(static_cast<Eigen::Index>(i)) = places[i];
  return mesh;
}

// Middles of edges along a circle go out to it.
MeshPtr curved(const Mesh& linear, const std::vector<int>& round) {
  auto mesh = std::make_shared<Mesh>(*second_order(linear, SecondOrder::edges_only));
  const std::vector<std::vector<int>> middles = middle_corners(CellType::hex20);
  const CellBlock& block = mesh->blocks[0];
  for (int i = 0; i < block.n_cells(); ++i)
    for (size_t m = 0; m < middles.size(); ++m) {
      const int a = block.cell(i)[middles[m][0]], b = block.cell(i)[middles[m][1]];
      if (round[static_cast<size_t>(a)] == 0 || round[static_cast<size_t>(a)] != round[static_cast<size_t>(b)])
        continue;
      auto middle = mesh->nodes.col(block.cell(i)[8 + m]);
      middle.head<2>() *= mesh->nodes.col(a).head<2>().norm() / middle.head<2>().norm();
    }
  return mesh;
}

template <typename Name>
MeshPtr with_faces(std::shared_ptr<Mesh> mesh, const std::vector<int>& round, int order, Name name) {
  for (const Facet& facet : boundary_facets(mesh->blocks)) {
    Vec3 middle = Vec3::Zero();
    for (const int node : facet.corners()) middle += 0.25 * mesh->nodes.col(node);
    const Vec3 normal = facet_area_vector(mesh->nodes, facet).normalized();
    mesh->faces[name(facet, middle, normal)].push_back(facet);
  }
  auto whole = std::make_shared<Mesh>(order == 1 ? *mesh : *curved(*mesh, round));
  whole->source = "bolt";
  whole->digest = mesh_digest(*whole);
  return whole;
}

double n_layers(double length, double width) { return std::max(1.0, std::round(length / (flatness * width))); }

int layers(double length, double width) { return static_cast<int>(n_layers(length, width)); }

int rings_of_washer(const WasherShape& washer) {
  const double inner = polygon_radius(0.5 * washer.inner, washer.around, washer.order),
               outer = polygon_radius(0.5 * washer.outer, washer.around, washer.order);
  return std::max(2, static_cast<int>(std::lround((outer - inner) / (pi * washer.inner / washer.around))));
}

}  // namespace

MeshPtr bolt_end_mesh(const BoltEnd& bolt) {
  CHECK(bolt.around % 12 == 0 && bolt.around > 0, "nodes at the corners of a square and of a hexagon");
  const double width = pi * bolt.diameter / bolt.around;
  const double sign = bolt.is_above ? 1.0 : -1.0, end = bolt.bearing + sign * bolt.height,
               cut = bolt.bearing - sign * bolt.shank;
  const Slab hexagon{std::min(bolt.bearing, end), std::max(bolt.bearing, end), layers(bolt.height, width), true};
  const Slab shank{std::min(bolt.bearing, cut), std::max(bolt.bearing, cut), layers(bolt.shank, width), false};
  std::vector<int> round;
  const auto mesh =
      extruded(bolt_section(bolt), bolt.is_above ? std::vector{shank, hexagon} : std::vector{hexagon, shank}, round);
  const double near = 1e-6 * bolt.height;
  return with_faces(mesh, round, bolt.order, [&](const Facet& facet, const Vec3& middle, const Vec3& normal) {
    if (std::abs(normal[2]) > 0.5)
      return std::abs(middle[2] - cut) < near ? "cut" : std::abs(middle[2] - end) < near ? "end" : "bearing";
    const bool is_shank = std::all_of(facet.corners().begin(), facet.corners().end(),
                                      [&](int node) { return round[static_cast<size_t>(node)] > 0; });
    return is_shank ? "shank" : "flats";
  });
}

MeshPtr washer_mesh(const WasherShape& washer) {
  Section section;
  const double inner = polygon_radius(0.5 * washer.inner, washer.around, washer.order),
               outer = polygon_radius(0.5 * washer.outer, washer.around, washer.order);
  std::vector<int> rim;
  for (int k = 0; k < washer.around; ++k) {
    rim.push_back(k);
    section.nodes.push_back(at(inner, angle_of(k, washer.around)));
  }
  const double width = pi * washer.inner / washer.around;
  const int n_rings = rings_of_washer(washer);
  mark_round(rim, 1, section);
  rim = add_rings(
      rim, n_rings, [&](int k) { return at(outer, angle_of(k, washer.around)); }, section);
  mark_round(rim, 2, section);
  section.n_inner = section.quads.size();
  std::vector<int> round;
  const Slab slab{washer.low, washer.low + washer.thickness, layers(washer.thickness, width), true};
  const auto mesh = extruded(section, {slab}, round);
  const double between = 0.5 * (inner + outer);
  return with_faces(mesh, round, washer.order, [&](const Facet&, const Vec3& middle, const Vec3& normal) {
    if (std::abs(normal[2]) > 0.5) return normal[2] > 0.0 ? "upper" : "lower";
    return middle.head<2>().norm() < between ? "inside" : "outside";
  });
}

double n_cells(const BoltEnd& bolt) {
  const double n = bolt.around, width = pi * bolt.diameter / n, rings = std::max(1.0, std::floor(n / 12));
  const double inside = n * n / 16 + n * rings;
  return inside * n_layers(bolt.shank, width) + (inside + n * (rings + 1)) * n_layers(bolt.height, width);
}

double n_cells(const WasherShape& washer) {
  return washer.around * rings_of_washer(washer) * n_layers(washer.thickness, pi * washer.inner / washer.around);
}

}  // namespace dygita
