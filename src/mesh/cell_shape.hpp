// A row of the table of cells: what a type must say of itself (cell_types.hpp).
#pragma once

#include <string_view>

#include "mesh/facet_types.hpp"

namespace dygita {

// In the order of the rows; new ones come last: digests of meshes hold the number.
enum class CellType { hex8, prism6, tet4, tet10, hex20, hex27, prism15, prism18 };

// A facet of a reference cell: the cell's nodes in the order of the facet's, normal outward.
struct LocalFacet {
  FacetType type;
  std::array<int, most_facet_nodes> nodes;
};

// How the mass of a cell comes to its nodes. Row sums of the consistent mass: total and centre of mass are exact. Its
// diagonal scaled to the total (E. Hinton, T. Rock, O. C. Zienkiewicz, Earthq. Eng. Struct. Dyn. 4, 1976): positive
// where row sums are not.
enum class Lumping { row_sums, diagonal };

// The mass in a time step: that of the nodes, or the consistent matrix.
enum class Inertia { lumped, consistent };

// What one stress a cell, from its mean gradient, leaves out: nothing; modes without strain there, which get a
// stiffness of their own; or too much, so that an explicit run keeps the full integration.
enum class OnePoint { exact, hourglass_control, none };

// Numbering of the nodes is VTK's, corners first, and stays so: files are written as cells stand. Beware of vtkWedge:
// the normal of the triangle 0 1 2 points out of the cell (gmsh, Abaqus and most others have it inward).
struct CellShape {
  CellType type;
  const char* name;
  ShapeSpace shape;
  int n_corners;
  std::span<const LocalFacet> facets;
  std::span<const int> mirrored;  // nodes of the same cell turned inside out

  QuadratureRule stiffness;    // exact for the volume
  QuadratureRule mass;         // exact for products of two shape functions in an undistorted cell
  QuadratureRule at_recovery;  // where stress is computed
  ShapeSpace recovery;         // what carries it from there to the nodes: a function a point
  Lumping lumping;
  Inertia inertia;
  OnePoint one_point;

  int cells_per_brick;        // as many fill a brick on three edges of one
  int weight;                 // six times the nodes that a cell brings to a large mesh
  std::string_view locks_as;  // what a warning calls it that it locks near incompressibility; empty: it says nothing
  int gmsh_type, vtk_type;
};

}  // namespace dygita
