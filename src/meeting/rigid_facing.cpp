#include <algorithm>

#include "meeting/mortar.hpp"

namespace dygita {

namespace {

// The facet seen from its other side: corners, then the edges between them; a middle node stays.
Facet turned(const Facet& facet) {
  Facet other = facet;
  const auto n = static_cast<long>(facet.corners().size());
  const std::span<int> nodes = other.nodes();
  std::reverse(nodes.begin() + 1, nodes.begin() + n);
  if (static_cast<long>(nodes.size()) >= 2 * n) std::reverse(nodes.begin() + n, nodes.begin() + 2 * n);
  return other;
}

}  // namespace

Facing facing_on_rigid(const PlacedFace& face) {
  PlacedFace rigid = face;
  for (Facet& facet : rigid.facets) facet = turned(facet);
  MeetingOptions options;
  options.points = Carrier::first;
  Facing facing = Mortar(face, rigid, options).facing({});
  facing.side_2 = {};
  facing.facets_2.clear();
  return facing;
}

}  // namespace dygita
