// A facet seen from its other side.
#pragma once

#include <algorithm>

#include "mesh/mesh.hpp"

namespace dygita {

// Corners turn the other way round, then the edges between them; a middle node stays.
inline Facet turned_facet(const Facet& facet) {
  Facet other = facet;
  const auto n = static_cast<long>(facet.corners().size());
  const std::span<int> nodes = other.nodes();
  std::reverse(nodes.begin() + 1, nodes.begin() + n);
  if (static_cast<long>(nodes.size()) >= 2 * n) std::reverse(nodes.begin() + n, nodes.begin() + 2 * n);
  return other;
}

}  // namespace dygita
