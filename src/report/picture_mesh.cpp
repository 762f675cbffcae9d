#include "report/picture_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace dygita {

namespace {

constexpr double sharp_cosine = 0.82;  // 35 degrees

// The cells that a cut leaves.
std::vector<CellBlock> kept_cells(const Substructure& part, const View& view) {
  if (!view.is_cut) return part.mesh->blocks;
  std::vector<CellBlock> kept;
  for (const CellBlock& block : part.mesh->blocks) {
    CellBlock& some = kept.emplace_back(CellBlock{block.type, {}});
    const int n = nodes_per_cell(block.type);
    for (int i = 0; i < block.n_cells(); ++i) {
      Vec3 centre = Vec3::Zero();
      for (int a = 0; a < n; ++a) centre += part.mesh->nodes.col(block.cell(i)[a]) / n;
      if (view.cut.dot(centre + part.place - view.centre) <= 0.0)
        some.nodes.insert(some.nodes.end(), block.cell(i), block.cell(i) + n);
    }
  }
  return kept;
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
  std::vector<Vec3> position, reference;
  std::vector<double> value;
  for (size_t p = 0; p < parts.size(); ++p) {
    const Substructure& part = *parts[p];
    std::vector<int> number(part.mesh->n_nodes(), -1);
    for (const Facet& facet : boundary_facets(kept_cells(part, view))) {
      SkinFacet& drawn = skin.facets.emplace_back();
      for (const int node : facet.corners()) {
        if (number[node] < 0) {
          number[node] = static_cast<int>(position.size());
          const Vec3 x = part.mesh->nodes.col(node) + part.place;
          const Vec3 u = displacement.empty() ? Vec3::Zero().eval() : Vec3(displacement[p].col(node));
          reference.push_back(x);
          position.push_back(u.allFinite() ? Vec3(x + scale * u) : x);
          value.push_back(values.empty() || !std::isfinite(values[p][node]) ? 0.0 : values[p][node]);
        }
        drawn.corners[drawn.n_corners++] = number[node];
      }
      skin.part.push_back(static_cast<int>(p));
    }
  }
  const auto n = static_cast<Eigen::Index>(position.size());
  skin.position.resize(3, n);
  skin.reference.resize(3, n);
  skin.value = Eigen::Map<const Vec>(value.data(), n);
  for (Eigen::Index i = 0; i < n; ++i) {
    skin.position.col(i) = position[static_cast<size_t>(i)];
    skin.reference.col(i) = reference[static_cast<size_t>(i)];
  }
  return skin;
}

Skin merged(const Skin& skin, double size) {
  std::map<std::tuple<int, long, long, long>, int> cube;
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
        const auto key = std::tuple(skin.part[f], std::lround(place[0]), std::lround(place[1]), std::lround(place[2]));
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
