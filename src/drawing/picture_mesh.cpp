#include "drawing/picture_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <tuple>

namespace dygita {

namespace {

// Nodes of a skin as they are met: those of a part's mesh, and those where a cut divides an edge of it.
class SkinNodes {
 public:
  void begin(const Substructure& part, const Points* displacement, const Vec* value, double scale) {
    part_ = &part;
    displacement_ = displacement;
    value_ = value;
    scale_ = scale;
    of_node_.assign(static_cast<size_t>(part.mesh->n_nodes()), -1);
    of_edge_.clear();
  }

  int at(int node) {
    int& number = of_node_[static_cast<size_t>(node)];
    if (number < 0) number = add(place(node), moved(node), value(node));
    return number;
  }

  // Between two nodes, `share` of the way.
  int between(int a, int b, double share) {
    if (a > b) {
      std::swap(a, b);
      share = 1.0 - share;
    }
    const auto [found, is_new] = of_edge_.try_emplace({a, b}, 0);
    if (is_new)
      found->second = add(place(a) + share * (place(b) - place(a)), moved(a) + share * (moved(b) - moved(a)),
                          value(a) + share * (value(b) - value(a)));
    return found->second;
  }

  Vec3 place(int node) const { return part_->mesh->nodes.col(node) + part_->place; }
  const Vec3& reference(int number) const { return reference_[static_cast<size_t>(number)]; }

  void give(Skin& skin) const {
    const auto n = static_cast<Eigen::Index>(reference_.size());
    skin.position.resize(3, n);
    skin.reference.resize(3, n);
    skin.value = Eigen::Map<const Vec>(value_of_.data(), n);
    for (Eigen::Index i = 0; i < n; ++i) {
      skin.position.col(i) = position_[static_cast<size_t>(i)];
      skin.reference.col(i) = reference_[static_cast<size_t>(i)];
    }
  }

 private:
  Vec3 moved(int node) const {
    const Vec3 u = displacement_ ? Vec3(displacement_->col(node)) : Vec3::Zero().eval();
    return u.allFinite() ? Vec3(place(node) + scale_ * u) : place(node);
  }
  double value(int node) const { return value_ && std::isfinite((*value_)[node]) ? (*value_)[node] : 0.0; }
  int add(const Vec3& reference, const Vec3& position, double value) {
    reference_.push_back(reference);
    position_.push_back(position);
    value_of_.push_back(value);
    return static_cast<int>(reference_.size()) - 1;
  }

  const Substructure* part_ = nullptr;
  const Points* displacement_ = nullptr;
  const Vec* value_ = nullptr;
  double scale_ = 0.0;
  std::vector<int> of_node_;
  std::map<std::pair<int, int>, int> of_edge_;
  std::vector<Vec3> reference_, position_;
  std::vector<double> value_of_;
};

// A convex polygon as facets of four corners at most.
void add_polygon(const std::vector<int>& corners, int part, Skin& skin) {
  for (size_t k = 1; k + 1 < corners.size(); k += 2) {
    SkinFacet& facet = skin.facets.emplace_back();
    for (const size_t i : {size_t{0}, k, k + 1, k + 2})
      if (i < corners.size()) facet.corners[static_cast<size_t>(facet.n_corners++)] = corners[i];
    skin.part.push_back(part);
  }
}

// m, of each node of the part from the view's cut, positive in front. A plane through nodes would leave slivers of the
// cells that it only touches: it stands back by next to nothing.
Vec in_front_of_cut(const Substructure& part, const View& view) {
  const double back = 1e-6 * view.size;
  return ((part.mesh->nodes.colwise() + (part.place - view.cut_at)).transpose() * view.cut).array() + back;
}

std::vector<int> corners_of(const Facet& facet, const SubFacet& sub) {
  std::vector<int> corners;
  for (int a = 0; a < sub.n; ++a) corners.push_back(facet.nodes()[sub.nodes[a]]);
  return corners;
}

// What of a polygon of nodes lies behind the cut, in the order of its corners.
std::vector<int> behind(std::span<const int> corners, const Vec& front, SkinNodes& nodes) {
  std::vector<int> kept;
  for (size_t k = 0; k < corners.size(); ++k) {
    const int a = corners[k], b = corners[(k + 1) % corners.size()];
    if (front[a] <= 0.0) kept.push_back(nodes.at(a));
    if ((front[a] <= 0.0) != (front[b] <= 0.0)) kept.push_back(nodes.between(a, b, front[a] / (front[a] - front[b])));
  }
  return kept;
}

// The polygon in which the cut divides a cell, counter-clockwise seen from in front; empty where it passes by.
std::vector<int> section(const CellBlock& block, int i_cell, const Vec& front, const View& view, SkinNodes& nodes) {
  std::vector<int> corners;
  for (int k = 0; k < facets_per_cell(block.type); ++k) {
    const Facet facet = facet_of_cell(block, i_cell, k);
    const std::span<const int> rim = facet_shape(facet.type()).rim;
    for (size_t j = 0; j < rim.size(); ++j) {
      const int a = facet.nodes()[rim[j]], b = facet.nodes()[rim[(j + 1) % rim.size()]];
      if (a > b || (front[a] <= 0.0) == (front[b] <= 0.0)) continue;  // each edge is met once in this order
      corners.push_back(nodes.between(a, b, front[a] / (front[a] - front[b])));
    }
  }
  if (corners.size() < 3) return {};
  Vec3 centre = Vec3::Zero();
  for (const int corner : corners) centre += nodes.reference(corner) / static_cast<double>(corners.size());
  const Vec3 across = view.cut.unitOrthogonal(), up = view.cut.cross(across);
  const auto angle = [&](int corner) {
    const Vec3 from = nodes.reference(corner) - centre;
    return std::atan2(up.dot(from), across.dot(from));
  };
  std::sort(corners.begin(), corners.end(), [&](int a, int b) { return angle(a) < angle(b); });
  return corners;
}

}  // namespace

Vec3 Skin::normal(int i_facet) const {
  const SkinFacet& f = facets[i_facet];
  const Vec3 a = position.col(f.corners[0]);
  Vec3 normal = Vec3::Zero();
  for (int k = 2; k < f.n_corners; ++k)
    normal += (position.col(f.corners[k - 1]) - a).cross(position.col(f.corners[k]) - a);
  return normal;
}

Skin make_skin(const std::vector<SubstructurePtr>& parts, const View& view, const std::vector<Points>& displacement,
               const std::vector<Vec>& values, double scale) {
  Skin skin;
  SkinNodes nodes;
  for (size_t p = 0; p < parts.size(); ++p) {
    const Substructure& part = *parts[p];
    const int i_part = static_cast<int>(p);
    nodes.begin(part, displacement.empty() ? nullptr : &displacement[p], values.empty() ? nullptr : &values[p], scale);
    const Vec front = view.is_cut ? in_front_of_cut(part, view) : Vec::Constant(part.mesh->n_nodes(), -1.0);
    for (const Facet& facet : boundary_facets(*part.mesh))
      for (const SubFacet& sub : facet_shape(facet.type()).sub_facets)
        if (const std::vector<int> kept = behind(corners_of(facet, sub), front, nodes); kept.size() >= 3)
          add_polygon(kept, i_part, skin);
    if (!(front.maxCoeff() > 0.0)) continue;
    for (const CellBlock& block : part.mesh->blocks)
      for (int i = 0; i < block.n_cells(); ++i) add_polygon(section(block, i, front, view, nodes), i_part, skin);
  }
  nodes.give(skin);
  return skin;
}

std::vector<int> sides_of(const Points& normals) {
  constexpr double least = 0.3;  // of a component, to count
  std::vector<int> sides;
  for (Eigen::Index i = 0; i < normals.cols(); ++i) {
    const Vec3 n = normals.col(i).normalized();
    int side = 0;
    for (int d = 0; d < 3; ++d) side = 3 * side + (n[d] > least ? 2 : n[d] < -least ? 0 : 1);
    sides.push_back(side);
  }
  return sides;
}

Skin merged(const Skin& skin, double size) {
  std::map<std::tuple<int, int, long, long, long>, int> cube;
  Points normals = Points::Zero(3, skin.reference.cols());
  for (size_t f = 0; f < skin.facets.size(); ++f)
    for (int k = 0; k < skin.facets[f].n_corners; ++k)
      normals.col(skin.facets[f].corners[k]) += skin.normal(static_cast<int>(f));
  const std::vector<int> side = sides_of(normals);
  std::vector<int> to(static_cast<size_t>(skin.reference.cols()), -1), count;
  std::vector<Vec3> position, reference;
  std::vector<double> value;
  Skin coarse;
  for (size_t f = 0; f < skin.facets.size(); ++f) {
    SkinFacet small;
    for (int k = 0; k < skin.facets[f].n_corners; ++k) {
      const int node = skin.facets[f].corners[k];
      if (to[node] < 0) {
        const Vec3 place = skin.reference.col(node) / size;
        const auto key = std::tuple(skin.part[f], side[static_cast<size_t>(node)], std::lround(place[0]),
                                    std::lround(place[1]), std::lround(place[2]));
        const auto [at, is_new] = cube.try_emplace(key, static_cast<int>(position.size()));
        to[node] = at->second;
        if (is_new) {
          position.push_back(Vec3::Zero());
          reference.push_back(Vec3::Zero());
          value.push_back(skin.value[node]);
          count.push_back(0);
        }
        position[at->second] += skin.position.col(node);
        reference[at->second] += skin.reference.col(node);
        value[at->second] = std::max(value[at->second], skin.value[node]);
        ++count[at->second];
      }
      const auto end = small.corners.begin() + small.n_corners;
      if (std::find(small.corners.begin(), end, to[node]) == end) small.corners[small.n_corners++] = to[node];
    }
    if (small.n_corners < 3) continue;
    coarse.facets.push_back(small);
    coarse.part.push_back(skin.part[f]);
  }
  const auto n = static_cast<Eigen::Index>(position.size());
  coarse.position.resize(3, n);
  coarse.reference.resize(3, n);
  coarse.value = Eigen::Map<const Vec>(value.data(), n);
  for (Eigen::Index i = 0; i < n; ++i) {
    coarse.position.col(i) = position[static_cast<size_t>(i)] / count[static_cast<size_t>(i)];
    coarse.reference.col(i) = reference[static_cast<size_t>(i)] / count[static_cast<size_t>(i)];
  }
  return coarse;
}

std::vector<SharpEdge> sharp_edges(const Skin& skin) {
  std::map<std::pair<int, int>, std::vector<int>> facets_of_edge;
  for (size_t f = 0; f < skin.facets.size(); ++f) {
    const SkinFacet& facet = skin.facets[f];
    for (int k = 0; k < facet.n_corners; ++k) {
      const int a = facet.corners[k], b = facet.corners[(k + 1) % facet.n_corners];
      facets_of_edge[std::minmax(a, b)].push_back(static_cast<int>(f));
    }
  }
  std::vector<SharpEdge> edges;
  for (const auto& [nodes, facets] : facets_of_edge) {
    bool is_sharp = facets.size() != 2;
    if (!is_sharp)
      is_sharp = skin.normal(facets[0]).normalized().dot(skin.normal(facets[1]).normalized()) < sharp_cosine;
    if (is_sharp) edges.push_back({nodes.first, nodes.second, facets.front()});
  }
  return edges;
}

}  // namespace dygita
