// What must hold between the members of a row, checked by the compiler.
#include "mesh/cell_types.hpp"

namespace dygita {

namespace {

constexpr bool fits(const ShapeSpace& space) {
  size_t n_functions = 1;
  for (const ShapeFactor& factor : space.factors) {
    if (factor.nodes.size() != factor.monomials.size() || factor.first_axis + factor.n_axes > 3) return false;
    n_functions *= factor.nodes.size();
  }
  return !space.nodes.empty() && n_functions == space.nodes.size();
}

constexpr double measure(const QuadratureRule& rule) {
  double sum = 0.0;
  for (const QuadraturePoint& point : rule.points) sum += point.weight;
  return sum;
}

constexpr bool measures_the_same(const QuadratureRule& a, const QuadratureRule& b) {
  const double difference = measure(a) - measure(b);
  return measure(a) > 0.0 && difference < 1e-14 && difference > -1e-14;
}

// Each number from 0 to n - 1 once.
constexpr bool is_permutation_of(std::span<const int> numbers, size_t n) {
  for (size_t i = 0; i < n; ++i)
    if (std::count(numbers.begin(), numbers.end(), static_cast<int>(i)) != 1) return false;
  return numbers.size() == n;
}

constexpr bool is_sound(const FacetShape& facet) {
  const size_t n = facet.shape.nodes.size();
  return fits(facet.shape) && facet.n_corners >= 3 && facet.n_corners <= most_facet_corners &&
         facet.rim.size() >= static_cast<size_t>(facet.n_corners) && facet.rim.size() <= n &&
         !facet.sub_facets.empty() && measure(facet.rule) > 0.0 && facet.gmsh_type > 0 && facet.vtk_type > 0;
}

constexpr bool is_sound(const CellShape& cell) {
  const size_t n = cell.shape.nodes.size();
  for (const LocalFacet& facet : cell.facets)
    for (int a = 0; a < nodes_per_facet(facet.type); ++a)
      if (facet.nodes[a] < 0 || facet.nodes[a] >= static_cast<int>(n)) return false;
  return fits(cell.shape) && cell.n_corners >= 4 && cell.n_corners <= static_cast<int>(n) && cell.facets.size() >= 4 &&
         is_permutation_of(cell.mirrored, n) && measures_the_same(cell.stiffness, cell.mass) &&
         measures_the_same(cell.stiffness, cell.at_recovery) && fits(cell.recovery) &&
         cell.recovery.nodes.size() == cell.at_recovery.points.size() && cell.cells_per_brick > 0 && cell.weight > 0 &&
         cell.name != nullptr && cell.gmsh_type > 0 && cell.vtk_type > 0;
}

// Rows stand in the order of their types.
template <typename Rows>
constexpr bool are_sound(const Rows& rows) {
  for (size_t i = 0; i < std::size(rows); ++i)
    if (static_cast<size_t>(rows[i].type) != i || !is_sound(rows[i])) return false;
  return true;
}

static_assert(are_sound(facet_shapes) && are_sound(cell_shapes));

}  // namespace

}  // namespace dygita
