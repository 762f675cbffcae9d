#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "base/error.hpp"
#include "mesh/mortar.hpp"
#include "mesh/overlap.hpp"

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
  throw InputError(fmt::format(
      "faces '{}' and '{}' lie on one another, around ({:.6g}, {:.6g}, {:.6g}) m, but both have their bodies "
      "on the same side: the bodies overlap\n    check the places of both bodies, or whether a face of the "
      "other end was meant",
      side_1.name, side_2.name, x[0], x[1], x[2]));
}

}  // namespace

Meeting::Meeting(const PlacedFace& side_1, const PlacedFace& side_2, const MeetingOptions& options)
    : matched_(match_faces(side_1, side_2)) {
  const auto is_cut = [](const Facet& facet) { return facet_shape(facet.type()).is_shared_by_sub_facets; };
  if (matched_ && options.acts_by_area && std::any_of(matched_->facets_1.begin(), matched_->facets_1.end(), is_cut))
    matched_.reset();
  if (matched_) return;
  mortar_.emplace(side_1, side_2, options);
  if (!mortar_->is_empty()) return;
  refuse_same_side(side_1, side_2);
  refuse_apart(side_1, side_2);
}

}  // namespace dygita
