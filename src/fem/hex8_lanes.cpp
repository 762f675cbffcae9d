// Hex8 in lanes, its enhanced strains condensed as in hex8.cpp.
#include <algorithm>
#include <cmath>

#include "fem/cell_lanes.hpp"
#include "fem/cell_stress.hpp"
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

// Point by point: displacement gradient [p][q] = d u_p / d x_q, and its stress xx yy zz xy yz zx.
struct StrainLanes {
  Lanes gradient[8][3][3];

  StrainLanes(const PointLanes<8, 8>& points, const Lanes (&u)[8][3]) {
    for (int i = 0; i < 8; ++i)
      for (int p = 0; p < 3; ++p)
        for (int q = 0; q < 3; ++q) {
          gradient[i][p][q] = zero;
          for (int a = 0; a < 8; ++a) gradient[i][p][q] += u[a][p] * points.gradient[q][i][a];
        }
  }
  Lanes trace(int i) const { return gradient[i][0][0] + gradient[i][1][1] + gradient[i][2][2]; }
  void stress(int i, double lambda, double mu, Lanes (&s)[6]) const {
    const auto& g = gradient[i];
    const Lanes pressure = lambda * trace(i);
    for (int p = 0; p < 3; ++p) {
      const int q = (p + 1) % 3;
      s[p] = pressure + 2 * mu * g[p][p];
      s[3 + p] = mu * (g[p][q] + g[q][p]);
    }
  }
};

// What the strains of the nodes do on the modes: the product of the coupling and the displacements, without the former.
void mode_forces(const StrainLanes& strains, const Lanes (&centre)[3][3], Lanes j_centre, double lambda, double mu,
                 Lanes (&force)[n_hex8_modes]) {
  const auto& xi = Hex8::shapes().points;
  Lanes sum[3][6] = {}, dilated[3] = {};
  for (int i = 0; i < 8; ++i) {
    Lanes s[6];
    strains.stress(i, lambda, mu, s);
    const Lanes trace = strains.trace(i);
    for (int k = 0; k < 3; ++k) {
      for (int c = 0; c < 6; ++c) sum[k][c] += xi(k, i) * s[c];
      dilated[k] += xi((k + 1) % 3, i) * xi((k + 2) % 3, i) * trace;
    }
  }
  for (int j = 0; j < 3; ++j) {
    const auto& g = centre[j];
    const auto& s = sum[j];
    force[3 * j] = j_centre * (s[0] * g[0] + s[3] * g[1] + s[5] * g[2]);
    force[3 * j + 1] = j_centre * (s[3] * g[0] + s[1] * g[1] + s[4] * g[2]);
    force[3 * j + 2] = j_centre * (s[5] * g[0] + s[4] * g[1] + s[2] * g[2]);
    force[9 + j] = (3 * lambda + 2 * mu) * j_centre * dilated[j];
  }
}

// Adds what the modes strain where nothing pushes them: amplitudes -A^-1 force.
void add_modes(const ModeLanes& modes, const PointLanes<8, 8>& points, const Lanes (&centre)[3][3], Lanes j_centre,
               Lanes (&force)[n_hex8_modes], StrainLanes& strains) {
  for (int m = 0; m < n_hex8_modes; ++m)
    for (int r = m + 1; r < n_hex8_modes; ++r) force[r] -= modes.at[r][m] * force[m];
  for (int m = 0; m < n_hex8_modes; ++m) force[m] *= -modes.at[m][m];
  for (int m = n_hex8_modes - 1; m > 0; --m)
    for (int r = 0; r < m; ++r) force[r] -= modes.at[m][r] * force[m];
  const auto& xi = Hex8::shapes().points;
  for (int i = 0; i < 8; ++i) {
    const Lanes scale = j_centre / points.volume[i];
    Lanes dilation = zero;
    for (int k = 0; k < 3; ++k) dilation += xi((k + 1) % 3, i) * xi((k + 2) % 3, i) * force[9 + k];
    for (int p = 0; p < 3; ++p) {
      for (int j = 0; j < 3; ++j) {
        const Lanes along = xi(j, i) * scale * force[3 * j + p];
        for (int q = 0; q < 3; ++q) strains.gradient[i][p][q] += along * centre[j][q];
      }
      strains.gradient[i][p][p] += scale * dilation;
    }
  }
}

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

// Points and centre of cells with nodes at x (m).
struct GeometryLanes {
  PointLanes<8, 8> points;
  Lanes volume[8], centre[3][3], j_centre;

  explicit GeometryLanes(const Lanes (&x)[8][3]) {
    Lanes mean[3][3];  // the Jacobian at the centre is the mean over the points
    find_points<Hex8>(Hex8::shapes(), x, points, mean, volume);
    const JacobianLanes jacobian(mean);
    j_centre = jacobian.determinant;
    for (int j = 0; j < 3; ++j)
      for (int p = 0; p < 3; ++p) centre[j][p] = jacobian.adjugate[j][p] / j_centre;
  }
};

}  // namespace

template <>
void stiffness_in_lanes<Hex8>(const Lanes (&x)[8][3], const ElasticTensor& tensor, CellLanes<8>& matrices) {
  const double mu = tensor.mu(), lambda = tensor.lambda();
  const GeometryLanes cells(x);
  std::copy(cells.volume, cells.volume + 8, matrices.volume);
  const ModeLanes modes(cells.points, cells.centre, cells.j_centre, lambda, mu);
  Lanes coupling[3][n_hex8_modes][8], scaled[3][n_hex8_modes][8];
  couple(cells.points, cells.centre, cells.j_centre, lambda, mu, modes, coupling, scaled);
  sum_points<8, 8, n_hex8_modes>(cells.points, scaled, coupling, lambda, mu, matrices);
}

template <>
void stresses_of<Hex8>(const CellFields& fields, std::span<const int* const> cells, CornerStress<8>* stress) {
  if (!fields.material.is_isotropic()) return stresses_one_by_one<Hex8>(fields, cells, stress);
  const double mu = fields.material.tensor().mu(), lambda = fields.material.tensor().lambda();
  const int n_cells = static_cast<int>(cells.size());
  for (int first = 0; first < n_cells; first += n_lanes) {
    Lanes x[8][3], u[8][3];
    for (int lane = 0; lane < n_lanes; ++lane) {
      const int* nodes = cells[static_cast<size_t>(std::min(first + lane, n_cells - 1))];
      for (int a = 0; a < 8; ++a)
        for (int p = 0; p < 3; ++p) {
          x[a][p][lane] = fields.nodes(p, nodes[a]) - fields.nodes(p, nodes[0]);
          u[a][p][lane] = fields.displacement(p, nodes[a]) - fields.displacement(p, nodes[0]);
        }
    }
    const GeometryLanes geometry(x);
    StrainLanes strains(geometry.points, u);
    Lanes force[n_hex8_modes];
    mode_forces(strains, geometry.centre, geometry.j_centre, lambda, mu, force);
    const ModeLanes modes(geometry.points, geometry.centre, geometry.j_centre, lambda, mu);
    add_modes(modes, geometry.points, geometry.centre, geometry.j_centre, force, strains);
    Lanes at_nodes[8][6] = {};
    for (int i = 0; i < 8; ++i) {
      Lanes s[6];
      strains.stress(i, lambda, mu, s);
      for (int a = 0; a < 8; ++a)
        for (int c = 0; c < 6; ++c) at_nodes[a][c] += Hex8::to_nodes()(i, a) * s[c];
    }
    for (int lane = 0; lane < std::min(n_lanes, n_cells - first); ++lane)
      for (int a = 0; a < 8; ++a)
        for (int c = 0; c < 6; ++c) stress[first + lane](c, a) = at_nodes[a][c][lane];
  }
}

}  // namespace dygita
