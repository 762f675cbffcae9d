// A mesh cut in two: by a plane, or along facets inside it.
#pragma once

#include "mesh/mesh.hpp"

namespace dygita {

struct MeshHalf {
  MeshPtr mesh;
  std::vector<int> nodes;  // the number in the whole of each of its own; -1: a new one
};

struct MeshCut {
  std::array<MeshHalf, 2> halves;  // behind the plane, and beyond it
  double at = 0.0;                 // m, along the normal: where it was cut
  int n_divided = 0;               // cells
};

// Tetrahedra that the plane crosses are divided, so that the new faces lie in it and have the same facets; nodes within
// a quarter of an edge move onto it where the surface of the body stays as it is. Cells of other kinds stay whole, and
// the cut lies in the plane of their facets that is nearest. Named faces go to both halves, the new one is called
// `face`. Throws InputError where the plane does not cut the body, where its cells have no facets in a plane, and where
// there is such a face already.
MeshCut cut_by_plane(const Mesh& mesh, const Vec3& normal, double at, const std::string& face);

// A facet between two cells by its corners, and a node beside it, of the cell that belongs to the first half.
struct InnerFacet {
  FacetKey corners;
  int behind;
};
// Throws InputError where cells on both sides of the facets are connected around them.
MeshCut cut_along(const Mesh& mesh, const std::vector<InnerFacet>& facets, const std::string& face);

}  // namespace dygita
