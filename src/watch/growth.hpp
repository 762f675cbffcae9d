// Stress comes of what a part is strained beyond what it would grow by itself (manual, eq. S8).
#pragma once

#include "step/observer.hpp"

namespace dygita {

// The strain by which a part would grow at an instant, were it free.
double growth_at(const Instant& instant, int part);

// Displacements (3 x n, m) of the nodes of a part, or of some of its cells, without that: those that stress it. x: 3 x
// n, m, of the same nodes.
inline Points without_growth(Points displacement, double growth, const Points& x) {
  if (growth != 0.0) displacement -= growth * x;
  return displacement;
}

// Of a piece: 3 x its nodes.
Points strained_piece(const Instant& instant, int piece);

}  // namespace dygita
