// Interface points between faces whose meshes do not match: dual mortar (manual, eq. J1-J5).
#pragma once

#include <functional>
#include <optional>

#include "meeting/meeting_options.hpp"
#include "meeting/mortar_integrals.hpp"

namespace dygita {

// m, of points (3 x n) across the line that is nearest to them, in the plane that they lie on: root of the mean of
// squares. Next to nothing where they are in a row.
double width_of(const Points& x);

// Multipliers of one face, the carrier of the points, before any is taken away.
class Mortar {
 public:
  // Chooses the carrier. Throws InputError where the faces have nothing in common.
  Mortar(const PlacedFace& side_1, const PlacedFace& side_2, const MeetingOptions& options);

  bool is_empty() const { return covered_ == 0.0; }
  double reach() const { return reach_; }        // m, how far apart the faces may be
  bool is_second() const { return is_second_; }  // does the second side carry the points?
  // Facets of each side that take part, with the meshes' node numbers.
  const std::vector<Facet>& facets_1() const { return is_second_ ? of_other_ : of_carrier_; }
  const std::vector<Facet>& facets_2() const { return is_second_ ? of_carrier_ : of_other_; }

  // The points; those that `is_taken_away` says of their places are merged into their neighbours, as are points of
  // which next to nothing is covered.
  Facing facing(const std::function<bool(const Vec3&)>& is_taken_away) const;

 private:
  struct Raw;  // a point before division by its area
  std::vector<Raw> raw_points() const;
  std::vector<std::vector<int>> neighbours(const std::vector<Raw>& raw) const;
  std::vector<int> distances(const std::vector<Raw>& raw, const std::vector<std::vector<int>>& near,
                             const std::function<bool(const Vec3&)>& is_taken_away) const;
  std::vector<int> merge(const std::function<bool(const Vec3&)>& is_taken_away, std::vector<Raw>& raw) const;
  void add_point(const Raw& raw, SideTrace& own, SideTrace& opposite, Facing& facing) const;
  void find_facets(const PlacedFace& carrier, const PlacedFace& other);

  FaceInSpace face_1_, face_2_;
  bool is_second_ = false;  // the second side carries the points
  double ratio_ = 1.0, reach_ = 0.0, covered_ = 0.0;
  std::vector<Coupling> couplings_;
  std::vector<Facet> of_carrier_, of_other_;

  const FaceInSpace& carrier() const { return is_second_ ? face_2_ : face_1_; }
  const FaceInSpace& other() const { return is_second_ ? face_1_ : face_2_; }
};

// The points of a face on something rigid that fits it, side 2: those of its sub-facets, where forces of a pressure
// push at every point. For facets of order two without a middle node.
Facing facing_on_rigid(const PlacedFace& face);

// What two faces have in common, matched node for node or not.
class Meeting {
 public:
  // Throws InputError naming both faces where they do not meet, or their bodies lie on the same side.
  Meeting(const PlacedFace& side_1, const PlacedFace& side_2, const MeetingOptions& options);

  bool matches() const { return !mortar_; }
  double reach() const { return mortar_ ? mortar_->reach() : 0.0; }  // as a mortar's
  const std::vector<Facet>& facets_1() const { return mortar_ ? mortar_->facets_1() : matched_->facets_1; }
  const std::vector<Facet>& facets_2() const { return mortar_ ? mortar_->facets_2() : matched_->facets_2; }
  Facing facing(const std::function<bool(const Vec3&)>& is_taken_away) const;

 private:
  void split(const PlacedFace& side_1, const PlacedFace& side_2, const MeetingOptions& options);

  std::optional<Facing> matched_;
  std::optional<Mortar> mortar_;
  // Of smooth surfaces that meet, where a side has several; else empty.
  std::vector<Facing> matched_parts_;
  std::vector<Mortar> mortar_parts_;
};

}  // namespace dygita
