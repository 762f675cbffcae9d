// The types of cells: one table, one row a type. Nothing else in the program lists them or asks for one by name, except
// who makes cells of a type (box.cpp) and kernels that exist for one type only (fem/cells.hpp). A row without one of
// its members does not compile; one whose members do not fit each other neither (cell_types.cpp).
#pragma once

#include <string_view>

#include "mesh/facet_types.hpp"

namespace dygita {

enum class CellType { hex8, prism6, tet4 };  // in the order of the rows

// A facet of a reference cell: the cell's nodes in the order of the facet's, normal outward.
struct LocalFacet {
  FacetType type;
  std::array<int, most_facet_nodes> nodes;
};

// How the mass of a cell comes to its nodes. Row sums of the consistent mass: total and centre of mass are exact.
enum class Lumping { row_sums };

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

  QuadratureRule stiffness;    // exact for the volume and its first moments
  QuadratureRule mass;         // exact for products of two shape functions in an undistorted cell
  QuadratureRule at_recovery;  // where stress is computed
  ShapeSpace recovery;         // what carries it from there to the nodes: a function a point
  Lumping lumping;
  OnePoint one_point;

  int cells_per_brick;        // as many fill a brick on three edges of one
  int weight;                 // six times the nodes that a cell brings to a large mesh
  std::string_view locks_as;  // what a warning calls it that it locks near incompressibility; empty: it says nothing
  int gmsh_type, vtk_type;
};

namespace reference {
inline constexpr LocalFacet hex8_facets[] = {{FacetType::quad4, {0, 4, 7, 3}}, {FacetType::quad4, {1, 2, 6, 5}},
                                             {FacetType::quad4, {0, 1, 5, 4}}, {FacetType::quad4, {3, 7, 6, 2}},
                                             {FacetType::quad4, {0, 3, 2, 1}}, {FacetType::quad4, {4, 5, 6, 7}}};
inline constexpr LocalFacet prism6_facets[] = {{FacetType::tri3, {0, 1, 2}},
                                               {FacetType::tri3, {3, 5, 4}},
                                               {FacetType::quad4, {0, 3, 4, 1}},
                                               {FacetType::quad4, {1, 4, 5, 2}},
                                               {FacetType::quad4, {2, 5, 3, 0}}};
inline constexpr LocalFacet tet4_facets[] = {{FacetType::tri3, {0, 2, 1}},
                                             {FacetType::tri3, {0, 1, 3}},
                                             {FacetType::tri3, {1, 2, 3}},
                                             {FacetType::tri3, {2, 0, 3}}};
inline constexpr int hex8_mirrored[] = {4, 5, 6, 7, 0, 1, 2, 3};
inline constexpr int prism6_mirrored[] = {3, 4, 5, 0, 1, 2};
inline constexpr int tet4_mirrored[] = {1, 0, 2, 3};
}  // namespace reference

#pragma GCC diagnostic push
#pragma GCC diagnostic error "-Wmissing-field-initializers"
inline constexpr CellShape cell_shapes[] = {
    {.type = CellType::hex8,
     .name = "hex8",
     .shape = reference::hex8,
     .n_corners = 8,
     .facets = reference::hex8_facets,
     .mirrored = reference::hex8_mirrored,
     .stiffness = reference::cube_8,
     .mass = reference::cube_8,
     .at_recovery = reference::cube_8,
     .recovery = reference::hex8,
     .lumping = Lumping::row_sums,
     .one_point = OnePoint::hourglass_control,
     .cells_per_brick = 1,
     .weight = 6,
     .locks_as = "",
     .gmsh_type = 5,
     .vtk_type = 12},
    {.type = CellType::prism6,
     .name = "prism6",
     .shape = reference::prism6,
     .n_corners = 6,
     .facets = reference::prism6_facets,
     .mirrored = reference::prism6_mirrored,
     .stiffness = reference::prism_6,
     .mass = reference::prism_6,
     .at_recovery = reference::prism_6,
     .recovery = reference::prism6,
     .lumping = Lumping::row_sums,
     .one_point = OnePoint::none,
     .cells_per_brick = 2,
     .weight = 3,
     .locks_as = "",
     .gmsh_type = 6,
     .vtk_type = 13},
    {.type = CellType::tet4,
     .name = "tet4",
     .shape = reference::tet4,
     .n_corners = 4,
     .facets = reference::tet4_facets,
     .mirrored = reference::tet4_mirrored,
     .stiffness = reference::tetrahedron_1,
     .mass = reference::tetrahedron_4,
     .at_recovery = reference::tetrahedron_1,
     .recovery = reference::point,
     .lumping = Lumping::row_sums,
     .one_point = OnePoint::exact,
     .cells_per_brick = 6,
     .weight = 1,
     .locks_as = "linear tetrahedra",
     .gmsh_type = 4,
     .vtk_type = 10},
};
#pragma GCC diagnostic pop
constexpr const CellShape& cell_shape(CellType type) { return cell_shapes[static_cast<int>(type)]; }
constexpr int nodes_per_cell(CellType type) { return static_cast<int>(cell_shape(type).shape.nodes.size()); }

inline constexpr int n_cell_types = static_cast<int>(std::size(cell_shapes));
inline constexpr int most_cell_nodes = [] {
  size_t most = 0;
  for (const CellShape& cell : cell_shapes) most = std::max(most, cell.shape.nodes.size());
  return static_cast<int>(most);
}();

}  // namespace dygita
