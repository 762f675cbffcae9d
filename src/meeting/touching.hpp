// Where two bodies touch: facets of both that lie on each other, found without names (manual, finding interfaces).
#pragma once

#include <memory>
#include <optional>

#include "meeting/facing.hpp"
#include "mesh/facet_keys.hpp"

namespace dygita {

// The outside of a body, or some of its facets, by smooth surfaces.
class Outside {
 public:
  // All of the boundary.
  Outside(const Mesh& mesh, const Vec3& place);
  // These facets of it.
  Outside(const Mesh& mesh, const Vec3& place, std::vector<Facet> facets);

  const Mesh* mesh;
  Vec3 place;
  std::vector<Facet> facets;
  std::vector<Vec3> low, high;  // m, of each facet in space
  std::vector<double> sizes;    // m, square root of its area
  std::vector<int> patch;       // of each facet
};

struct Touching {
  // Those beside them on the same smooth surface: they tell how much of what is around a node at the rim is covered.
  std::vector<Facet> beside_1, beside_2;
  std::vector<Facet> facets_1, facets_2;   // that take part
  std::vector<Facet> partly_1, partly_2;   // of these, those that are not covered on all of their area
  double area = 0.0;                       // m^2, in common
  double least_gap = 0.0, most_gap = 0.0;  // m, between facets; negative where they cross, as chords of round faces do
  double within = 0.0;  // m, also where nothing touches: how far apart surfaces could be that count as touching
  int n_surfaces = 0;   // pairs of smooth surfaces that touch
  double bend = 0.0;    // m, how far facets are off the round surfaces they stand for, at most
  bool is_empty() const { return facets_1.empty(); }
};

// The facets that touch, but for those in `taken`: normals opposed, regions in common, and the surfaces that the facets
// stand for - round where neighbours bend - no farther apart than `within` (m) on average; left out, a hundredth of the
// usual facet where the bodies are near each other, of the finer side.
Touching find_touching(const Outside& one, const Outside& other, std::optional<double> within,
                       const FacetKeys& taken_1 = {}, const FacetKeys& taken_2 = {});

// The least distance between two bodies' surfaces, at the nodes of both, and where.
struct Separation {
  double distance = 0.0;  // m
  Vec3 place_1, place_2;
};
Separation separation(const Outside& one, const Outside& other);

}  // namespace dygita
