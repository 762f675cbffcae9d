#include "meeting/true_gaps.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "meeting/facet_parts.hpp"
#include "meeting/sagitta.hpp"
#include "meeting/segments.hpp"
#include "mesh/box_grid.hpp"

namespace dygita {

namespace {

constexpr double of_height = 0.3;  // how well the height of a surface over a facet is known as a rule, of the height
constexpr double of_mean_height = 0.1;   // and its mean over many facets; over a single triangle it may be off by all
constexpr double no_gap_of_size = 5e-4;  // of a facet: what is no gap
constexpr double least_told = 0.02;      // of the area
constexpr double least_facing = 0.8;     // cosine between a normal and the opposite of the other
constexpr double even = 1e-4;            // of a facet's area: neighbours in one line tell no curvature across it

using Mat2 = Eigen::Matrix2d;

// The parts around a node, on average.
struct AroundNode {
  double area = 0.0;
  Vec3 normal = Vec3::Zero(), centre = Vec3::Zero();
  Mat3 turn = Mat3::Zero(), spread = Mat3::Zero();  // of normals over centres, and of centres, about their means

  void add(const FaceInSpace::Part& part) {
    area += part.area;
    normal += part.area * part.normal;
    centre += part.area * part.centre;
    turn += part.area * part.normal * part.centre.transpose();
    spread += part.area * part.centre * part.centre.transpose();
  }
  void finish() {
    if (area == 0.0) return;  // a middle node that no part has
    normal /= area;
    centre /= area;
    turn = turn / area - normal * centre.transpose();
    spread = spread / area - centre * centre.transpose();
    normal.normalize();
  }
  // 1/m, along a direction; none where the parts lie beside each other across it.
  std::optional<double> curvature(const Vec3& along, double size) const {
    const double width = along.dot(spread * along);
    if (width < even * size * size) return {};
    return along.dot(turn * along) / width;
  }
};

// A smooth surface, and how it rises over each part of its facets.
class RoundPatch {
 public:
  explicit RoundPatch(const PlacedFace& placed)
      : face(placed), curvatures_(face.parts.size()), rims_(face.parts.size()), unsure_(face.parts.size(), 0.0) {
    std::vector<AroundNode> nodes(static_cast<size_t>(face.x.cols()));
    for (const FaceInSpace::Part& part : face.parts)
      for (const int node : corners_of(part)) nodes[static_cast<size_t>(node)].add(part);
    for (AroundNode& node : nodes) node.finish();
    for (Eigen::Index i = 0; i < face.x.cols(); ++i) box.add(face.x.col(i));
    for (size_t p = 0; p < face.parts.size(); ++p) fit(p, nodes);
  }

  // m, of the surface over the part's plane at x in it.
  double height(size_t p, const Vec3& x) const { return rims_[p] - rise(p, x); }
  // The same at its centre.
  double most_height(size_t p) const { return std::abs(rims_[p]); }
  // The same where it is not known whether the part is flat, beside a round surface, or round.
  double unsure_height(size_t p) const { return unsure_[p]; }

  FaceInSpace face;
  Box box;

 private:
  std::vector<int> corners_of(const FaceInSpace::Part& part) const {
    const FacetPart& shape =
        facet_parts(face.types[static_cast<size_t>(part.facet)]).parts[static_cast<size_t>(part.k)];
    std::vector<int> corners;
    for (int a = 0; a < shape.n; ++a)
      corners.push_back(face.facets[static_cast<size_t>(part.facet)][static_cast<size_t>(shape.nodes[a])]);
    return corners;
  }

  // The change of the normal over the plane of the part, by least squares. Normals are those at the centres of the
  // parts around a node, which at the rim of the face is not the node.
  void fit(size_t p, const std::vector<AroundNode>& nodes) {
    const FaceInSpace::Part& part = face.parts[p];
    const std::vector<int> corners = corners_of(part);
    const Eigen::Matrix<double, 3, 2> along = SegmentFinder::axes(part);
    Vec3 mean_normal = Vec3::Zero(), mean_centre = Vec3::Zero();
    for (const int node : corners) {
      mean_normal += nodes[static_cast<size_t>(node)].normal / static_cast<double>(corners.size());
      mean_centre += nodes[static_cast<size_t>(node)].centre / static_cast<double>(corners.size());
    }
    Mat2 turn = Mat2::Zero(), spread = Mat2::Zero();
    for (const int node : corners) {
      const AroundNode& around = nodes[static_cast<size_t>(node)];
      const Eigen::Vector2d away = along.transpose() * (around.centre - mean_centre);
      turn += along.transpose() * (around.normal - mean_normal) * away.transpose();
      spread += away * away.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Mat2> eigen(spread);
    Mat2 inverse = Mat2::Zero();
    for (int i = 0; i < 2; ++i)
      if (eigen.eigenvalues()[i] > even * part.area)
        inverse += eigen.eigenvectors().col(i) * eigen.eigenvectors().col(i).transpose() / eigen.eigenvalues()[i];
    const Mat2 slope = turn * inverse;
    curvatures_[p] = 0.5 * (slope + slope.transpose());
    rims_[p] = 0.0;
    for (const int node : corners) rims_[p] += rise(p, face.x.col(node)) / static_cast<double>(corners.size());
    if (is_bent_alike(p, corners, nodes)) return;
    unsure_[p] = std::abs(rims_[p]);
    curvatures_[p].setZero();
    rims_[p] = 0.0;
  }

  // A flat part beside a round one is bent at one side alone.
  bool is_bent_alike(size_t p, const std::vector<int>& corners, const std::vector<AroundNode>& nodes) const {
    constexpr double less = 0.35;
    const FaceInSpace::Part& part = face.parts[p];
    const Eigen::SelfAdjointEigenSolver<Mat2> eigen(curvatures_[p]);
    const int most = std::abs(eigen.eigenvalues()[0]) > std::abs(eigen.eigenvalues()[1]) ? 0 : 1;
    const double bent = eigen.eigenvalues()[most];
    const Vec3 along = SegmentFinder::axes(part) * eigen.eigenvectors().col(most);
    return std::all_of(corners.begin(), corners.end(), [&](int node) {
      const std::optional<double> there = nodes[static_cast<size_t>(node)].curvature(along, std::sqrt(part.area));
      return !there || *there * bent >= less * bent * bent;
    });
  }

  double rise(size_t p, const Vec3& x) const {
    const FaceInSpace::Part& part = face.parts[p];
    const Eigen::Vector2d away = SegmentFinder::axes(part).transpose() * (x - part.centre);
    return 0.5 * away.dot(curvatures_[p] * away);
  }

  std::vector<Mat2> curvatures_;  // 1/m
  std::vector<double> rims_;      // m, the rise at the corners
  std::vector<double> unsure_;    // m
};

// What one part has in common with the other face, area by area.
struct GapSums {
  double area = 0.0, apart = 0.0, into = 0.0, touching = 0.0, moment = 0.0, heights = 0.0, others = 0.0, bend = 0.0;
  double least = 1e300, most = -1e300;

  void add(const GapSums& other) {
    area += other.area;
    apart += other.apart;
    into += other.into;
    touching += other.touching;
    moment += other.moment;
    heights += other.heights;
    others += other.others;
    bend = std::max(bend, other.bend);
    least = std::min(least, other.least);
    most = std::max(most, other.most);
  }
};

// Where the sides of a region are cut in halves, each piece counts with its middle.
template <typename Visit>
void for_each_piece(const Polygon2& region, Visit visit) {
  Vec2 middle = Vec2::Zero();
  for (const Vec2& corner : region) middle += corner / static_cast<double>(region.size());
  const auto offer = [&](const Vec2& a, const Vec2& b, const Vec2& c) {
    const Vec2 u = b - a, v = c - a;
    visit(Vec2((a + b + c) / 3.0), 0.5 * std::abs(u[0] * v[1] - u[1] * v[0]));
  };
  for (size_t i = 0; i < region.size(); ++i) {
    const Vec2 &from = region[i], &to = region[(i + 1) % region.size()];
    const Vec2 a = 0.5 * (middle + from), b = 0.5 * (from + to), c = 0.5 * (to + middle);
    offer(middle, a, c);
    offer(a, from, b);
    offer(c, b, to);
    offer(a, b, c);
  }
}

GapSums sums_of(const RoundPatch& one, const RoundPatch& other, const SegmentFinder& finder, int p) {
  GapSums sums;
  const FaceInSpace::Part& part = one.face.parts[static_cast<size_t>(p)];
  const Eigen::Matrix<double, 3, 2> along = SegmentFinder::axes(part);
  for (const Segment& segment : finder.segments(p)) {
    const auto o = static_cast<size_t>(segment.other);
    const FaceInSpace::Part& opposite = other.face.parts[o];
    const double cosine = -part.normal.dot(opposite.normal);
    if (cosine < least_facing) continue;
    const double bend = one.most_height(static_cast<size_t>(p)) + other.most_height(o),
                 unsure = one.unsure_height(static_cast<size_t>(p)) + other.unsure_height(o),
                 size = std::sqrt(std::min(part.area, opposite.area)), most_doubt = bend + unsure,
                 slight = no_gap_of_size * size;
    const auto gap_at = [&](const Vec2& at) {
      const Vec3 x = part.centre + along * at;
      const double between = -opposite.normal.dot(opposite.centre - x) / cosine;
      return between - one.height(static_cast<size_t>(p), x) - other.height(o, x + between * part.normal);
    };
    for_each_piece(segment.region, [&](const Vec2& at, double area) {
      const double gap = gap_at(at);
      sums.area += area;
      sums.moment += area * gap;
      (gap > 0.0 ? sums.apart : sums.into) += std::abs(gap) > most_doubt + slight ? area : 0.0;
      sums.touching += std::abs(gap) <= of_height * bend + unsure + slight ? area : 0.0;
      sums.heights += area * bend;
      sums.others += area * (unsure + slight);
    });
    for (const Vec2& corner : segment.region) {
      const double gap = gap_at(corner);
      sums.least = std::min(sums.least, gap + most_doubt);
      sums.most = std::max(sums.most, gap - most_doubt);
    }
    sums.bend = std::max(sums.bend, bend + unsure);
  }
  return sums;
}

std::vector<RoundPatch> patches_of_face(const PlacedFace& face) {
  std::vector<RoundPatch> patches;
  for (const PlacedFace& part : smooth_parts(face)) patches.emplace_back(part);
  return patches;
}

}  // namespace

bool TrueGaps::is_told() const {
  return area > 0.0 && (std::abs(mean) > mean_doubt || apart + into > least_told * area);
}

TrueGaps true_gaps(const PlacedFace& side_1, const PlacedFace& side_2, double within) {
  const std::vector<RoundPatch> patches_1 = patches_of_face(side_1), patches_2 = patches_of_face(side_2);
  const double reach = within + sagitta_margin * (FaceInSpace(side_1).sagitta() + FaceInSpace(side_2).sagitta());
  GapSums all;
  for (const RoundPatch& one : patches_1)
    for (const RoundPatch& other : patches_2) {
      if (!one.box.grown(reach).meets(other.box)) continue;
      const SegmentFinder finder(one.face, other.face, reach);
      std::vector<GapSums> of_part(one.face.parts.size());
      parallel_for(static_cast<int>(of_part.size()),
                   [&](int p) { of_part[static_cast<size_t>(p)] = sums_of(one, other, finder, p); });
      for (const GapSums& sums : of_part) all.add(sums);
    }
  TrueGaps gaps;
  if (all.area == 0.0) return gaps;
  gaps.area = all.area;
  gaps.apart = all.apart;
  gaps.into = all.into;
  gaps.touching = all.touching;
  gaps.mean = all.moment / all.area;
  gaps.least = std::min(gaps.mean, all.least);
  gaps.most = std::max(gaps.mean, all.most);
  gaps.mean_doubt = (of_mean_height * all.heights + all.others) / all.area;
  gaps.bend = all.bend;
  return gaps;
}

}  // namespace dygita
