// Two bodies near each other: where they touch, how far one lies in the other, which nodes have a face of the other
// before them.
#pragma once

#include <optional>
#include <unordered_set>

#include "mesh/box_grid.hpp"
#include "mesh/facet_keys.hpp"

namespace dygita {

// A body in space. `joined`: facets that meet the other body in an interface, and their nodes: no longer asked for.
// `reused`: those of them on whose rest another part of the other body may still lie.
struct PlacedBody {
  const Mesh* mesh;
  Vec3 place;
  FacetKeys joined = {}, reused = {};
  std::unordered_set<int> joined_nodes = {};

  Vec3 at(int node) const { return mesh->nodes.col(node) + place; }
  Box box() const;
};

struct Touch {
  double area;             // m^2, of facets of both that lie on each other, normals opposed
  Vec3 place;              // in the middle of the first region met
  Facet facet_1, facet_2;  // that meet there
};

struct Intrusion {
  double depth;  // m, the deepest point found: how far it is from the surface of the body that it is in
  Vec3 place;
  Box extent;           // of all points found
  double volume = 0.0;  // m^3, in common, within some percent
};

// A node and the facet of the other body that it would pass through: its gap grows by normal . (u_node - sum w u).
struct NearNode {
  int node;
  Facet facet;
  std::array<double, most_facet_nodes> weights;  // of the facet's nodes, where the node's projection is
  Vec3 normal;                                   // unit, out of the facet's body
  double gap;                                    // m, zero where it lies a little inside
};

struct Neighbours {
  std::optional<Touch> touch;
  std::optional<Intrusion> intrusion;
  std::vector<NearNode> nodes_1, nodes_2;  // of body 1 before facets of body 2, and the other way round

  bool are_near() const { return !nodes_1.empty() || !nodes_2.empty(); }
};

// What two bodies are to each other where their bounding boxes, grown by `reach` (m), meet; nothing where these do not.
// Only cells there are looked at. Chords of curved faces that cross are no intrusion: what counts is deeper than half a
// facet times the sine of the angle between both facets, and than the facets of both are off their round faces.
Neighbours find_neighbours(const PlacedBody& body_1, const PlacedBody& body_2, double reach);

}  // namespace dygita
