// What tests do with every row of the table of cells.
#pragma once

#include <gtest/gtest.h>

#include <random>

#include "fem/cells.hpp"

namespace dygita::test {

// check(cell), told apart by the name of the row.
template <typename Check>
void for_each_cell(Check check) {
  for (const CellShape& row : cell_shapes) {
    SCOPED_TRACE(row.name);
    with_cell(row.type, check);
  }
}

// The nodes of the reference cell, sheared and shaken.
template <class Cell>
Nodes<Cell::n_nodes> distorted_nodes() {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> shift(-0.08, 0.08);
  Mat3 shear;
  shear << 2, 0.3, 0.2, 0, 1, 0.4, 0.1, 0, 1.5;
  Nodes<Cell::n_nodes> x;
  for (int a = 0; a < Cell::n_nodes; ++a)
    x.col(a) = shear * vector_of(Cell::row.shape.nodes[a]) + Vec3(shift(generator), shift(generator), shift(generator));
  return x;
}

}  // namespace dygita::test
