#include "meeting/mortar.hpp"
#include "mesh/turned_facet.hpp"

namespace dygita {

Facing facing_on_rigid(const PlacedFace& face) {
  PlacedFace rigid = face;
  for (Facet& facet : rigid.facets) facet = turned_facet(facet);
  MeetingOptions options;
  options.points = Carrier::first;
  Facing facing = Mortar(face, rigid, options).facing({});
  facing.side_2 = {};
  facing.facets_2.clear();
  return facing;
}

}  // namespace dygita
