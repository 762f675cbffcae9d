// Cells of a mesh that do not fit each other: listed twice, on top of each other, side by side without a facet in
// common.
#pragma once

#include <optional>

#include "mesh/facet_keys.hpp"

namespace dygita {

// Throws InputError naming both cells where two have the same nodes, lie on the same side of the facet that they share,
// or share its corners and not its other nodes.
void check_shared_facets(const Mesh& mesh, const std::string& name);

// Facets of a boundary that lie on others of it: nothing joins the cells behind them, which pass through each other.
struct Seam {
  double area = 0.0;       // m^2, that lies on each other
  int n_facets = 0;        // pairs of facets
  Vec3 place;              // of the first pair, in the mesh
  Facet facet_1, facet_2;  // of the first pair
  bool is_overlap;         // both have their cells on the same side
};

// The seam of a mesh, but for facets in `joined`. None where each facet of the boundary is by itself.
std::optional<Seam> find_seam(const Mesh& mesh, const FacetKeys& joined);

// "cell 3 (hex8)", to which a facet of the boundary belongs.
std::string cell_with(const Mesh& mesh, const Facet& facet);

// The cells of a mesh by those that share nodes with each other, each a mesh of its own without faces. `nodes`: the
// number in the whole mesh of each of its own.
struct LoosePiece {
  Mesh mesh;
  std::vector<int> nodes;
};
// Empty where they are all connected.
std::vector<LoosePiece> loose_pieces(const Mesh& mesh);

}  // namespace dygita
