#include "mesh/unmatched_cells.hpp"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/union_find.hpp"
#include "mesh/box_grid.hpp"
#include "mesh/jacobian.hpp"
#include "mesh/polygons.hpp"

namespace dygita {

namespace {

// A facet as one of its cells has it.
struct CellFacet {
  const CellBlock* block;
  int cell, k;

  Facet facet() const { return facet_of_cell(*block, cell, k); }
  std::string name() const { return fmt::format("{} ({})", cell, cell_shape(block->type).name); }
};

// Does the second have the corners of the first in the same direction around?
bool goes_the_same_way(const Facet& one, const Facet& other) {
  const std::span<const int> a = one.corners(), b = other.corners();
  const auto at = std::find(b.begin(), b.end(), a[0]);
  const size_t next = (static_cast<size_t>(at - b.begin()) + 1) % b.size();
  return b[next] != a.back();
}

std::vector<int> sorted(std::span<const int> nodes) {
  std::vector<int> all(nodes.begin(), nodes.end());
  std::sort(all.begin(), all.end());
  return all;
}

// Pairs of cells that do not fit at a facet, by what is wrong.
struct Misfits {
  std::set<std::pair<const CellBlock*, int>> repeated;  // cells that stand once more
  std::optional<std::pair<CellFacet, CellFacet>> first_repeated, first_overlap, first_unlike;
  int n_overlaps = 0, n_unlike = 0;

  void add(const CellFacet& before, const CellFacet& own) {
    const Facet one = before.facet(), other = own.facet();
    const bool is_same_way = goes_the_same_way(one, other);
    const auto nodes = [](const CellFacet& of) {
      return sorted({of.block->cell(of.cell), static_cast<size_t>(nodes_per_cell(of.block->type))});
    };
    const auto note = [&](std::optional<std::pair<CellFacet, CellFacet>>& first) {
      if (!first) first.emplace(before, own);
    };
    if (is_same_way && before.block->type == own.block->type && nodes(before) == nodes(own)) {
      repeated.emplace(own.block, own.cell);
      note(first_repeated);
    } else if (is_same_way) {
      ++n_overlaps;
      note(first_overlap);
    } else if (one.type() != other.type() || sorted(one.nodes()) != sorted(other.nodes())) {
      ++n_unlike;
      note(first_unlike);
    }
  }
};

// Facets are looked for among those that have the same highest corner.
Misfits find_misfits(const Mesh& mesh) {
  std::vector<CellFacet> facets;
  std::vector<FacetKey> keys;
  std::vector<int> last(static_cast<size_t>(mesh.n_nodes()), -1), before;
  Misfits misfits;
  for (const CellBlock& block : mesh.blocks)
    for (int i = 0; i < block.n_cells(); ++i)
      for (int k = 0; k < facets_per_cell(block.type); ++k) {
        const CellFacet own{&block, i, k};
        const FacetKey key = facet_key(own.facet());
        int& chain = last[static_cast<size_t>(key.back())];
        for (int same = chain; same >= 0; same = before[static_cast<size_t>(same)])
          if (keys[static_cast<size_t>(same)] == key) misfits.add(facets[static_cast<size_t>(same)], own);
        before.push_back(chain);
        chain = static_cast<int>(keys.size());
        keys.push_back(key);
        facets.push_back(own);
      }
  return misfits;
}

std::string middle_text(const Vec3& x) { return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", x[0], x[1], x[2]); }

std::string more(int n, const char* what) { return n > 1 ? fmt::format(" ({} {} in all)", n, what) : std::string(); }

// The boundary of a mesh, each facet by its corners.
struct BoundaryPolygons {
  static constexpr double level = 1e-4;  // of a facet's size, off its plane
  std::vector<Facet> facets;
  std::vector<Polygon> polygons;
  std::vector<Vec3> normals, middles;
  std::vector<double> areas;
  std::vector<Box> boxes;

  BoundaryPolygons(const Mesh& mesh, const FacetKeys& joined) {
    for (const Facet& facet : boundary_facets(mesh.blocks)) {
      if (joined.contains(facet_key(facet))) continue;
      Polygon x(3, facet.corners().size());
      for (size_t a = 0; a < facet.corners().size(); ++a)
        x.col(static_cast<long>(a)) = mesh.nodes.col(facet.corners()[a]);
      const Vec3 area = area_vector(x);
      facets.push_back(facet);
      normals.push_back(area.normalized());
      areas.push_back(area.norm());
      middles.push_back(x.rowwise().mean());
      boxes.push_back({x.rowwise().minCoeff(), x.rowwise().maxCoeff()});
      polygons.push_back(std::move(x));
    }
  }

  // Where what lies on facet i meets it.
  Box around(size_t i) const { return boxes[i].grown(2.0 * level * std::sqrt(areas[i])); }

  // m^2, that facets i and j have in common where they lie on each other.
  double common_area(size_t i, size_t j) const {
    constexpr double on_the_spot = 1e-7, parallel = 1e-3, least = 1e-3, opposed_enough = -0.8;
    const double smaller = std::min(areas[i], areas[j]), size = std::sqrt(smaller);
    if (smaller == 0.0 || !boxes[i].grown(level * size).meets(boxes[j])) return 0.0;
    const double cosine = normals[i].dot(normals[j]), sine = normals[i].cross(normals[j]).norm();
    int n_shared = 0;
    for (const int node : facets[i].corners())
      n_shared += std::count(facets[j].corners().begin(), facets[j].corners().end(), node) > 0 ? 1 : 0;
    // Triangles on a quadrangle that is not plane share its corners. Others are beside each other on one plane, or the
    // two sides of an edge as thin as a blade.
    const bool is_divided = n_shared > 2 && cosine < opposed_enough;
    if (!is_divided && (sine > parallel || (cosine > 0.0 && n_shared > 0))) return 0.0;
    const double apart = std::abs(normals[i].dot(middles[j] - middles[i]));
    if (!is_divided && apart > (n_shared > 1 ? on_the_spot : level) * size) return 0.0;
    const Vec3 u = normals[i].unitOrthogonal(), v = normals[i].cross(u);
    const auto project = [&](const Polygon& x) {
      Polygon2 polygon;
      for (int a = 0; a < x.cols(); ++a)
        polygon.emplace_back(u.dot(x.col(a) - middles[i]), v.dot(x.col(a) - middles[i]));
      if (signed_area(polygon) < 0) std::reverse(polygon.begin(), polygon.end());
      return polygon;
    };
    const Polygon2 region = clip(project(polygons[i]), project(polygons[j]));
    const double area = region.size() < 3 ? 0.0 : signed_area(region);
    return area > least * smaller ? area : 0.0;
  }
};

}  // namespace

void check_shared_facets(const Mesh& mesh, const std::string& name) {
  const Misfits misfits = find_misfits(mesh);
  const auto middle = [&](const CellFacet& of) {
    return middle_text(cell_nodes(mesh.nodes, *of.block, of.cell).rowwise().mean());
  };
  if (const auto& first = misfits.first_repeated)
    throw InputError(
        fmt::format("mesh of '{}': cell {} at {} repeats cell {}{}\n    a repeated cell counts its mass and stiffness "
                    "twice: list each cell once",
                    name, first->second.name(), middle(first->second), first->first.name(),
                    more(static_cast<int>(misfits.repeated.size()), "such cells")));
  if (const auto& first = misfits.first_overlap)
    throw InputError(
        fmt::format("mesh of '{}': cells {} and {}, around {}, lie on the same side of the facet that they share: they "
                    "overlap{}\n    cells must not overlap; two meshes of one body need two volumes",
                    name, first->first.name(), first->second.name(), middle(first->second),
                    more(misfits.n_overlaps, "such facets")));
  if (const auto& first = misfits.first_unlike)
    throw InputError(fmt::format(
        "mesh of '{}': cells {} and {}, around {}, share the corners of a facet but not its other nodes: they separate "
        "between the corners{}\n    adjacent cells of one volume must have the same order; two "
        "volumes with interface.bonded between them may differ",
        name, first->first.name(), first->second.name(), middle(first->second), more(misfits.n_unlike, "such facets")));
}

std::optional<Seam> find_seam(const Mesh& mesh, const FacetKeys& joined) {
  const BoundaryPolygons boundary(mesh, joined);
  if (boundary.facets.empty()) return {};
  const PolygonGrid grid(boundary.polygons, mean_diameter(boundary.polygons));
  struct Found {
    double area = 0.0;
    int n = 0, first = -1;
  };
  std::vector<Found> found(boundary.facets.size());
  parallel_for(static_cast<int>(found.size()), [&](int j) {
    std::vector<int> near;
    const Box within = boundary.around(static_cast<size_t>(j));
    grid.for_each_near(boundary.polygons[static_cast<size_t>(j)], [&](int i) {
      if (i < j && within.meets(boundary.boxes[static_cast<size_t>(i)])) near.push_back(i);
    });
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    Found& own = found[static_cast<size_t>(j)];
    for (const int i : near) {
      const double area = boundary.common_area(static_cast<size_t>(i), static_cast<size_t>(j));
      if (area == 0.0) continue;
      own.area += area;
      if (own.n++ == 0) own.first = i;
    }
  });
  std::optional<Seam> seam;
  for (size_t j = 0; j < found.size(); ++j) {
    if (found[j].n == 0) continue;
    const auto i = static_cast<size_t>(found[j].first);
    if (!seam)
      seam = Seam{0.0,
                  0,
                  boundary.areas[i] < boundary.areas[j] ? boundary.middles[i] : boundary.middles[j],
                  boundary.facets[i],
                  boundary.facets[j],
                  boundary.normals[i].dot(boundary.normals[j]) > 0.0};
    seam->area += found[j].area;
    seam->n_facets += found[j].n;
  }
  return seam;
}

std::string cell_with(const Mesh& mesh, const Facet& facet) {
  const FacetKey key = facet_key(facet);
  for (const CellBlock& block : mesh.blocks)
    for (int i = 0; i < block.n_cells(); ++i)
      for (int k = 0; k < facets_per_cell(block.type); ++k)
        if (facet_key(facet_of_cell(block, i, k)) == key) return "cell " + CellFacet{&block, i, k}.name();
  return "no cell";
}

std::vector<LoosePiece> loose_pieces(const Mesh& mesh) {
  UnionFind sets(mesh.n_nodes());
  for (const CellBlock& block : mesh.blocks)
    for (int i = 0; i < block.n_cells(); ++i)
      for (int a = 1; a < nodes_per_cell(block.type); ++a) sets.join(block.cell(i)[0], block.cell(i)[a]);
  if (sets.n_sets() < 2) return {};
  std::vector<int> piece_of(static_cast<size_t>(mesh.n_nodes())), own_number(piece_of.size());
  std::map<int, int> number_of_root;
  std::vector<LoosePiece> pieces;
  for (int node = 0; node < mesh.n_nodes(); ++node) {
    const auto [known, is_new] = number_of_root.try_emplace(sets.root(node), static_cast<int>(pieces.size()));
    if (is_new) pieces.emplace_back();
    LoosePiece& piece = pieces[static_cast<size_t>(known->second)];
    piece_of[static_cast<size_t>(node)] = known->second;
    own_number[static_cast<size_t>(node)] = static_cast<int>(piece.nodes.size());
    piece.nodes.push_back(node);
  }
  for (LoosePiece& piece : pieces) {
    piece.mesh.nodes = mesh.nodes(Eigen::all, piece.nodes);
    for (const CellBlock& block : mesh.blocks) piece.mesh.blocks.push_back({block.type, {}});
  }
  for (size_t b = 0; b < mesh.blocks.size(); ++b)
    for (int i = 0; i < mesh.blocks[b].n_cells(); ++i) {
      const int *cell = mesh.blocks[b].cell(i), n = nodes_per_cell(mesh.blocks[b].type);
      std::vector<int>& own = pieces[static_cast<size_t>(piece_of[static_cast<size_t>(cell[0])])].mesh.blocks[b].nodes;
      for (int a = 0; a < n; ++a) own.push_back(own_number[static_cast<size_t>(cell[a])]);
    }
  return pieces;
}

}  // namespace dygita
