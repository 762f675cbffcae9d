// Reference elements of order two: corners, then the middles of the edges, then those of the facets, then that of the
// cell, in VTK's order. Monomials: of total degree two on a simplex; products of 1, x, x^2 on hex27 and quad9; those of
// superlinear degree two on hex20 and quad8 (D. N. Arnold, G. Awanou, Found. Comput. Math. 11, 2011).
#pragma once

#include "mesh/reference_elements.hpp"

namespace dygita::reference {

inline constexpr Place line3_nodes[] = {{-1}, {1}, {0}};
inline constexpr Place tri6_nodes[] = {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}};
// quad8: the first eight.
inline constexpr Place quad9_nodes[] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, 0}};
inline constexpr Place tet10_nodes[] = {{0, 0, 0},     {1, 0, 0},   {0, 1, 0},   {0, 0, 1},     {0.5, 0, 0},
                                        {0.5, 0.5, 0}, {0, 0.5, 0}, {0, 0, 0.5}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
// hex20: the first twenty.
inline constexpr Place hex27_nodes[] = {
    {-1, -1, -1}, {1, -1, -1}, {1, 1, -1},  {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1},  {-1, 1, 1},  {0, -1, -1},
    {1, 0, -1},   {0, 1, -1},  {-1, 0, -1}, {0, -1, 1},  {1, 0, 1},   {0, 1, 1},  {-1, 0, 1}, {-1, -1, 0}, {1, -1, 0},
    {1, 1, 0},    {-1, 1, 0},  {-1, 0, 0},  {1, 0, 0},   {0, -1, 0},  {0, 1, 0},  {0, 0, -1}, {0, 0, 1},   {0, 0, 0}};
// prism15: the first fifteen.
inline constexpr Place prism18_nodes[] = {{0, 0, -1},    {0, 1, -1},    {1, 0, -1},     {0, 0, 1},    {0, 1, 1},
                                          {1, 0, 1},     {0, 0.5, -1},  {0.5, 0.5, -1}, {0.5, 0, -1}, {0, 0.5, 1},
                                          {0.5, 0.5, 1}, {0.5, 0, 1},   {0, 0, 0},      {0, 1, 0},    {1, 0, 0},
                                          {0, 0.5, 0},   {0.5, 0.5, 0}, {0.5, 0, 0}};

// The first of each: those of a segment (3), of a triangle (6), of a tetrahedron (10), and what prism15 has beside
// them.
inline constexpr Exponents quadratic[] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0},
                                          {0, 2, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {0, 0, 2},
                                          {2, 0, 1}, {1, 1, 1}, {0, 2, 1}, {1, 0, 2}, {0, 1, 2}};
inline constexpr Exponents quad8_monomials[] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}, {2, 0}, {0, 2}, {2, 1}, {1, 2}};
inline constexpr Exponents hex20_monomials[] = {
    {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}, {1, 1, 1}, {2, 0, 0}, {0, 2, 0},
    {0, 0, 2}, {2, 1, 0}, {2, 0, 1}, {2, 1, 1}, {1, 2, 0}, {0, 2, 1}, {1, 2, 1}, {1, 0, 2}, {0, 1, 2}, {1, 1, 2}};

inline constexpr std::span<const Place> quad8_nodes{quad9_nodes, 8}, hex20_nodes{hex27_nodes, 20},
    prism15_nodes{prism18_nodes, 15};
inline constexpr std::span<const Exponents> quadratic_1{quadratic, 3}, quadratic_2{quadratic, 6},
    quadratic_3{quadratic, 10}, prism15_monomials{quadratic, 15};

inline constexpr ShapeFactor tri6_factors[] = {{0, 2, tri6_nodes, quadratic_2}};
inline constexpr ShapeFactor quad8_factors[] = {{0, 2, quad8_nodes, quad8_monomials}};
inline constexpr ShapeFactor hex27_factors[] = {
    {0, 1, line3_nodes, quadratic_1}, {1, 1, line3_nodes, quadratic_1}, {2, 1, line3_nodes, quadratic_1}};
inline constexpr std::span<const ShapeFactor> quad9_factors{hex27_factors, 2};
inline constexpr ShapeFactor tet10_factors[] = {{0, 3, tet10_nodes, quadratic_3}};
inline constexpr ShapeFactor hex20_factors[] = {{0, 3, hex20_nodes, hex20_monomials}};
inline constexpr ShapeFactor prism15_factors[] = {{0, 3, prism15_nodes, prism15_monomials}};
inline constexpr ShapeFactor prism18_factors[] = {{0, 2, tri6_nodes, quadratic_2}, {2, 1, line3_nodes, quadratic_1}};

inline constexpr ShapeSpace tri6{tri6_nodes, tri6_factors}, quad8{quad8_nodes, quad8_factors},
    quad9{quad9_nodes, quad9_factors}, tet10{tet10_nodes, tet10_factors}, hex20{hex20_nodes, hex20_factors},
    hex27{hex27_nodes, hex27_factors}, prism15{prism15_nodes, prism15_factors}, prism18{prism18_nodes, prism18_factors};

// Three Gauss points an axis; six points of a triangle, exact to degree four (D. A. Dunavant, Int. J. Numer. Methods
// Eng. 21, 1985).
inline constexpr double gauss_3 = 0.77459666924148337704;  // sqrt(3/5)
inline constexpr double at_3[] = {-gauss_3, 0.0, gauss_3}, weight_3[] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
inline constexpr double inner = 0.44594849091596488632, outer = 0.09157621350977074346;
inline constexpr double inner_weight = 0.11169079483900573285, outer_weight = 0.05497587182766093382;
inline constexpr QuadraturePoint triangle_6_points[] = {
    {{inner, inner}, inner_weight}, {{1 - 2 * inner, inner}, inner_weight}, {{inner, 1 - 2 * inner}, inner_weight},
    {{outer, outer}, outer_weight}, {{1 - 2 * outer, outer}, outer_weight}, {{outer, 1 - 2 * outer}, outer_weight}};

inline constexpr auto square_9_points = [] {
  std::array<QuadraturePoint, 9> points{};
  for (size_t i = 0; i < 9; ++i) points[i] = {{at_3[i % 3], at_3[i / 3]}, weight_3[i % 3] * weight_3[i / 3]};
  return points;
}();
inline constexpr auto cube_27_points = [] {
  std::array<QuadraturePoint, 27> points{};
  for (size_t i = 0; i < 27; ++i)
    points[i] = {{at_3[i % 3], at_3[i / 3 % 3], at_3[i / 9]}, weight_3[i % 3] * weight_3[i / 3 % 3] * weight_3[i / 9]};
  return points;
}();
inline constexpr auto prism_18_points = [] {
  std::array<QuadraturePoint, 18> points{};
  for (size_t i = 0; i < 18; ++i) {
    const QuadraturePoint& in_triangle = triangle_6_points[i % 6];
    points[i] = {{in_triangle.at[0], in_triangle.at[1], at_3[i / 6]}, in_triangle.weight * weight_3[i / 6]};
  }
  return points;
}();

// Corners and middles of the facets, exact to degree three: what the patch test of a curved cell needs.
inline constexpr double at_corner = 1.0 / 240, at_facet = 9.0 / 240;
inline constexpr QuadraturePoint tetrahedron_8_points[] = {
    {{0, 0, 0}, at_corner},        {{1, 0, 0}, at_corner},           {{0, 1, 0}, at_corner},
    {{0, 0, 1}, at_corner},        {{third, third, 0}, at_facet},    {{third, 0, third}, at_facet},
    {{0, third, third}, at_facet}, {{third, third, third}, at_facet}};
// Exact to degree five (N. J. Walkington, Quadrature on simplices of arbitrary dimension, 2000).
inline constexpr auto tetrahedron_14_points = [] {
  constexpr double at[] = {0.31088591926330060980, 0.09273525031089122640}, half_way = 0.04550370412564964949;
  constexpr double weight[] = {0.018781320953002641800, 0.012248840519393658257}, edge = 0.0070910034628469110730;
  std::array<QuadraturePoint, 14> points{};
  size_t n = 0;
  for (int k = 0; k < 2; ++k)
    for (size_t corner = 0; corner < 4; ++corner) {
      points[n] = {{at[k], at[k], at[k]}, weight[k]};
      if (corner < 3) points[n].at[corner] = 1 - 3 * at[k];
      ++n;
    }
  for (size_t a = 0; a < 4; ++a)
    for (size_t b = 0; b < a; ++b) {
      points[n] = {{half_way, half_way, half_way}, edge};
      for (const size_t corner : {a, b})
        if (corner < 3) points[n].at[corner] = 0.5 - half_way;
      ++n;
    }
  return points;
}();

inline constexpr QuadratureRule triangle_6{triangle_6_points, 4}, square_9{square_9_points, 5},
    cube_27{cube_27_points, 5}, prism_18{prism_18_points, 4}, tetrahedron_8{tetrahedron_8_points, 3},
    tetrahedron_14{tetrahedron_14_points, 5};

}  // namespace dygita::reference
