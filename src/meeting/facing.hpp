// How two faces meet: points, what moves with them on either side, normals and areas.
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "meeting/side_trace.hpp"
#include "mesh/face_nodes.hpp"

namespace dygita {

// One body's face in space: the mesh, the facets and the translation of its nodes.
struct PlacedFace {
  const Mesh* mesh;
  std::vector<Facet> facets;
  Vec3 place = Vec3::Zero();
  std::string name;  // "specimen.zmax", for messages
};

struct Facing {
  std::vector<Facet> facets_1,
      facets_2;               // that take part, numbers of each side's nodes; one on the other if they match
  SideTrace side_1, side_2;   // of each interface point; none on side 2 of a wall
  Points places;              // 3 x n, m, on the side that carries the points
  Points normals;             // unit, from side 1 to side 2, area-weighted mean of the facets
  Vec areas;                  // m^2, integral of the point's function over what is in common
  std::vector<Facet> facets;  // between the points, by their numbers
  Vec gaps;                   // m, how far side 2 lies off along the normal; zero where faces match
  // Faces that do not match: the side at whose nodes the points are (0: they match), how many times larger its facets
  // are, the largest height (m) of an arc over an edge, and points merged into others.
  int carrier = 0;
  double size_ratio = 1.0, sagitta = 0.0;
  int n_merged = 0;
  // Of points that no facets give, where a deck joins sums of motions: their axes, and along which of them they act.
  // Else empty: N and two tangents, and all of them.
  std::vector<Mat3> frames;
  std::vector<std::array<bool, 3>> directions;
  Vec3 tangent = Vec3::Zero();  // the first of all points' frames, but for what supports ask for; zero: any

  bool is_of_sums() const { return !frames.empty(); }
  bool acts_along(int i, int d) const { return directions.empty() || directions[static_cast<size_t>(i)][d]; }
  int n_points() const { return static_cast<int>(areas.size()); }
  bool matches() const { return carrier == 0; }
};

// The same points where nodes of a side move with rigid faces of a body without cells: they then move with the face's
// own unknowns, and the faces match no more. mesh_1, mesh_2: of the sides, null for a wall's.
void follow_rigid_faces(const Mesh* mesh_1, const Vec3& place_1, const Mesh* mesh_2, const Vec3& place_2,
                        Facing& facing);

// Points at the nodes of a face by itself.
Facing facing_of(const PlacedFace& face);

// A face's smooth surfaces, between sharp edges.
std::vector<PlacedFace> smooth_parts(const PlacedFace& face);

// Those of its points of which `is_taken_away` does not say that they go, with the areas of those that do; empty: all.
Facing without(const Facing& facing, const std::function<bool(const Vec3&)>& is_taken_away);

// All points of several, none of them merged: at an edge of two parts each has its own. At least one.
Facing joined(const std::vector<Facing>& parts);

// Matches facets whose nodes coincide (tolerance 1e-6 of the smallest facet edge, found with a grid hash: n log n).
// Facets without partner are simply outside the interface. Nothing when no facet matches, or when unmatched facets of
// the two faces overlap (their projections intersect on nearly the same plane). Throws InputError where a face has no
// facet, two nodes at a place, or where both bodies lie on the same side.
std::optional<Facing> match_faces(const PlacedFace& side_1, const PlacedFace& side_2);

// Says that they do not meet, and how far they are apart: throws InputError.
[[noreturn]] void refuse_apart(const PlacedFace& side_1, const PlacedFace& side_2);

}  // namespace dygita
