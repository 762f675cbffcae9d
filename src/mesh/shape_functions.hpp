// Shape functions of any element, from its reference nodes and monomials: the inverse of the Vandermonde matrix of each
// factor of its space holds their coefficients.
#pragma once

#include <vector>

#include "mesh/cell_types.hpp"
#include "numerics/types.hpp"

namespace dygita {

class ShapeFunctions {
 public:
  explicit ShapeFunctions(const ShapeSpace& space);

  Vec values(const Vec3& xi) const;                                       // N_a
  Eigen::Matrix<double, Eigen::Dynamic, 3> slopes(const Vec3& xi) const;  // d N_a / d xi, n x 3

 private:
  struct Factor {
    int first_axis, n_axes;
    std::span<const Exponents> monomials;
    Mat coefficients;  // one row per node, one column per monomial

    double value(int node, const Vec3& xi) const;
    double slope(int node, const Vec3& xi, int axis) const;  // of the element's axis
  };
  std::vector<Factor> factors_;
  std::vector<std::vector<int>> node_of_factor_;  // of each node, its node in each factor
};

// Those of a type, made once.
const ShapeFunctions& shape_functions(CellType type);
const ShapeFunctions& shape_functions(FacetType type);

inline Vec3 vector_of(const Place& at) { return {at[0], at[1], at[2]}; }

}  // namespace dygita
