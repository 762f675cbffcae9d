// Reference elements: their nodes, the monomials that their shape functions are made of, their quadrature. What a row
// of cell_types.hpp is put together from.
#pragma once

#include <array>
#include <numbers>
#include <span>

namespace dygita {

using Place = std::array<double, 3>;   // reference coordinates; 0 along axes that an element does not have
using Exponents = std::array<int, 3>;  // of a monomial

// Functions of the reference coordinates first_axis .. first_axis + n_axes - 1: the combinations of the monomials that
// are 1 at one node and 0 at the others. As many monomials as nodes.
struct ShapeFactor {
  int first_axis, n_axes;
  std::span<const Place> nodes;
  std::span<const Exponents> monomials;
};

// Shape functions of an element: products of one function of each factor. A node of the element is, along each factor's
// axes, at one of the factor's nodes.
struct ShapeSpace {
  std::span<const Place> nodes;
  std::span<const ShapeFactor> factors;
};

struct QuadraturePoint {
  Place at;
  double weight;  // the sum is the volume, or area, of the reference element
};

struct QuadratureRule {
  std::span<const QuadraturePoint> points;
  int degree;  // exact for polynomials of this total degree
};

namespace reference {

// Segment [-1, 1], unit triangle and unit tetrahedron with the functions linear on them, a point with the constant.
inline constexpr Place line2_nodes[] = {{-1}, {1}};
inline constexpr Place tri3_nodes[] = {{0, 0}, {1, 0}, {0, 1}};
inline constexpr Place tet4_nodes[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
inline constexpr Place point_nodes[] = {{0, 0, 0}};
inline constexpr Exponents linear[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
inline constexpr std::span<const Exponents> linear_1{linear, 2}, linear_2{linear, 3}, linear_3{linear, 4};
inline constexpr std::span<const Exponents> constant{linear, 1};

// Cube [-1, 1]^3, square [-1, 1]^2, prism of the unit triangle over [-1, 1]. Nodes 1 and 2 of the prism are at (0, 1)
// and (1, 0), as in vtkWedge, whose first triangle turns clockwise seen from the second.
inline constexpr Place hex8_nodes[] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                       {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
inline constexpr Place quad4_nodes[] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
inline constexpr Place prism6_nodes[] = {{0, 0, -1}, {0, 1, -1}, {1, 0, -1}, {0, 0, 1}, {0, 1, 1}, {1, 0, 1}};

inline constexpr ShapeFactor hex8_factors[] = {
    {0, 1, line2_nodes, linear_1}, {1, 1, line2_nodes, linear_1}, {2, 1, line2_nodes, linear_1}};
inline constexpr ShapeFactor prism6_factors[] = {{0, 2, tri3_nodes, linear_2}, {2, 1, line2_nodes, linear_1}};
inline constexpr ShapeFactor tet4_factors[] = {{0, 3, tet4_nodes, linear_3}};
inline constexpr ShapeFactor quad4_factors[] = {{0, 1, line2_nodes, linear_1}, {1, 1, line2_nodes, linear_1}};
inline constexpr ShapeFactor tri3_factors[] = {{0, 2, tri3_nodes, linear_2}};
inline constexpr ShapeFactor point_factors[] = {{0, 3, point_nodes, constant}};

inline constexpr ShapeSpace hex8{hex8_nodes, hex8_factors}, prism6{prism6_nodes, prism6_factors},
    tet4{tet4_nodes, tet4_factors}, quad4{quad4_nodes, quad4_factors}, tri3{tri3_nodes, tri3_factors},
    point{point_nodes, point_factors};

// Gauss points; those of the cube in the order of its nodes.
inline constexpr double g = 1.0 / std::numbers::sqrt3;
inline constexpr QuadraturePoint cube_8_points[] = {{{-g, -g, -g}, 1}, {{g, -g, -g}, 1}, {{g, g, -g}, 1},
                                                    {{-g, g, -g}, 1},  {{-g, -g, g}, 1}, {{g, -g, g}, 1},
                                                    {{g, g, g}, 1},    {{-g, g, g}, 1}};
inline constexpr QuadraturePoint square_4_points[] = {{{-g, -g}, 1}, {{-g, g}, 1}, {{g, -g}, 1}, {{g, g}, 1}};

inline constexpr double sixth = 1.0 / 6, third = 1.0 / 3, two_thirds = 2.0 / 3;
inline constexpr QuadraturePoint prism_6_points[] = {{{sixth, sixth, -g}, sixth},      {{sixth, two_thirds, -g}, sixth},
                                                     {{two_thirds, sixth, -g}, sixth}, {{sixth, sixth, g}, sixth},
                                                     {{sixth, two_thirds, g}, sixth},  {{two_thirds, sixth, g}, sixth}};
inline constexpr QuadraturePoint triangle_1_point[] = {{{third, third}, 0.5}};
inline constexpr QuadraturePoint tetrahedron_1_point[] = {{{0.25, 0.25, 0.25}, sixth}};
// (5 - sqrt 5) / 20 and (5 + 3 sqrt 5) / 20, by the golden ratio.
inline constexpr double near = (1.0 + 3.0 * std::numbers::phi) / 10.0, far = (3.0 - std::numbers::phi) / 10.0;
inline constexpr QuadraturePoint tetrahedron_4_points[] = {{{far, far, far}, sixth / 4},
                                                           {{near, far, far}, sixth / 4},
                                                           {{far, near, far}, sixth / 4},
                                                           {{far, far, near}, sixth / 4}};

inline constexpr QuadratureRule cube_8{cube_8_points, 3}, square_4{square_4_points, 3}, prism_6{prism_6_points, 2},
    triangle_1{triangle_1_point, 1}, tetrahedron_1{tetrahedron_1_point, 1}, tetrahedron_4{tetrahedron_4_points, 2};

}  // namespace reference

}  // namespace dygita
