// Two faces in space seen from each other: their facets cut into convex linear parts, and the regions that a part of
// one and a part of the other have in common (manual, non-matching meshes).
#pragma once

#include "meeting/facing.hpp"
#include "mesh/polygons.hpp"

namespace dygita {

// A face in space, its nodes numbered from 0.
struct FaceInSpace {
  struct Part {
    int facet, k;  // facet of the face, and which of its parts
    Polygon x;
    Vec3 centre, normal;  // normal: unit, outward
    double area;
  };

  explicit FaceInSpace(const PlacedFace& face);

  std::vector<int> nodes;  // of the mesh, increasing
  Points x;                // 3 x n, m
  std::vector<FacetType> types;
  std::vector<std::vector<int>> facets;  // nodes, numbered from 0
  std::vector<Part> parts;               // of facet after facet
  std::vector<int> first_part;           // of each facet; the last entry is their number

  double smallest_edge() const;
  // The largest height (m) of an arc over a part that turns as much as its normal differs from its neighbour's; what
  // turns by more than 45 degrees is an edge.
  double sagitta() const;
};

// What a part and one of the other face have in common, in the plane of the first: a convex, counter-clockwise polygon
// in the coordinates along `along`, from the part's centre.
struct Segment {
  int other;
  Polygon2 region;
  double area, gap;  // m^2; m, how far the other face is along the normal in the middle
};

class SegmentFinder {
 public:
  // reach: how far apart the faces may be, m.
  SegmentFinder(const FaceInSpace& face, const FaceInSpace& other, double reach);

  // Of a part of `face`; facets of the other that look at it at 60 degrees at most.
  std::vector<Segment> segments(int part) const;
  // Axes of the plane of a part.
  static Eigen::Matrix<double, 3, 2> axes(const FaceInSpace::Part& part);

 private:
  const FaceInSpace &face_, &other_;
  double reach_;
  std::vector<Polygon> polygons_;
  PolygonGrid grid_;
};

}  // namespace dygita
