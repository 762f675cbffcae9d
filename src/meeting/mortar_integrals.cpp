#include "meeting/mortar_integrals.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include "base/parallel.hpp"
#include "base/task.hpp"
#include "meeting/facet_map.hpp"
#include "meeting/part_functions.hpp"
#include "numerics/dense.hpp"

namespace dygita {

namespace {

// Points of the unit triangle.
struct TrianglePoint {
  double r, s, weight;
};
using TriangleRule = std::vector<TrianglePoint>;

// Exact to degree 4 (Dunavant 1985): products of linear functions of facets that map linearly.
TriangleRule degree_4() {
  TriangleRule rule;
  for (const auto& [a, weight] : {std::pair{0.44594849091596488632, 0.22338158967801146570},
                                  std::pair{0.09157621350977074346, 0.10995174365532186764}})
    for (const auto& [r, s] : {std::pair{a, a}, std::pair{1 - 2 * a, a}, std::pair{a, 1 - 2 * a}})
      rule.push_back({r, s, 0.5 * weight});
  return rule;
}

// Gauss points of [0, 1].
std::vector<std::pair<double, double>> gauss(int n) {
  std::vector<std::pair<double, double>> points;
  for (int i = 0; i < n; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 1.0;
    for (int step = 0; step < 50; ++step) {
      double before = 1.0, value = x;
      for (int k = 2; k <= n; ++k) before = std::exchange(value, ((2 * k - 1) * x * value - (k - 1) * before) / k);
      slope = n * (x * value - before) / (x * x - 1);
      const double change = value / slope;
      x -= change;
      if (std::abs(change) < 1e-16) break;
    }
    points.emplace_back(0.5 * (1 + x), 1.0 / ((1 - x * x) * slope * slope));
  }
  return points;
}

// Gauss points of the square, one edge of it collapsed: what the inverse of a bilinear map needs.
TriangleRule collapsed(int n) {
  TriangleRule rule;
  for (const auto& [r, weight_r] : gauss(n))
    for (const auto& [s, weight_s] : gauss(n)) rule.push_back({r, s * (1 - r), weight_r * weight_s * (1 - r)});
  return rule;
}

const TriangleRule& rule_for(const FacetMap& one, const FacetMap& other) {
  static const TriangleRule linear = degree_4(), bilinear = collapsed(6), quadratic = collapsed(7);
  const auto has_more = [](const FacetMap& map) { return nodes_per_facet(map.type()) > 6; };
  if (has_more(one) || has_more(other)) return quadratic;
  return one.is_affine() && other.is_affine() ? linear : bilinear;
}

Points nodes_of_facet(const FaceInSpace& face, int facet) {
  const std::vector<int>& nodes = face.facets[facet];
  Points x(3, static_cast<Eigen::Index>(nodes.size()));
  for (size_t a = 0; a < nodes.size(); ++a) x.col(static_cast<Eigen::Index>(a)) = face.x.col(nodes[a]);
  return x;
}

constexpr double all_covered = 1.0 - 1e-6;  // of a part's area: covered altogether
constexpr double filled = 1.0 - 1e-6;       // of a window: as good as all

class Integrator {
 public:
  Integrator(const FaceInSpace& face, const FaceInSpace& other, const SegmentFinder& finder)
      : face_(face), other_(other), finder_(finder) {}

  std::vector<Coupling> of_facet(int facet) const {
    const FacetParts shape = facet_parts(face_.types[facet]);
    const int first = face_.first_part[facet], end = face_.first_part[facet + 1];
    std::vector<PartOfFacet> parts;
    for (int part = first; part < end; ++part) parts.push_back(part_of_facet(part));
    // Of half a facet, a function of all of it may have a negative integral, and no area for its point.
    const auto is_whole = [](const PartOfFacet& part) { return part.is_whole; };
    if (shape.has_own_multipliers && std::all_of(parts.begin(), parts.end(), is_whole))
      return {of_parts(facet, parts, {}, face_.facets[facet])};
    std::vector<Coupling> couplings;
    for (int k = 0; k < end - first; ++k) {
      const FacetPart& own = shape.parts[k];
      const PartOfFacet& part = parts[static_cast<size_t>(k)];
      const PartFunctions all(face_.types[facet], own);
      const PartFunctions covered = part.is_whole || part.segments.empty() ? all : all.within(part.corners);
      std::vector<int> points;
      for (int a = 0; a < own.n; ++a) points.push_back(face_.facets[facet][own.nodes[a]]);
      couplings.push_back(of_parts(facet, {&part, 1}, Functions{all, covered}, points));
    }
    return couplings;
  }

 private:
  // A part and what is covered of it: corners in reference coordinates of its facet.
  struct PartOfFacet {
    int index;
    Eigen::Matrix<double, 3, 2> along;
    FacetMap map;
    std::vector<Segment> segments;
    std::vector<Vec2> corners;
    bool is_whole;
  };
  // Sums over quadrature points, with lambda in place of psi.
  struct Sums {
    Vec areas, full_areas;
    Mat square;  // of lambda lambda
    Coupling with_lambda;
    double fill = 1.0;  // share of a window's function that is covered, the least of all
  };

  PartOfFacet part_of_facet(int index) const {
    const FaceInSpace::Part& part = face_.parts[index];
    const Eigen::Matrix<double, 3, 2> along = SegmentFinder::axes(part);
    PartOfFacet own{index,
                    along,
                    FacetMap(face_.types[part.facet], nodes_of_facet(face_, part.facet), part.centre, along),
                    finder_.segments(index),
                    {},
                    false};
    double covered = 0.0;
    for (const Segment& segment : own.segments) covered += segment.area;
    own.is_whole = covered >= all_covered * signed_area(outline(part, along));
    if (!own.is_whole)
      for (const Segment& segment : own.segments)
        for (const Vec2& corner : segment.region) own.corners.push_back(own.map.inverse(corner));
    return own;
  }

  static Polygon2 outline(const FaceInSpace::Part& part, const Eigen::Matrix<double, 3, 2>& along) {
    Polygon2 outline;
    for (int a = 0; a < part.x.cols(); ++a) outline.push_back(along.transpose() * (part.x.col(a) - part.centre));
    return outline;
  }

  // lambda, of the part as a whole and of what is covered of it; those of the facet itself where there are none.
  struct Functions {
    PartFunctions of_part, covered;
  };

  Coupling of_parts(int facet, std::span<const PartOfFacet> parts, const std::optional<Functions>& functions,
                    const std::vector<int>& points) const {
    const auto n = static_cast<Eigen::Index>(points.size());
    Sums sums{Vec::Zero(n), Vec::Zero(n), Mat::Zero(n, n), {}, 1.0};
    Coupling& coupling = sums.with_lambda;
    coupling.points = points;
    coupling.facet = facet;
    coupling.normals = Points::Zero(3, n);
    coupling.own = Mat::Zero(n, static_cast<Eigen::Index>(face_.facets[facet].size()));
    for (const PartOfFacet& part : parts) add_part(part, functions, sums);
    if (functions && !parts[0].is_whole && !coupling.others.empty())
      sums.fill = sums.areas.cwiseQuotient(areas_of_window(parts[0], functions->covered)).minCoeff();
    coupling.full_areas = sums.full_areas;
    coupling.areas = sums.areas;
    if (!coupling.others.empty()) make_dual(!functions, sums);
    return std::move(coupling);
  }

  static double cross(const Vec2& a, const Vec2& b) { return a[0] * b[1] - a[1] * b[0]; }

  template <typename Visit>
  static void over(const Polygon2& region, const TriangleRule& rule, Visit&& visit) {
    Vec2 middle = Vec2::Zero();
    for (const Vec2& p : region) middle += p / static_cast<double>(region.size());
    for (size_t k = 0; k < region.size(); ++k) {
      const Vec2 to_one = region[k] - middle, to_next = region[(k + 1) % region.size()] - middle;
      const double twice = cross(to_one, to_next);
      if (twice <= 0.0) continue;
      for (const TrianglePoint& at : rule) visit(middle + at.r * to_one + at.s * to_next, twice * at.weight);
    }
  }

  void add_part(const PartOfFacet& own_part, const std::optional<Functions>& functions, Sums& sums) const {
    const FaceInSpace::Part& part = face_.parts[own_part.index];
    const Eigen::Matrix<double, 3, 2>& along = own_part.along;
    const FacetMap& own = own_part.map;
    over(outline(part, along), rule_for(own, own), [&](const Vec2& p, double weight) {
      const Vec2 xi = own.inverse(p);
      sums.full_areas +=
          weight / own.normal(xi).dot(part.normal) * (functions ? functions->of_part.values(xi) : own.values(xi));
    });
    Coupling& coupling = sums.with_lambda;
    for (const Segment& segment : own_part.segments) {
      const int facet = other_.parts[segment.other].facet;
      const FacetMap map(other_.types[facet], nodes_of_facet(other_, facet), part.centre, along);
      Mat& values = values_of(facet, coupling);
      over(segment.region, rule_for(own, map), [&](const Vec2& p, double weight) {
        const Vec2 xi = own.inverse(p);
        const FacetValues shape = own.values(xi), lambda = functions ? functions->covered.values(xi) : shape;
        const Vec3 normal = own.normal(xi);
        weight /= normal.dot(part.normal);
        const FacetValues weighted = weight * lambda;
        sums.areas += weighted;
        sums.square.noalias() += weighted * lambda.transpose();
        coupling.normals.noalias() += normal * weighted.transpose();
        if (functions) coupling.own.noalias() += weighted * shape.transpose();
        values.noalias() += weighted * map.values(map.inverse(p)).transpose();
        coupling.covered += weight;
      });
    }
  }

  Mat& values_of(int facet, Coupling& coupling) const {
    for (Coupling::Other& other : coupling.others)
      if (other.facet == facet) return other.values;
    coupling.others.push_back({facet, Mat::Zero(static_cast<Eigen::Index>(coupling.points.size()),
                                                static_cast<Eigen::Index>(other_.facets[facet].size()))});
    return coupling.others.back().values;
  }

  // Integrals of its functions over all of a window.
  Vec areas_of_window(const PartOfFacet& own, const PartFunctions& window) const {
    const FaceInSpace::Part& part = face_.parts[own.index];
    const Points x = nodes_of_facet(face_, part.facet);
    Polygon2 region;
    for (const Vec2& xi : window.corners())
      region.push_back(own.along.transpose() * (x * own.map.values(xi) - part.centre));
    Vec areas = Vec::Zero(static_cast<Eigen::Index>(region.size()));
    over(region, rule_for(own.map, own.map), [&](const Vec2& p, double weight) {
      const Vec2 xi = own.map.inverse(p);
      areas += weight / own.map.normal(xi).dot(part.normal) * window.values(xi);
    });
    return areas;
  }

  // psi = D M^-1 lambda, by least squares where next to nothing is covered. Of a window that is filled in part such a
  // function grows without bound and puts its point beyond what is covered, lambda itself keeps it too far within;
  // their mean by the root of what is missing puts it about where the covered region ends.
  static void make_dual(bool has_own_functions, Sums& sums) {
    Coupling& coupling = sums.with_lambda;
    const Eigen::Index n = sums.areas.size();
    const EigenPairs eigen = symmetric_eigen(sums.square);
    Mat inverse = Mat::Zero(n, n);
    bool is_regular = true;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (eigen.values[i] > 1e-12 * eigen.values[n - 1])
        inverse += eigen.vectors.col(i) * eigen.vectors.col(i).transpose() / eigen.values[i];
      else
        is_regular = false;
    }
    Mat dual = sums.areas.asDiagonal() * inverse;
    if (sums.fill < filled) {
      const double missing = std::sqrt(1.0 - std::max(sums.fill, 0.0));
      dual = (1.0 - missing) * dual + missing * Mat::Identity(n, n);
    }
    if (!has_own_functions)
      coupling.own = dual * coupling.own;
    else
      coupling.own = is_regular ? Mat(sums.areas.asDiagonal()) : Mat(dual * sums.square);
    if (!is_regular) coupling.areas = dual * sums.areas;
    coupling.normals = coupling.normals * dual.transpose();
    for (Coupling::Other& other : coupling.others) other.values = dual * other.values;
  }

  const FaceInSpace &face_, &other_;
  const SegmentFinder& finder_;
};

}  // namespace

std::vector<Coupling> couple(const FaceInSpace& face, const FaceInSpace& other, double reach) {
  const SegmentFinder finder(face, other, reach);
  const Integrator integrator(face, other, finder);
  std::vector<std::vector<Coupling>> of_facets(face.facets.size());
  parallel_for(static_cast<int>(of_facets.size()), [&](int i) {
    heed_interrupt();
    of_facets[i] = integrator.of_facet(i);
  });
  std::vector<Coupling> couplings;
  for (std::vector<Coupling>& some : of_facets) std::move(some.begin(), some.end(), std::back_inserter(couplings));
  return couplings;
}

}  // namespace dygita
