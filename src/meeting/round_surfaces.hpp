// Planes, cylinders and spheres that the corners of a face lie on: known between the nodes, where facets are chords.
#pragma once

#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "meeting/facing.hpp"

namespace dygita {

class RoundSurface {
 public:
  // Through the corners of a smooth patch; none where they do not determine such a surface, or lie off it by more than
  // a thousandth of the height of its arcs over the facets.
  static std::optional<RoundSurface> through(const PlacedFace& patch);

  // m, from x along a unit direction, the nearest of two; none where the line passes by.
  std::optional<double> along(const Vec3& x, const Vec3& direction) const;
  // Unit, away from the body.
  Vec3 normal(const Vec3& x) const { return sign_ * across(x).normalized(); }
  // m, between both where they are round around the same axis or centre.
  std::optional<double> even_gap(const RoundSurface& other) const;
  // m; 0 of a plane.
  double radius() const { return radius_; }
  bool is_flat() const { return kind_ == Kind::plane; }
  // Is the body within a cylinder or a sphere?
  bool bulges() const { return kind_ != Kind::plane && sign_ > 0.0; }
  double height() const { return height_; }  // m, of its arcs over the facets at most
  // m, least, of this one above a plane; none where an axis is not along the plane.
  std::optional<double> above(const RoundSurface& flat) const;
  // m, how far corners are off it at most.
  double off() const { return off_; }

 private:
  enum class Kind { plane, cylinder, sphere };
  // Corners, and the facets' middles and normals.
  struct Patch {
    explicit Patch(const PlacedFace& face);
    Points x, middles, normals;
  };

  static RoundSurface plane(const Patch& patch);
  static RoundSurface cylinder(const Patch& patch);
  static RoundSurface sphere(const Patch& patch);
  Vec3 across(const Vec3& x) const;  // from what is in its middle to x
  void measure(const Patch& patch);
  bool is_determined_by(const Patch& patch) const;

  Kind kind_ = Kind::plane;
  Vec3 centre_ = Vec3::Zero(), axis_ = Vec3::Zero();  // axis: of a cylinder; normal of a plane
  double radius_ = 0.0, sign_ = 1.0, off_ = 0.0, height_ = 0.0;
};

// The smooth surfaces of a face by its nodes.
class RoundFace {
 public:
  explicit RoundFace(const PlacedFace& face);

  // Are all of them known?
  bool is_known() const { return is_known_ && !surfaces_.empty(); }
  bool is_curved() const;
  double least_radius() const;  // m, of the curved ones
  // m, between one cylinder and another around the same axis, or such spheres; none where it is nothing.
  std::optional<double> even_gap(const RoundFace& other) const;
  // m, how far apart a plane and a cylinder or sphere that bulges may be for some facets beside the line or point where
  // they touch to take part; 0 of other faces.
  double reach_on_flat(const RoundFace& other) const;
  // m, by how much a least gap at some nodes exceeds that of the surfaces there, beyond what a load closes: the line
  // may lie between two of them.
  double missed_on_flat(const RoundFace& other, double least_at_nodes) const;
  double off() const;
  // m, of the surface that has a node and whose normal is nearest to a direction or its opposite.
  std::optional<double> along(const Vec3& x, const Vec3& direction, int node) const;

 private:
  // A plane and what bulges towards it; nothing of other faces.
  std::pair<const RoundSurface*, const RoundSurface*> flat_and_round(const RoundFace& other) const;

  std::vector<RoundSurface> surfaces_;
  std::unordered_map<int, std::vector<int>> of_node_;
  bool is_known_ = true;
};

// m, of the surfaces at the points of an interface, along its normals; none where one is not known. bend: how far the
// gap in the middle of an edge between points is off the mean of both, at most.
struct RoundGaps {
  Vec gaps;
  double bend = 0.0, off = 0.0;
  bool is_on_flat = false;  // along a line or at a point,
  double missed = 0.0;      // m, which lies between the points: the least of the gaps is as much too large
};
std::optional<RoundGaps> round_gaps(const PlacedFace& side_1, const PlacedFace& side_2, const Facing& facing);

}  // namespace dygita
