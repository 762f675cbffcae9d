#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <iterator>

#include "base/error.hpp"
#include "meeting/mortar.hpp"
#include "meeting/overlap.hpp"
#include "mesh/facet_keys.hpp"

namespace dygita {

namespace {

std::vector<Polygon> polygons_of(const PlacedFace& face) {
  const FaceInSpace in_space(face);
  std::vector<Polygon> polygons;
  for (const FaceInSpace::Part& part : in_space.parts) polygons.push_back(part.x);
  return polygons;
}

// Faces that lie on one another with their normals the same way belong to bodies that do so too.
void refuse_same_side(const PlacedFace& side_1, const PlacedFace& side_2) {
  const std::optional<Overlap> overlap = find_overlap(polygons_of(side_1), polygons_of(side_2));
  if (!overlap) return;
  const Vec3& x = overlap->place;
  throw InputError(
      fmt::format("faces '{}' and '{}' coincide, around ({:.6g}, {:.6g}, {:.6g}) m, but both have their bodies "
                  "on the same side: the bodies overlap\n    check the places of both bodies, or whether the opposite "
                  "end face was meant",
                  side_1.name, side_2.name, x[0], x[1], x[2]));
}

// Those of a face's facets that are among these, whose corners may go round the other way.
std::vector<Facet> facets_among(const std::vector<Facet>& of_face, const std::vector<Facet>& these) {
  FacetKeys keys;
  for (const Facet& facet : these) keys.insert(facet_key(facet));
  std::vector<Facet> found;
  std::copy_if(of_face.begin(), of_face.end(), std::back_inserter(found),
               [&](const Facet& facet) { return keys.contains(facet_key(facet)); });
  return found;
}

}  // namespace

Meeting::Meeting(const PlacedFace& side_1, const PlacedFace& side_2, const MeetingOptions& options)
    : matched_(match_faces(side_1, side_2)) {
  const auto is_cut = [](const Facet& facet) { return facet_shape(facet.type()).is_shared_by_sub_facets; };
  if (matched_ && options.acts_by_area && std::any_of(matched_->facets_1.begin(), matched_->facets_1.end(), is_cut))
    matched_.reset();
  if (!matched_) mortar_.emplace(side_1, side_2, options);
  if (mortar_ && mortar_->is_empty()) {
    refuse_same_side(side_1, side_2);
    refuse_apart(side_1, side_2);
  }
  if (options.splits_at_edges) split(side_1, side_2, options);
}

// All parts match or none, and one side carries the points of all: as of the faces as a whole.
void Meeting::split(const PlacedFace& side_1, const PlacedFace& side_2, const MeetingOptions& options) {
  const std::vector<PlacedFace> parts_1 = smooth_parts(
                                    {side_1.mesh, facets_among(side_1.facets, facets_1()), side_1.place, side_1.name}),
                                parts_2 = smooth_parts(
                                    {side_2.mesh, facets_among(side_2.facets, facets_2()), side_2.place, side_2.name});
  if (parts_1.size() < 2 && parts_2.size() < 2) return;
  MeetingOptions of_parts = options;
  if (mortar_) of_parts.points = mortar_->is_second() ? Carrier::second : Carrier::first;
  for (const PlacedFace& part_1 : parts_1)
    for (const PlacedFace& part_2 : parts_2) {
      if (!mortar_) {
        if (std::optional<Facing> both = match_faces(part_1, part_2)) matched_parts_.push_back(std::move(*both));
      } else if (Mortar both(part_1, part_2, of_parts); !both.is_empty()) {
        mortar_parts_.push_back(std::move(both));
      }
    }
}

Facing Meeting::facing(const std::function<bool(const Vec3&)>& is_taken_away) const {
  if (!matched_parts_.empty()) return joined(matched_parts_);
  if (mortar_parts_.empty()) return mortar_ ? mortar_->facing(is_taken_away) : *matched_;
  std::vector<Facing> parts;
  for (const Mortar& part : mortar_parts_) parts.push_back(part.facing(is_taken_away));
  return joined(parts);
}

}  // namespace dygita
