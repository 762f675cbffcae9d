// A smooth stress of cells of order two: quadratic polynomials through the stress of the cells around each corner.
#pragma once

#include "fem/assembly.hpp"

namespace dygita {

// Has the mesh cells of order two alone?
bool is_of_order_two(const Mesh& mesh);

// At each node, 6 x n_nodes, Pa; displacement: 3 x n_nodes, m. Around each corner of the cells a polynomial of degree
// two fits the stress at the points where it is most accurate (at_recovery of the table of cells); further nodes have
// the mean of their corners' polynomials. Where the cells around a corner do not determine it, as at a surface, those
// around them join. O. C. Zienkiewicz, J. Z. Zhu (Int. J. Numer. Methods Eng. 33, 1992); manual, eq. Q5.
Tensors recovered_stress(const Mesh& mesh, const Elastic& material, const Points& displacement);

}  // namespace dygita
