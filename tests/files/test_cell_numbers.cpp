// The numbers under which VTK knows the rows of the tables of cells and facets, and its order of their nodes.
#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkGenericCell.h>
#include <vtkIdList.h>
#include <vtkNew.h>

#include <algorithm>

#include "mesh/mesh.hpp"

namespace dygita {
namespace {

// VTK's cell of this number, its nodes 0 .. n - 1.
void become(vtkGenericCell* cell, int vtk_type) {
  cell->SetCellType(vtk_type);
  for (vtkIdType a = 0; a < cell->GetNumberOfPoints(); ++a) cell->GetPointIds()->SetId(a, a);
}

// Turned so that the smallest node comes first: equal for the same corners in the same sense.
std::vector<int> turned(std::vector<int> corners) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

TEST(CellNumbers, name_the_cells_of_vtk_that_have_our_facets_outward) {
  for (const CellShape& row : cell_shapes) {
    vtkNew<vtkGenericCell> cell;
    become(cell, row.vtk_type);
    ASSERT_EQ(cell->GetNumberOfPoints(), nodes_per_cell(row.type)) << row.name;
    ASSERT_EQ(cell->GetNumberOfFaces(), static_cast<int>(row.facets.size())) << row.name;
    std::vector<std::vector<int>> ours, theirs;
    for (const LocalFacet& facet : row.facets)
      ours.push_back(turned({facet.nodes.begin(), facet.nodes.begin() + facet_shape(facet.type).n_corners}));
    for (int k = 0; k < cell->GetNumberOfFaces(); ++k) {
      vtkCell* face = cell->GetFace(k);
      const auto facet = std::find_if(std::begin(facet_shapes), std::end(facet_shapes),
                                      [&](const FacetShape& f) { return f.vtk_type == face->GetCellType(); });
      ASSERT_NE(facet, std::end(facet_shapes)) << row.name;
      std::vector<int> corners;
      for (int a = 0; a < facet->n_corners; ++a) corners.push_back(static_cast<int>(face->GetPointId(a)));
      theirs.push_back(turned(corners));
    }
    std::sort(ours.begin(), ours.end());
    std::sort(theirs.begin(), theirs.end());
    EXPECT_EQ(ours, theirs) << row.name;
  }
}

// VTK has each node of an edge between the corners that ours lies between; of its own coordinates, the wedge's are
// turned inside out.
TEST(CellNumbers, name_the_cells_of_vtk_that_have_our_nodes_on_their_edges) {
  for (const CellShape& row : cell_shapes) {
    vtkNew<vtkGenericCell> cell;
    become(cell, row.vtk_type);
    for (int k = 0; k < cell->GetNumberOfEdges(); ++k) {
      vtkCell* edge = cell->GetEdge(k);
      const Place &a = row.shape.nodes[edge->GetPointId(0)], &b = row.shape.nodes[edge->GetPointId(1)];
      for (vtkIdType m = 2; m < edge->GetNumberOfPoints(); ++m)
        for (int d = 0; d < 3; ++d)
          EXPECT_NEAR(row.shape.nodes[edge->GetPointId(m)][d], (a[d] + b[d]) / 2, 1e-15) << row.name;
      EXPECT_LT(edge->GetPointId(0), row.n_corners) << row.name;
    }
  }
}

TEST(CellNumbers, name_the_facets_of_vtk) {
  for (const FacetShape& row : facet_shapes) {
    vtkNew<vtkGenericCell> cell;
    become(cell, row.vtk_type);
    ASSERT_EQ(cell->GetNumberOfPoints(), nodes_per_facet(row.type));
    EXPECT_EQ(cell->GetCellDimension(), 2);
    EXPECT_EQ(cell->GetNumberOfEdges(), row.n_corners);
  }
}

}  // namespace
}  // namespace dygita
