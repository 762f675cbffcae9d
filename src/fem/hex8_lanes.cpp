// Hex8 in lanes, its enhanced strains condensed as in hex8.cpp.
#include <cmath>

#include "fem/cell_lanes.hpp"
#include "fem/hex8_modes.hpp"

namespace dygita {

namespace {

constexpr Lanes zero = {};

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
  Lanes at[n_hex8_modes][n_hex8_modes];

  ModeLanes(const PointLanes<8, 8>& points, const Lanes (&centre)[3][3], Lanes j_centre, double lambda, double mu) {
    const auto& xi = Hex8::shapes().points;
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
    for (int m = 0; m < n_hex8_modes; ++m) {
      const Lanes inverse = 1.0 / at[m][m];
      for (int r = m + 1; r < n_hex8_modes; ++r) {
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
            const ModeLanes& modes, Lanes (&coupling)[3][n_hex8_modes][8], Lanes (&scaled)[3][n_hex8_modes][8]) {
  Lanes by_axis[3][6][8];  // integral of each mode function times d N / d x_p
  const double s = std::abs(Hex8::shapes().points(0, 0));
  for (int p = 0; p < 3; ++p)
    for (int a = 0; a < 8; ++a) sum_modes(points.gradient[p], a, j_centre, s, by_axis[p]);
  const double bulk = 3 * lambda + 2 * mu;
  for (int a = 0; a < 8; ++a) {
    Lanes along[3];
    for (int j = 0; j < 3; ++j)
      along[j] =
          mu * (centre[j][0] * by_axis[0][j][a] + centre[j][1] * by_axis[1][j][a] + centre[j][2] * by_axis[2][j][a]);
    for (int q = 0; q < 3; ++q) {
      Lanes column[n_hex8_modes];
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) {
          column[3 * j + i] = lambda * centre[j][i] * by_axis[q][j][a] + mu * centre[j][q] * by_axis[i][j][a];
          if (i == q) column[3 * j + i] += along[j];
        }
      for (int k = 0; k < 3; ++k) column[9 + k] = bulk * by_axis[q][3 + k][a];
#pragma GCC unroll 12
      for (int m = 0; m < n_hex8_modes; ++m)
#pragma GCC unroll 12
        for (int r = m + 1; r < n_hex8_modes; ++r) column[r] -= modes.at[r][m] * column[m];
      for (int m = 0; m < n_hex8_modes; ++m) {
        coupling[q][m][a] = column[m];
        scaled[q][m][a] = column[m] * modes.at[m][m];
      }
    }
  }
}

}  // namespace

template <>
void stiffness_in_lanes<Hex8>(const Lanes (&x)[8][3], const Elastic& material, CellLanes<8>& matrices) {
  const double mu = material.shear_modulus(), lambda = material.p_wave_modulus() - 2 * mu;
  PointLanes<8, 8> points;
  Lanes mean[3][3], centre[3][3];  // the Jacobian at the centre is the mean over the points
  find_points<Hex8>(Hex8::shapes(), x, points, mean, matrices.volume);
  const JacobianLanes jacobian(mean);
  for (int j = 0; j < 3; ++j)
    for (int p = 0; p < 3; ++p) centre[j][p] = jacobian.adjugate[j][p] / jacobian.determinant;
  const ModeLanes modes(points, centre, jacobian.determinant, lambda, mu);
  Lanes coupling[3][n_hex8_modes][8], scaled[3][n_hex8_modes][8];
  couple(points, centre, jacobian.determinant, lambda, mu, modes, coupling, scaled);
  sum_points<8, 8, n_hex8_modes>(points, scaled, coupling, lambda, mu, matrices);
}

}  // namespace dygita
