// Stiffness and volumes of several cells at once, one a lane: the kernels of cells.hpp as assembly runs them. Longer
// than most headers: all of it is templates on the type of the cell.
#pragma once

#include "fem/cells.hpp"
#include "fem/lanes.hpp"

namespace dygita {

// Matrices of n_lanes cells of n nodes. Of the stiffness the entry of dof (a, p) and (b, q), p <= q, is
// plane[plane_of(p, q)][a][b]: planes of equal axes are symmetric, the entry of (b, q) and (a, p) is the same.
template <int n>
struct CellLanes {
  Lanes plane[6][n][n];  // N/m
  Lanes volume[n];       // m^3, of each node: integrals of the shape functions

  static constexpr int plane_of(int p, int q) { return p == 0 ? q : p + q + 1; }  // xx xy xz yy yz zz
};

// Gradients of the shape functions, axis by axis and point by point; volume of each point.
template <int n, int g>
struct PointLanes {
  Lanes gradient[3][g][n];  // 1/m
  Lanes volume[g];          // m^3
};

struct JacobianLanes {
  Lanes adjugate[3][3], determinant;

  explicit JacobianLanes(const Lanes (&j)[3][3]) {
    for (int p = 0; p < 3; ++p) {
      const int q = (p + 1) % 3, r = (p + 2) % 3;
      for (int s = 0; s < 3; ++s) {
        const int t = (s + 1) % 3, u = (s + 2) % 3;
        adjugate[s][p] = j[q][t] * j[r][u] - j[q][u] * j[r][t];
      }
    }
    determinant = j[0][0] * adjugate[0][0] + j[0][1] * adjugate[1][0] + j[0][2] * adjugate[2][0];
  }
};

template <class Cell, int n = Cell::n_nodes, int g>
void find_points(const ShapeTable<n, g>& shapes, const Lanes (&x)[n][3], PointLanes<n, g>& points, Lanes (&mean)[3][3],
                 Lanes (&node_volume)[n]) {
  for (auto& row : mean)
    for (Lanes& entry : row) entry = Lanes{};
  for (Lanes& volume : node_volume) volume = Lanes{};
  for (int i = 0; i < g; ++i) {
    Lanes j[3][3] = {};
    for (int a = 0; a < n; ++a)
      for (int p = 0; p < 3; ++p)
        for (int r = 0; r < 3; ++r) j[p][r] += x[a][p] * shapes.slopes[i](a, r);
    for (int p = 0; p < 3; ++p)
      for (int r = 0; r < 3; ++r) mean[p][r] += j[p][r] / g;
    const JacobianLanes jacobian(j);
    for (int lane = 0; lane < n_lanes; ++lane) check_point_volume(jacobian.determinant[lane]);
    const Lanes inverse = 1.0 / jacobian.determinant;
    points.volume[i] = jacobian.determinant * shapes.weights[i];
    for (int p = 0; p < 3; ++p) {
      Lanes column[3];
      for (int r = 0; r < 3; ++r) column[r] = jacobian.adjugate[r][p] * inverse;
      for (int a = 0; a < n; ++a)
        points.gradient[p][i][a] = column[0] * shapes.slopes[i](a, 0) + column[1] * shapes.slopes[i](a, 1) +
                                   column[2] * shapes.slopes[i](a, 2);
    }
    for (int a = 0; a < n; ++a) node_volume[a] += points.volume[i] * shapes.values(a, i);
  }
}

// sum[a][b] += sign sum_i left[i][a] right[i][b] for a tile of a and b: accumulated in registers.
template <int sign, int tile, int n, int g>
inline void add_tile(const Lanes (&left)[g][n], const Lanes (&right)[g][n], int a0, int b0, Lanes (&sum)[n][n]) {
  Lanes tiles[tile][tile];
#pragma GCC unroll 4
  for (int a = 0; a < tile; ++a)
#pragma GCC unroll 4
    for (int b = 0; b < tile; ++b) tiles[a][b] = sum[a0 + a][b0 + b];
  for (int i = 0; i < g; ++i)
#pragma GCC unroll 4
    for (int a = 0; a < tile; ++a)
#pragma GCC unroll 4
      for (int b = 0; b < tile; ++b) {
        if constexpr (sign > 0)
          tiles[a][b] += left[i][a0 + a] * right[i][b0 + b];
        else
          tiles[a][b] -= left[i][a0 + a] * right[i][b0 + b];
      }
#pragma GCC unroll 4
  for (int a = 0; a < tile; ++a)
#pragma GCC unroll 4
    for (int b = 0; b < tile; ++b) sum[a0 + a][b0 + b] = tiles[a][b];
}

// The largest that divides n and fits the registers.
constexpr int tile_of(int n) {
  int tile = 4;
  while (n % tile != 0) --tile;
  return tile;
}

// The whole of sum, or its tiles on and below the diagonal.
template <int sign, int n, int g>
inline void add_product(const Lanes (&left)[g][n], const Lanes (&right)[g][n], bool lower, Lanes (&sum)[n][n]) {
  constexpr int tile = tile_of(n);
  for (int a0 = 0; a0 < n; a0 += tile)
    for (int b0 = 0; b0 < (lower ? a0 + tile : n); b0 += tile) add_tile<sign, tile>(left, right, a0, b0, sum);
}

// From the points: lambda g_a g_b^T + mu g_b g_a^T + mu (g_a . g_b) I. Less what the eliminated modes take: `modes` of
// them, [axis][mode][node], as they are and scaled by their inverse pivots. Only tiles on and below the diagonal of
// planes of equal axes are computed.
template <int n, int g, int modes>
void sum_points(const PointLanes<n, g>& points, const Lanes (*scaled)[modes][n], const Lanes (*condensed)[modes][n],
                double lambda, double mu, CellLanes<n>& matrices) {
  using Matrix = CellLanes<n>;
  Lanes weighted[3][g][n];
  for (int p = 0; p < 3; ++p)
    for (int i = 0; i < g; ++i)
      for (int a = 0; a < n; ++a) weighted[p][i][a] = points.volume[i] * points.gradient[p][i][a];
  Lanes shear[n][n] = {};
  for (int p = 0; p < 3; ++p) {
    auto& diagonal = matrices.plane[Matrix::plane_of(p, p)];
    for (auto& row : diagonal)
      for (Lanes& entry : row) entry = Lanes{};
    add_product<1>(weighted[p], points.gradient[p], true, diagonal);
    for (int a = 0; a < n; ++a)
      for (int b = 0; b <= a; ++b) shear[a][b] += mu * diagonal[a][b];
  }
  for (int p = 0; p < 3; ++p) {
    auto& diagonal = matrices.plane[Matrix::plane_of(p, p)];
    for (int a = 0; a < n; ++a)
      for (int b = 0; b <= a; ++b) diagonal[a][b] = (lambda + mu) * diagonal[a][b] + shear[a][b];
    if constexpr (modes > 1) add_product<-1>(scaled[p], condensed[p], true, diagonal);
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < a; ++b) diagonal[b][a] = diagonal[a][b];
    for (int q = p + 1; q < 3; ++q) {
      Lanes product[n][n] = {};
      add_product<1>(weighted[p], points.gradient[q], false, product);
      auto& plane = matrices.plane[Matrix::plane_of(p, q)];
      for (int a = 0; a < n; ++a)
        for (int b = 0; b < n; ++b) plane[a][b] = lambda * product[a][b] + mu * product[b][a];
      if constexpr (modes > 1) add_product<-1>(scaled[p], condensed[q], false, plane);
    }
  }
}

// x: coordinates (m) of the nodes. Of an isotropic material: others are not in lanes. Throws ContractError where a cell
// is inverted.
template <class Cell>
void stiffness_in_lanes(const Lanes (&x)[Cell::n_nodes][3], const ElasticTensor& tensor,
                        CellLanes<Cell::n_nodes>& matrices) {
  constexpr int n = Cell::n_nodes, g = Cell::n_points;
  PointLanes<n, g> points;
  Lanes mean[3][3];
  const double mu = tensor.mu(), lambda = tensor.lambda();
  find_points<Cell>(Cell::shapes(), x, points, mean, matrices.volume);
  sum_points<n, g, 1>(points, nullptr, nullptr, lambda, mu, matrices);
}

template <>
void stiffness_in_lanes<Hex8>(const Lanes (&x)[8][3], const ElasticTensor& tensor, CellLanes<8>& matrices);

}  // namespace dygita
