#include "mesh/divide_tetrahedra.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.hpp"
#include "mesh/raise_order.hpp"

namespace dygita {

namespace {

using Weights = Eigen::Vector4d;  // barycentric, in a tetrahedron of the whole
using Edge = std::pair<int, int>;
using NodeRing = std::vector<int>;

constexpr int n_tet = 4;
constexpr std::array<std::array<int, 3>, 4> triangles = {{{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}};

bool is_tetrahedron(CellType type) { return cell_shape(type).n_corners == n_tet; }

Edge edge_of(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

double volume_of(const Points& x, const int* c) {
  return (x.col(c[1]) - x.col(c[0])).cross(x.col(c[2]) - x.col(c[0])).dot(x.col(c[3]) - x.col(c[0])) / 6;
}

class Divider {
 public:
  Divider(const Mesh& mesh, const Vec3& normal, double at, double tolerance)
      : mesh_(mesh), normal_(normal), at_(at), n_(mesh.n_nodes()), all_{mesh.nodes, {}, {}, 0} {
    sides_.resize(static_cast<size_t>(n_));
    for (int i = 0; i < n_; ++i) sides_[static_cast<size_t>(i)] = std::abs(height(i)) > tolerance ? sign(height(i)) : 0;
    for (const CellBlock& block : mesh.blocks)
      if (block.type == CellType::tet10) middles_ = middle_corners(block.type);
  }

  DividedCells divide() {
    move_near_nodes();
    all_.nodes.conservativeResize(3, capacity_ = n_ + std::max(64, n_ / 4));
    for (const CellBlock& block : mesh_.blocks)
      for (int i = 0; i < block.n_cells(); ++i) add(block, i);
    all_.nodes.conservativeResize(3, n_);
    return std::move(all_);
  }

 private:
  static int sign(double value) { return value > 0 ? 1 : -1; }
  double height(int node) const { return normal_.dot(all_.nodes.col(node)) - at_; }
  int side(int node) const { return node < mesh_.n_nodes() ? sides_[static_cast<size_t>(node)] : 0; }
  void to_plane(int node) { all_.nodes.col(node) -= height(node) * normal_; }

  bool is_crossed(const CellBlock& block, int i) const {
    const int* c = block.cell(i);
    const auto any = [&](int s) {
      return std::any_of(c, c + cell_shape(block.type).n_corners, [&](int node) { return side(node) == s; });
    };
    return any(-1) && any(1);
  }

  // The shortest way to the plane as a share of a crossed edge, of each node of crossed cells.
  std::map<int, double> near_nodes() const {
    constexpr double near = 0.25;
    std::map<int, double> share;
    for (const CellBlock& block : mesh_.blocks)
      for (int i = 0; i < block.n_cells(); ++i) {
        if (!is_crossed(block, i)) continue;
        const int* c = block.cell(i);
        for (int a = 0; a < n_tet; ++a)
          for (int b = 0; b < n_tet; ++b) {
            if (side(c[a]) * side(c[b]) >= 0) continue;
            const double own = height(c[a]) / (height(c[a]) - height(c[b]));
            if (own < near) share.try_emplace(c[a], own).first->second = std::min(own, share[c[a]]);
          }
      }
    return share;
  }

  // Slivers are avoided: a node near the plane moves onto it along the normal, where that leaves the boundary and no
  // cell less than a third of its volume.
  void move_near_nodes() {
    constexpr double along = 0.05, least = 1.0 / 3.0;
    std::map<int, double> share = near_nodes();
    for (const Facet& facet : boundary_facets(mesh_.blocks)) {
      const auto c = facet.corners();
      const Vec3 a = mesh_.nodes.col(c[0]);
      const Vec3 across = (mesh_.nodes.col(c[1]) - a).cross(mesh_.nodes.col(c[2]) - a).normalized();
      if (std::abs(across.dot(normal_)) > along)
        for (const int corner : c) share.erase(corner);
    }
    std::map<int, std::vector<std::pair<const CellBlock*, int>>> cells;
    for (const CellBlock& block : mesh_.blocks)
      for (int i = 0; i < block.n_cells(); ++i)
        for (int a = 0; a < cell_shape(block.type).n_corners; ++a)
          if (share.contains(block.cell(i)[a])) cells[block.cell(i)[a]].emplace_back(&block, i);
    std::vector<std::pair<double, int>> order;
    for (const auto& [node, own] : share) order.emplace_back(own, node);
    std::sort(order.begin(), order.end());
    for (const auto& [own, node] : order) {
      const Vec3 before = all_.nodes.col(node);
      const auto& around = cells.at(node);
      const bool are_tetrahedra =
          std::all_of(around.begin(), around.end(), [](const auto& cell) { return is_tetrahedron(cell.first->type); });
      if (!are_tetrahedra) continue;
      to_plane(node);
      const bool is_good = std::all_of(around.begin(), around.end(), [&](const auto& cell) {
        const int* c = cell.first->cell(cell.second);
        return volume_of(all_.nodes, c) > least * volume_of(mesh_.nodes, c);
      });
      if (!is_good) {
        all_.nodes.col(node) = before;
        continue;
      }
      sides_[static_cast<size_t>(node)] = 0;
      for (const auto& [block, i] : around) take_middles_along(*block, i, node, all_.nodes.col(node) - before);
    }
  }

  // Nodes between a corner that moves and the others go half of its way, once.
  void take_middles_along(const CellBlock& block, int i, int node, const Vec3& by) {
    if (block.type != CellType::tet10) return;
    const int* c = block.cell(i);
    for (size_t m = 0; m < middles_.size(); ++m) {
      const int middle = c[n_tet + static_cast<int>(m)];
      const bool is_beside = c[middles_[m][0]] == node || c[middles_[m][1]] == node;
      if (is_beside && moved_.insert({middle, node}).second) all_.nodes.col(middle) += by / 2;
    }
  }

  void add(const CellBlock& block, int i) {
    const int* c = block.cell(i);
    const bool is_divided = is_crossed(block, i);
    note_middles(block, i, is_divided);
    if (!is_divided) {
      const int n = cell_shape(block.type).n_corners;
      all_.add(block, i, std::any_of(c, c + n, [&](int node) { return side(node) > 0; }) ? 1 : 0);
      return;
    }
    ++all_.n_divided;
    parent_ = &block;
    cell_ = c;
    weights_.clear();
    for (int a = 0; a < n_tet; ++a) weights_[c[a]] = Weights::Unit(a);
    for (const int own : {-1, 1})
      add_polyhedron(own, block.axes.empty() ? nullptr : &block.axes[static_cast<size_t>(i)]);
  }

  // What an edge has between its ends; in the plane where both ends are.
  void note_middles(const CellBlock& block, int i, bool is_divided) {
    if (block.type != CellType::tet10) return;
    const int* c = block.cell(i);
    for (size_t m = 0; m < middles_.size(); ++m) {
      const int a = c[middles_[m][0]], b = c[middles_[m][1]], middle = c[n_tet + static_cast<int>(m)];
      if (is_divided) middle_of_[edge_of(a, b)] = middle;
      if (side(a) == 0 && side(b) == 0) to_plane(middle);
    }
  }

  // The part of the cell on one side: what is left of its triangles, and the section.
  void add_polyhedron(int own, const Mat3* axes) {
    std::vector<NodeRing> faces;
    std::vector<Edge> section;  // its sides: one in each triangle that is cut
    for (const std::array<int, 3>& triangle : triangles) {
      NodeRing left, met;
      for (size_t k = 0; k < 3; ++k) {
        const int a = cell_[triangle[k]], b = cell_[triangle[(k + 1) % 3]];
        if (side(a) * own >= 0) left.push_back(a);
        if (side(a) == 0) met.push_back(a);
        if (side(a) * side(b) >= 0) continue;
        left.push_back(crossing(a, b));
        met.push_back(left.back());
      }
      if (left.size() > 2) faces.push_back(left);
      if (met.size() == 2) section.emplace_back(met[0], met[1]);
    }
    faces.push_back(chained(section));
    add_tetrahedra(faces, own, axes);
  }

  // The sides of a polygon as its corners in their order. An edge of the cell in the plane is a side twice.
  static NodeRing chained(std::vector<Edge> sides) {
    NodeRing polygon = {sides.back().first};
    int next = sides.back().second;
    sides.pop_back();
    while (next != polygon[0]) {
      const int before = polygon.back();
      polygon.push_back(next);
      const auto onward = std::find_if(sides.begin(), sides.end(), [&](const Edge& one) {
        return (one.first == next && one.second != before) || (one.second == next && one.first != before);
      });
      CHECK(onward != sides.end(), "the section of a tetrahedron is a polygon");
      next = onward->first == next ? onward->second : onward->first;
      sides.erase(onward);
    }
    return polygon;
  }

  void add_tetrahedra(const std::vector<NodeRing>& faces, int own, const Mat3* axes) {
    int apex = faces[0][0];
    for (const NodeRing& face : faces) apex = std::min(apex, *std::min_element(face.begin(), face.end()));
    for (NodeRing face : faces) {
      if (std::find(face.begin(), face.end(), apex) != face.end()) continue;
      std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
      for (size_t k = 1; k + 1 < face.size(); ++k) {
        std::array<int, n_tet> c = {face[0], face[k], face[k + 1], apex};
        if (volume_of(all_.nodes, c.data()) < 0) std::swap(c[0], c[1]);
        DividedCell cell{parent_->type, {c.begin(), c.end()}, own > 0 ? 1 : 0, axes};
        if (cell.type == CellType::tet10)
          for (const std::vector<int>& ends : middles_)
            cell.nodes.push_back(middle(c[static_cast<size_t>(ends[0])], c[static_cast<size_t>(ends[1])]));
        all_.cells.push_back(std::move(cell));
      }
    }
  }

  int new_node(const Vec3& x) {
    if (n_ == capacity_) all_.nodes.conservativeResize(3, capacity_ *= 2);
    all_.nodes.col(n_) = x;
    return n_++;
  }

  // Where an edge of the cell meets the plane.
  int crossing(int a, int b) {
    const auto [low, high] = edge_of(a, b);
    const auto [found, is_new] = crossings_.try_emplace(edge_of(a, b), -1, 0.0);
    auto& [node, share] = found->second;
    if (is_new) {
      share = share_at_plane(low, high);
      node = new_node(place((1 - share) * weights_.at(low) + share * weights_.at(high)));
      to_plane(node);
      all_.new_corners[node] = {low, high};
    }
    weights_[node] = (1 - share) * weights_.at(low) + share * weights_.at(high);
    return node;
  }

  double share_at_plane(int a, int b) const {
    const double at_a = height(a), at_b = height(b);
    if (parent_->type != CellType::tet10) return at_a / (at_a - at_b);
    const double at_middle = height(middle_of_.at(edge_of(a, b)));
    double low = 0.0, high = 1.0;
    for (int k = 0; k < 60; ++k) {
      const double t = (low + high) / 2;
      const double at_t = (1 - t) * (1 - 2 * t) * at_a + t * (2 * t - 1) * at_b + 4 * t * (1 - t) * at_middle;
      (sign(at_t) == sign(at_a) ? low : high) = t;
    }
    return (low + high) / 2;
  }

  // Of a place in the cell of the whole.
  Vec3 place(const Weights& w) const {
    Vec3 x = Vec3::Zero();
    const bool is_quadratic = parent_->type == CellType::tet10;
    for (int a = 0; a < n_tet; ++a) x += (is_quadratic ? w[a] * (2 * w[a] - 1) : w[a]) * all_.nodes.col(cell_[a]);
    if (!is_quadratic) return x;
    for (size_t m = 0; m < middles_.size(); ++m)
      x += 4 * w[middles_[m][0]] * w[middles_[m][1]] * all_.nodes.col(cell_[n_tet + static_cast<int>(m)]);
    return x;
  }

  int middle(int a, int b) {
    const auto [found, is_new] = middle_of_.try_emplace(edge_of(a, b), -1);
    if (!is_new) return found->second;
    found->second = new_node(place((weights_.at(a) + weights_.at(b)) / 2));
    if (side(a) == 0 && side(b) == 0) to_plane(found->second);
    return found->second;
  }

  const Mesh& mesh_;
  Vec3 normal_;
  double at_;
  int n_, capacity_ = 0;
  DividedCells all_;
  std::vector<int> sides_;  // of the nodes of the whole: -1 behind, 0 in the plane, 1 beyond
  std::vector<std::vector<int>> middles_;
  std::set<Edge> moved_;
  std::map<Edge, std::pair<int, double>> crossings_;  // node and share, from the lower number
  std::map<Edge, int> middle_of_;
  const CellBlock* parent_ = nullptr;  // of the cell that is being divided
  const int* cell_ = nullptr;
  std::map<int, Weights> weights_;  // of its corners and crossings
};

}  // namespace

void DividedCells::add(const CellBlock& block, int i, int side) {
  const int* c = block.cell(i);
  cells.push_back({block.type,
                   {c, c + nodes_per_cell(block.type)},
                   side,
                   block.axes.empty() ? nullptr : &block.axes[static_cast<size_t>(i)]});
}

bool crosses_tetrahedra_alone(const Mesh& mesh, const Vec3& normal, double at, double tolerance) {
  for (const CellBlock& block : mesh.blocks) {
    if (is_tetrahedron(block.type)) continue;
    for (int i = 0; i < block.n_cells(); ++i) {
      bool is_behind = false, is_beyond = false;
      for (int a = 0; a < cell_shape(block.type).n_corners; ++a) {
        const double height = normal.dot(mesh.nodes.col(block.cell(i)[a])) - at;
        is_behind = is_behind || height < -tolerance;
        is_beyond = is_beyond || height > tolerance;
      }
      if (is_behind && is_beyond) return false;
    }
  }
  return true;
}

DividedCells divided_tetrahedra(const Mesh& mesh, const Vec3& normal, double at, double tolerance) {
  return Divider(mesh, normal, at, tolerance).divide();
}

}  // namespace dygita
