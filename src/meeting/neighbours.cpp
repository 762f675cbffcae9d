#include "meeting/neighbours.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "base/task.hpp"
#include "meeting/overlap.hpp"
#include "meeting/sagitta.hpp"
#include "meeting/true_gaps.hpp"
#include "mesh/face_nodes.hpp"

namespace dygita {

namespace {

constexpr size_t most_depths = 400;  // points whose depth is measured
constexpr int samples_along = 40;    // of a volume in common

// The place on a triangle that is nearest to x, as weights of its corners (Ericson 2005, section 5.1.5).
Vec3 nearest_weights(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = x - a, bp = x - b, cp = x - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - w, w};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

// The surface of a body within a box.
struct SurfaceInBox {
  const PlacedBody& body;
  std::vector<CellBlock> cells;  // that meet the box
  std::vector<Facet> facets;     // of the body's boundary that meet it
  std::vector<Box> boxes;        // of the facets
  std::vector<Vec3> normals;     // unit, of the facets
  std::vector<double> sizes;     // m, square root of the facets' area
  std::vector<double> sagittas;  // m, how far the facets may be off the round face that they stand for

  SurfaceInBox(const PlacedBody& of, const Box& box) : body(of) {
    for (const CellBlock& block : body.mesh->blocks) {
      CellBlock kept{block.type, {}};
      const int n = nodes_per_cell(block.type);
      for (int i = 0; i < block.n_cells(); ++i) {
        Box extent;
        for (int a = 0; a < n; ++a) extent.add(body.at(block.cell(i)[a]));
        if (extent.meets(box)) kept.nodes.insert(kept.nodes.end(), block.cell(i), block.cell(i) + n);
      }
      if (!kept.nodes.empty()) cells.push_back(std::move(kept));
    }
    // A facet that meets the box belongs to kept cells only, so that those alone tell the boundary.
    for (const Facet& facet : body.mesh->has_cells() ? boundary_facets(cells) : boundary_facets(*body.mesh)) {
      Box extent;
      for (const int node : facet.nodes()) extent.add(body.at(node));
      if (!extent.meets(box)) continue;
      const Vec3 area = facet_area_vector(body.mesh->nodes, facet);
      facets.push_back(facet);
      boxes.push_back(extent);
      normals.push_back(area.normalized());
      sizes.push_back(std::sqrt(area.norm()));
    }
    find_sagittas();
  }

  void find_sagittas() {
    sagittas.assign(facets.size(), 0.0);
    std::map<std::pair<int, int>, size_t> known;
    for (size_t f = 0; f < facets.size(); ++f) {
      const std::span<const int> corners = facets[f].corners();
      for (size_t a = 0; a < corners.size(); ++a) {
        const int i = corners[a], j = corners[(a + 1) % corners.size()];
        const auto [at, is_new] = known.try_emplace(std::minmax(i, j), f);
        if (is_new) continue;
        const Polygon one = polygon(facets[f]), other = polygon(facets[at->second]);
        const double sagitta =
            sagitta_margin * sagitta_of({one, one.rowwise().mean(), normals[f]},
                                        {other, other.rowwise().mean(), normals[at->second]}, body.at(i), body.at(j));
        for (double* known_sagitta : {&sagittas[f], &sagittas[at->second]})
          *known_sagitta = std::max(*known_sagitta, sagitta);
      }
    }
  }

  bool is_joined(size_t i) const { return body.joined.contains(facet_key(facets[i])); }
  bool is_used_up(size_t i) const { return is_joined(i) && !body.reused.contains(facet_key(facets[i])); }
  double mean_size() const {
    double sum = 0.0;
    for (const double size : sizes) sum += size;
    return sum / static_cast<double>(std::max<size_t>(1, sizes.size()));
  }
  Polygon polygon(const Facet& facet) const {
    Polygon corners(3, facet.corners().size());
    for (size_t a = 0; a < facet.corners().size(); ++a) corners.col(static_cast<long>(a)) = body.at(facet.corners()[a]);
    return corners;
  }
  Vec3 middle(const Facet& facet) const { return polygon(facet).rowwise().mean(); }
};

// Where on a facet is nearest to x: weights of its corners.
struct Nearest {
  std::array<double, most_facet_nodes> weights{};
  Vec3 place;
  double distance = 1e300;
};

Nearest nearest_on(const SurfaceInBox& surface, const Facet& facet, const Vec3& x) {
  const std::span<const int> corners = facet.corners();
  Nearest best;
  for (size_t a = 1; a + 1 < corners.size(); ++a) {
    const Vec3 p = surface.body.at(corners[0]), q = surface.body.at(corners[a]), r = surface.body.at(corners[a + 1]);
    const Vec3 w = nearest_weights(x, p, q, r), place = w[0] * p + w[1] * q + w[2] * r;
    const double distance = (x - place).norm();
    if (distance >= best.distance) continue;
    best.weights.fill(0.0);
    best.weights[0] = w[0];
    best.weights[a] = w[1];
    best.weights[a + 1] = w[2];
    best.place = place;
    best.distance = distance;
  }
  return best;
}

// Do the surfaces touch that the facets stand for, as chords of which they may cross?
bool touch_as_round(const SurfaceInBox& a, const SurfaceInBox& b) {
  constexpr double of_size = 1e-3, least_touching = 0.02;
  const auto face_of = [](const SurfaceInBox& surface) {
    PlacedFace face{surface.body.mesh, {}, surface.body.place, ""};
    for (size_t i = 0; i < surface.facets.size(); ++i)
      if (!surface.is_used_up(i)) face.facets.push_back(surface.facets[i]);
    return face;
  };
  const TrueGaps gaps = true_gaps(face_of(a), face_of(b), of_size * std::min(a.mean_size(), b.mean_size()));
  return gaps.touching > least_touching * gaps.area;
}

std::optional<Touch> find_touch(const SurfaceInBox& a, const SurfaceInBox& b) {
  std::vector<Polygon> polygons[2];
  std::vector<size_t> index[2];
  for (int side = 0; side < 2; ++side) {
    const SurfaceInBox& surface = side == 0 ? a : b;
    for (size_t i = 0; i < surface.facets.size(); ++i) {
      if (surface.is_used_up(i)) continue;
      polygons[side].push_back(surface.polygon(surface.facets[i]));
      index[side].push_back(i);
    }
  }
  const std::optional<Overlap> overlap = find_overlap(polygons[0], polygons[1], Facings::opposed);
  if (!overlap || !touch_as_round(a, b)) return std::nullopt;
  return Touch{overlap->area, overlap->place, a.facets[index[0][static_cast<size_t>(overlap->first_1)]],
               b.facets[index[1][static_cast<size_t>(overlap->first_2)]]};
}

// Cells as what lies behind the planes of their facets.
class Inside {
 public:
  explicit Inside(const SurfaceInBox& surface) : surface_(surface) {
    for (const CellBlock& block : surface.cells)
      for (int i = 0; i < block.n_cells(); ++i) {
        Box& box = boxes_.emplace_back();
        for (int a = 0; a < nodes_per_cell(block.type); ++a) box.add(surface.body.at(block.cell(i)[a]));
        cells_.emplace_back(&block, i);
        size_ += box.size().maxCoeff();
      }
    size_ /= static_cast<double>(std::max<size_t>(1, cells_.size()));
    if (!cells_.empty()) grid_.emplace(boxes_, size_);
  }

  bool has(const Vec3& x) {
    bool found = false;
    if (grid_)
      grid_->for_each_meeting({x, x}, [&](int i) { found = found || is_in(cells_[static_cast<size_t>(i)], x); });
    return found;
  }

 private:
  bool is_in(const std::pair<const CellBlock*, int>& cell, const Vec3& x) const {
    for (int k = 0; k < facets_per_cell(cell.first->type); ++k) {
      const Facet facet = facet_of_cell(*cell.first, cell.second, k);
      const Vec3 normal = facet_area_vector(surface_.body.mesh->nodes, facet).normalized();
      if (normal.dot(x - surface_.middle(facet)) > 1e-9 * size_) return false;
    }
    return true;
  }

  const SurfaceInBox& surface_;
  std::vector<Box> boxes_;
  std::vector<std::pair<const CellBlock*, int>> cells_;
  std::optional<BoxGrid> grid_;
  double size_ = 0.0;
};

struct Probe {
  Vec3 x, normal;
  double sagitta;  // m, of its facet
};

// Points of a facet: its corners and its middle, a little inwards so that an edge on an edge is not inside.
void add_probes(const SurfaceInBox& surface, size_t i, std::vector<Probe>& probes) {
  const Polygon corners = surface.polygon(surface.facets[i]);
  const Vec3 middle = corners.rowwise().mean();
  const double sagitta = surface.sagittas[i];
  probes.push_back({middle, surface.normals[i], sagitta});
  for (long a = 0; a < corners.cols(); ++a)
    probes.push_back({0.9 * corners.col(a) + 0.1 * middle, surface.normals[i], sagitta});
}

// Adds what of `a`'s surface lies in `b`; `whole`: how deep what lies in it far from its surface is at least.
void find_intrusion(const SurfaceInBox& a, const SurfaceInBox& b, double whole, std::optional<Intrusion>& deepest) {
  std::vector<Probe> probes, inside;
  for (size_t i = 0; i < a.facets.size(); ++i) add_probes(a, i, probes);
  Inside body(b);
  for (const Probe& probe : probes)
    if (body.has(probe.x)) inside.push_back(probe);
  const size_t stride = std::max<size_t>(1, inside.size() / most_depths);
  for (size_t p = 0; p < inside.size(); p += stride) {
    const auto& [x, normal, sagitta] = inside[p];
    double depth = 1e300, allowed = 0.0;
    for (size_t i = 0; i < b.facets.size(); ++i) {
      if ((x - b.boxes[i].low.cwiseMax(x.cwiseMin(b.boxes[i].high))).norm() >= depth) continue;
      const double distance = nearest_on(b, b.facets[i], x).distance;
      if (distance >= depth) continue;
      depth = distance;
      allowed = b.sizes[i] * (1e-3 + 0.5 * normal.cross(b.normals[i]).norm()) + sagitta + b.sagittas[i];
    }
    if (b.facets.empty()) depth = whole;
    if (depth <= allowed) continue;
    if (!deepest) deepest = Intrusion{0.0, x, {}, 0.0};
    deepest->extent.add(x);
    if (depth <= (1.0 + 1e-9) * deepest->depth) continue;  // of equal ones the first, whatever their last digits
    deepest->depth = depth;
    deepest->place = x;
  }
}

// What two bodies have in common within a box, by points on a regular grid.
double volume_in_common(const SurfaceInBox& a, const SurfaceInBox& b, const Box& box) {
  Inside in_a(a), in_b(b);
  const Vec3 step = box.size() / samples_along;
  long n = 0;
  for (int k = 0; k < samples_along; ++k)
    for (int j = 0; j < samples_along; ++j)
      for (int i = 0; i < samples_along; ++i) {
        const Vec3 x = box.low + Vec3(i + 0.5, j + 0.5, k + 0.5).cwiseProduct(step);
        n += in_a.has(x) && in_b.has(x) ? 1 : 0;
      }
  return static_cast<double>(n) * step.prod();
}

std::vector<NearNode> find_near_nodes(const SurfaceInBox& a, const SurfaceInBox& b, double reach) {
  std::vector<NearNode> near;
  if (b.facets.empty()) return near;
  BoxGrid grid(b.boxes, b.mean_size() + reach);
  std::vector<char> is_joined;
  for (size_t j = 0; j < b.facets.size(); ++j) is_joined.push_back(b.is_joined(j) ? 1 : 0);
  std::unordered_set<int> seen;
  for (size_t i = 0; i < a.facets.size(); ++i) {
    heed_interrupt();
    if (a.is_joined(i)) continue;
    for (const int node : a.facets[i].corners()) {
      if (a.body.joined_nodes.contains(node)) continue;
      const Vec3 x = a.body.at(node);
      std::optional<NearNode> best;
      grid.for_each_meeting(Box{x, x}.grown(reach), [&](int k) {
        const auto j = static_cast<size_t>(k);
        if (is_joined[j] || a.normals[i].dot(b.normals[j]) > -0.5) return;
        const Nearest nearest = nearest_on(b, b.facets[j], x);
        const Vec3 apart = x - nearest.place;
        const double gap = apart.dot(b.normals[j]);
        const double beside = (apart - gap * b.normals[j]).norm();
        if (gap > reach || gap < -0.1 * b.sizes[j] || beside > 1e-6 * b.sizes[j] || (best && gap >= best->gap)) return;
        best = NearNode{node, b.facets[j], nearest.weights, b.normals[j], std::max(gap, 0.0)};
      });
      if (best && seen.insert(node).second) near.push_back(*best);
    }
  }
  return near;
}

}  // namespace

Box PlacedBody::box() const {
  if (mesh->nodes.cols() == 0) return {};
  return {mesh->nodes.rowwise().minCoeff() + place, mesh->nodes.rowwise().maxCoeff() + place};
}

Neighbours find_neighbours(const PlacedBody& body_1, const PlacedBody& body_2, double reach) {
  Neighbours found;
  const Box box_1 = body_1.box(), box_2 = body_2.box();
  const Box common = box_1.grown(reach).common(box_2.grown(reach));
  if (common.is_empty()) return found;
  const SurfaceInBox surface_1(body_1, common), surface_2(body_2, common);
  found.touch = find_touch(surface_1, surface_2);
  const Box exact = box_1.common(box_2);
  if (!exact.is_empty() && exact.size().minCoeff() > 1e-6 * std::min(surface_1.mean_size(), surface_2.mean_size())) {
    find_intrusion(surface_1, surface_2, exact.size().minCoeff(), found.intrusion);
    find_intrusion(surface_2, surface_1, exact.size().minCoeff(), found.intrusion);
    if (found.intrusion)
      found.intrusion->volume = volume_in_common(
          surface_1, surface_2,
          found.intrusion->extent.grown(std::max(surface_1.mean_size(), surface_2.mean_size())).common(exact));
  }
  found.nodes_1 = find_near_nodes(surface_1, surface_2, reach);
  found.nodes_2 = find_near_nodes(surface_2, surface_1, reach);
  return found;
}

}  // namespace dygita
