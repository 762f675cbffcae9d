#include "fem/cell_lanes.hpp"

#include <cmath>

namespace dygita {

namespace {

constexpr Lanes zero = {};
constexpr int n_modes = 12;  // of the hexahedron's enhanced strains, condensed as in hex8.cpp

// Gradients of the shape functions, axis by axis and point by point; volume of each point.
template <int n, int g>
struct PointLanes {
  Lanes gradient[3][g][n];  // 1/m
  Lanes volume[g];          // m^3
};

struct Jacobian {
  Lanes adjugate[3][3], determinant;

  explicit Jacobian(const Lanes (&j)[3][3]) {
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
    for (Lanes& entry : row) entry = zero;
  for (Lanes& volume : node_volume) volume = zero;
  for (int i = 0; i < g; ++i) {
    Lanes j[3][3] = {};
    for (int a = 0; a < n; ++a)
      for (int p = 0; p < 3; ++p)
        for (int r = 0; r < 3; ++r) j[p][r] += x[a][p] * shapes.slopes[i](a, r);
    for (int p = 0; p < 3; ++p)
      for (int r = 0; r < 3; ++r) mean[p][r] += j[p][r] / g;
    const Jacobian jacobian(j);
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

// The whole of sum, or its tiles on and below the diagonal.
template <int sign, int n, int g>
inline void add_product(const Lanes (&left)[g][n], const Lanes (&right)[g][n], bool lower, Lanes (&sum)[n][n]) {
  constexpr int tile = n % 4 == 0 ? 4 : 3;
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
      for (Lanes& entry : row) entry = zero;
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

// What the mode functions xi_1 xi_2 xi_3 xi_2 xi_3 xi_3 xi_1 xi_1 xi_2 sum to over the points in the order of the
// nodes, times f: sums and differences of pairs, since each is a constant with a sign.
inline void sum_modes(const Lanes (&f)[8][8], int a, Lanes scale, double s, Lanes (&sums)[6][8]) {
  const Lanes s0 = f[0][a] + f[1][a], s1 = f[3][a] + f[2][a], s2 = f[4][a] + f[5][a], s3 = f[7][a] + f[6][a];
  const Lanes d0 = f[1][a] - f[0][a], d1 = f[2][a] - f[3][a], d2 = f[5][a] - f[4][a], d3 = f[6][a] - f[7][a];
  const Lanes one = s * scale, two = s * one;
  sums[0][a] = one * ((d0 + d1) + (d2 + d3));
  sums[1][a] = one * ((s1 - s0) + (s3 - s2));
  sums[2][a] = one * ((s2 + s3) - (s0 + s1));
  sums[3][a] = two * ((s3 - s2) - (s1 - s0));
  sums[4][a] = two * ((d2 + d3) - (d0 + d1));
  sums[5][a] = two * ((d1 - d0) + (d3 - d2));
}

// Stiffness of the modes and its factor L D L^T: unit lower triangle, and 1 / D on the diagonal.
struct ModeLanes {
  Lanes at[n_modes][n_modes];

  ModeLanes(const PointLanes<8, 8>& points, const Lanes (&centre)[3][3], Lanes j_centre, double lambda, double mu) {
    const auto& xi = hex8_shapes().points;
    double function[8][6];
    for (int i = 0; i < 8; ++i) {
      for (int k = 0; k < 3; ++k) function[i][k] = xi(k, i);
      for (int k = 0; k < 3; ++k) function[i][3 + k] = xi((k + 1) % 3, i) * xi((k + 2) % 3, i);
    }
    Lanes product[6][6];
    for (int k = 0; k < 6; ++k)
      for (int l = 0; l <= k; ++l) product[k][l] = zero;
    for (int i = 0; i < 8; ++i) {
      const Lanes weight = j_centre * j_centre / points.volume[i];
      for (int k = 0; k < 6; ++k)
        for (int l = 0; l <= k; ++l) product[k][l] += weight * (function[i][k] * function[i][l]);
    }
    // centre[j]: gradient of xi_j.
    for (int j = 0; j < 3; ++j)
      for (int l = 0; l <= j; ++l) {
        const auto &g = centre[j], &h = centre[l];
        const Lanes metric = g[0] * h[0] + g[1] * h[1] + g[2] * h[2];
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c) {
            Lanes entry = lambda * g[r] * h[c] + mu * h[r] * g[c];
            if (r == c) entry += mu * metric;
            at[3 * j + r][3 * l + c] = product[j][l] * entry;
          }
      }
    const double bulk = 3 * lambda + 2 * mu;
    for (int k = 0; k < 3; ++k) {
      for (int j = 0; j < 3; ++j)
        for (int c = 0; c < 3; ++c) at[9 + k][3 * j + c] = bulk * product[3 + k][j] * centre[j][c];
      for (int l = 0; l <= k; ++l) at[9 + k][9 + l] = 3 * bulk * product[3 + k][3 + l];
    }
    for (int m = 0; m < n_modes; ++m) {
      const Lanes inverse = 1.0 / at[m][m];
      for (int r = m + 1; r < n_modes; ++r) {
        const Lanes entry = at[r][m];
        at[r][m] = entry * inverse;
        for (int c = m + 1; c <= r; ++c) at[r][c] -= c == r ? entry * at[r][m] : entry * at[c][m];
      }
      at[m][m] = inverse;
    }
  }
};

// Coupling of the modes with the nodes along each axis, after elimination: [axis][mode][node]; and scaled by 1 / D.
void couple(const PointLanes<8, 8>& points, const Lanes (&centre)[3][3], Lanes j_centre, double lambda, double mu,
            const ModeLanes& modes, Lanes (&coupling)[3][n_modes][8], Lanes (&scaled)[3][n_modes][8]) {
  Lanes by_axis[3][6][8];  // integral of each mode function times d N / d x_p
  const double s = std::abs(hex8_shapes().points(0, 0));
  for (int p = 0; p < 3; ++p)
    for (int a = 0; a < 8; ++a) sum_modes(points.gradient[p], a, j_centre, s, by_axis[p]);
  const double bulk = 3 * lambda + 2 * mu;
  for (int a = 0; a < 8; ++a) {
    Lanes along[3];
    for (int j = 0; j < 3; ++j)
      along[j] =
          mu * (centre[j][0] * by_axis[0][j][a] + centre[j][1] * by_axis[1][j][a] + centre[j][2] * by_axis[2][j][a]);
    for (int q = 0; q < 3; ++q) {
      Lanes column[n_modes];
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) {
          column[3 * j + i] = lambda * centre[j][i] * by_axis[q][j][a] + mu * centre[j][q] * by_axis[i][j][a];
          if (i == q) column[3 * j + i] += along[j];
        }
      for (int k = 0; k < 3; ++k) column[9 + k] = bulk * by_axis[q][3 + k][a];
#pragma GCC unroll 12
      for (int m = 0; m < n_modes; ++m)
#pragma GCC unroll 12
        for (int r = m + 1; r < n_modes; ++r) column[r] -= modes.at[r][m] * column[m];
      for (int m = 0; m < n_modes; ++m) {
        coupling[q][m][a] = column[m];
        scaled[q][m][a] = column[m] * modes.at[m][m];
      }
    }
  }
}

template <class Cell, int n = Cell::n_nodes>
void isoparametric(const Lanes (&x)[n][3], const Elastic& material, CellLanes<n>& matrices) {
  const auto& shapes = Cell::shapes();
  PointLanes<n, std::decay_t<decltype(shapes)>::n_points> points;
  Lanes mean[3][3];
  const double mu = material.shear_modulus(), lambda = material.p_wave_modulus() - 2 * mu;
  find_points<Cell>(shapes, x, points, mean, matrices.volume);
  sum_points<n, std::decay_t<decltype(shapes)>::n_points, 1>(points, nullptr, nullptr, lambda, mu, matrices);
}

}  // namespace

template <>
void stiffness_in_lanes<Hex8>(const Lanes (&x)[8][3], const Elastic& material, CellLanes<8>& matrices) {
  const double mu = material.shear_modulus(), lambda = material.p_wave_modulus() - 2 * mu;
  PointLanes<8, 8> points;
  Lanes mean[3][3], centre[3][3];  // the Jacobian at the centre is the mean over the points
  find_points<Hex8>(hex8_shapes(), x, points, mean, matrices.volume);
  const Jacobian jacobian(mean);
  for (int j = 0; j < 3; ++j)
    for (int p = 0; p < 3; ++p) centre[j][p] = jacobian.adjugate[j][p] / jacobian.determinant;
  const ModeLanes modes(points, centre, jacobian.determinant, lambda, mu);
  Lanes coupling[3][n_modes][8], scaled[3][n_modes][8];
  couple(points, centre, jacobian.determinant, lambda, mu, modes, coupling, scaled);
  sum_points<8, 8, n_modes>(points, scaled, coupling, lambda, mu, matrices);
}

template <>
void stiffness_in_lanes<Prism6>(const Lanes (&x)[6][3], const Elastic& material, CellLanes<6>& matrices) {
  isoparametric<Prism6>(x, material, matrices);
}

template <>
void stiffness_in_lanes<Tet4>(const Lanes (&x)[4][3], const Elastic& material, CellLanes<4>& matrices) {
  isoparametric<Tet4>(x, material, matrices);
}

}  // namespace dygita
