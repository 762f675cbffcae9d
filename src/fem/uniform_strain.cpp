#include "fem/uniform_strain.hpp"

#include <cmath>

#include "fem/cell_loop.hpp"
#include "numerics/dense.hpp"

namespace dygita {

namespace {

constexpr Lanes zero = {};

// An explicit step needs the mass of each node: others are refused before (model/check_cells.cpp).
template <class Kernel>
auto with_lumped_cell(CellType type, Kernel&& kernel) {
  return with_cell(type, [&](auto cell) {
    using Cell = decltype(cell);
    if constexpr (Cell::row.inertia == Inertia::lumped) return kernel(cell);
    CHECK(Cell::row.inertia == Inertia::lumped, "explicit cells have lumped mass");
    return decltype(kernel(Hex8{}))();
  });
}

// The hourglass vectors of a type, where it has any.
template <class Cell>
struct Hourglass {
  static constexpr int n_modes = 0;
};

// xi_2 xi_3, xi_3 xi_1, xi_1 xi_2, xi_1 xi_2 xi_3 at the corners 0-3; at 4-7 they are minus, minus, plus, minus that.
template <>
struct Hourglass<Hex8> {
  static constexpr int n_modes = 4;
  static constexpr double sign[4][4] = {{1, 1, -1, -1}, {1, -1, -1, 1}, {1, -1, 1, -1}, {-1, 1, -1, 1}};
  static constexpr double mirror_sign[4] = {-1, -1, 1, -1};

  static double vector(int mode, int corner) {
    return corner < 4 ? sign[mode][corner] : mirror_sign[mode] * sign[mode][corner - 4];
  }
  // Forces of the hourglass stiffness on the corners (h), what it takes from the stress x volume (s); twice its energy.
  static Lanes resist(const Lanes (&v)[8][3], const Lanes (&g)[3][3], Lanes stiffness, const Lanes* x_h,
                      Lanes (&s)[3][3], Lanes (&h)[8][3]);
};

// Of one cell: mean gradients of the shape functions (1/m), volume, smallest thickness (m).
template <int n>
struct MeanCell {
  Eigen::Matrix<double, n, 3> gradient = Eigen::Matrix<double, n, 3>::Zero();
  double volume = 0.0, thickness = 0.0, hourglass_scale = 0.0;
};

template <class Cell>
MeanCell<Cell::n_nodes> mean_cell(const Nodes<Cell::n_nodes>& x) {
  constexpr int n = Cell::n_nodes;
  MeanCell<n> mean;
  for (int i = 0; i < Cell::shapes().n_points; ++i) {
    const PointInCell<n> point = point_in_cell(Cell::shapes(), x, i);
    check_point_volume(point.volume);
    mean.gradient += point.volume * point.gradient;
    mean.volume += point.volume;
  }
  mean.gradient /= mean.volume;
  // A plane wave across a brick of thickness L has the gradient's square 4 / (n L^2).
  const Mat3 square = mean.gradient.transpose() * mean.gradient;
  const double largest = principal_axes(square).values[2];
  mean.thickness = 2.0 / std::sqrt(n * largest);
  mean.hourglass_scale = mean.volume * square.trace();
  return mean;
}

}  // namespace

// A geometry in Lanes: n x 3 gradients; volume, hourglass stiffness / 8, linear and quadratic viscosity x volume; three
// projections of each hourglass vector on the coordinates.
struct UniformStrainCells::Loop {
  template <class Cell>
  static constexpr int geometry_size = 3 * Cell::n_nodes + 4 + 3 * Hourglass<Cell>::n_modes;

  template <class Cell>
  static void fill(UniformStrainCells& cells, const Mesh& mesh, const CellBlock& block, const Elastic& material);
  template <class Cell>
  static void set_lane(const UniformStrainCells& cells, const Nodes<Cell::n_nodes>& x, const Elastic& material,
                       int lane, std::vector<Lanes>& geometry);
  template <class Cell, bool has_stress, bool is_viscous, bool has_energy>
  static CellEnergy run(const UniformStrainCells& cells, const double* u, double dt, double* f, Lanes* strain);
};

// x: relative to the cell's first node.
template <class Cell>
void UniformStrainCells::Loop::set_lane(const UniformStrainCells& cells, const Nodes<Cell::n_nodes>& x,
                                        const Elastic& material, int lane, std::vector<Lanes>& geometry) {
  constexpr int n = Cell::n_nodes;
  const MeanCell<n> mean = mean_cell<Cell>(x);
  const BulkViscosity& viscosity = cells.settings_.viscosity;
  // Of slower waves none is damped by more than the linear part of critical, which the stable step counts on.
  const double impedance =
      material.density * (material.is_isotropic() ? material.p_wave_speed() : material.s_wave_speed());
  const double length = viscosity.quadratic * mean.thickness;
  for (int a = 0; a < n; ++a)
    for (int d = 0; d < 3; ++d) geometry[3 * a + d][lane] = mean.gradient(a, d);
  Lanes* scalars = geometry.data() + 3 * n;
  scalars[0][lane] = mean.volume;
  scalars[1][lane] = cells.settings_.hourglass / 2 * material.p_wave_modulus() * mean.hourglass_scale / 8;
  scalars[2][lane] = mean.volume * viscosity.linear * impedance * mean.thickness;
  scalars[3][lane] = mean.volume * material.density * length * length;
  if constexpr (Hourglass<Cell>::n_modes > 0)
    for (int mode = 0; mode < Hourglass<Cell>::n_modes; ++mode)
      for (int d = 0; d < 3; ++d)
        for (int a = 0; a < n; ++a) scalars[4 + 3 * mode + d][lane] += Hourglass<Cell>::vector(mode, a) * x(d, a);
}

template <class Cell>
void UniformStrainCells::Loop::fill(UniformStrainCells& cells, const Mesh& mesh, const CellBlock& block,
                                    const Elastic& material) {
  constexpr int n = Cell::n_nodes;
  const int size = geometry_size<Cell>, n_cells = block.n_cells();
  cells.n_batches_ = (n_cells + n_lanes - 1) / n_lanes;
  cells.dofs_.resize(static_cast<size_t>(cells.n_batches_) * n * n_lanes);
  std::vector<Lanes> geometry(size);
  bool is_uniform = false;  // all lanes of the last batch are translations of one cell
  Nodes<n> last;
  for (int batch = 0; batch < cells.n_batches_; ++batch) {
    bool is_same = is_uniform, is_alike = true;
    for (Lanes& l : geometry) l = zero;
    for (int lane = 0; lane < n_lanes; ++lane) {
      const int cell = batch * n_lanes + lane;
      const int* nodes = block.cell(std::min(cell, n_cells - 1));
      for (int a = 0; a < n; ++a) cells.dofs_[(static_cast<size_t>(batch) * n + a) * n_lanes + lane] = 3 * nodes[a];
      if (cell >= n_cells) {  // a lane without cell has no volume and no gradient
        is_same = is_alike = false;
        continue;
      }
      Nodes<n> x = gather<n>(mesh.nodes, nodes);
      x = (x.colwise() - Vec3(x.col(0))).eval();
      if (cell > 0 && (x - last).cwiseAbs().maxCoeff() > 1e-12 * x.cwiseAbs().maxCoeff()) {
        is_same = false;
        if (lane > 0) is_alike = false;
      }
      last = x;
      set_lane<Cell>(cells, x, material, lane, geometry);
    }
    if (!is_same) cells.geometries_.insert(cells.geometries_.end(), geometry.begin(), geometry.end());
    cells.geometry_of_.push_back(static_cast<int>(cells.geometries_.size()) - size);
    is_uniform = is_alike;
  }
}

inline Lanes Hourglass<Hex8>::resist(const Lanes (&v)[8][3], const Lanes (&g)[3][3], Lanes stiffness, const Lanes* x_h,
                                     Lanes (&s)[3][3], Lanes (&h)[8][3]) {
  Lanes energy = zero;
  for (int i = 0; i < 3; ++i) {
    Lanes sum[4], difference[4], q[4];
    for (int a = 0; a < 4; ++a) {
      sum[a] = v[a][i] + v[a + 4][i];
      difference[a] = v[a][i] - v[a + 4][i];
    }
    q[0] = (difference[0] + difference[1]) - (difference[2] + difference[3]);
    q[1] = (difference[0] - difference[1]) - (difference[2] - difference[3]);
    q[2] = (sum[0] - sum[1]) + (sum[2] - sum[3]);
    q[3] = (difference[1] - difference[0]) + (difference[3] - difference[2]);
    for (int mode = 0; mode < 4; ++mode) {
      for (int j = 0; j < 3; ++j) q[mode] -= x_h[3 * mode + j] * g[i][j];
      energy += stiffness * q[mode] * q[mode];
      q[mode] *= stiffness;
      for (int j = 0; j < 3; ++j) s[i][j] -= x_h[3 * mode + j] * q[mode];
    }
    const Lanes odd[4] = {q[0] + q[1] - q[3], q[0] - q[1] + q[3], -q[0] - q[1] - q[3], q[1] - q[0] + q[3]};
    for (int a = 0; a < 4; ++a) {
      const Lanes even = a % 2 == 0 ? q[2] : -q[2];
      h[a][i] = even + odd[a];
      h[a + 4][i] = even - odd[a];
    }
  }
  return energy;
}

// One pass over the cells: gather, mean gradient, stress (times volume), hourglass forces, scatter.
template <class Cell, bool has_stress, bool is_viscous, bool has_energy>
CellEnergy UniformStrainCells::Loop::run(const UniformStrainCells& cells, const double* u, double dt, double* f,
                                         Lanes* strain) {
  constexpr int n = Cell::n_nodes;
  const double lambda = cells.lambda_, two_mu = 2 * cells.mu_;
  Lanes dissipated = zero, stored = zero, hourglass = zero;
  for (int batch = 0; batch < cells.n_batches_; ++batch) {
    const int* dofs = cells.dofs_.data() + static_cast<size_t>(batch) * n * n_lanes;
    const Lanes* b = cells.geometries_.data() + cells.geometry_of_[batch];
    const Lanes *scalars = b + 3 * n, *x_h = scalars + 4;
    Lanes v[n][3], g[3][3] = {};  // g[i][j] = d u_i / d x_j
    for (int a = 0; a < n; ++a)
      for (int i = 0; i < 3; ++i) {
        v[a][i] = load_lanes(u + i, dofs + a * n_lanes);
        for (int j = 0; j < 3; ++j)
          if (has_stress || i == j) g[i][j] += v[a][i] * b[3 * a + j];
      }
    const Lanes volume = scalars[0], trace = g[0][0] + g[1][1] + g[2][2];
    Lanes pressure = has_stress ? lambda * volume * trace : zero;
    if (is_viscous) {
      const Lanes rate = (trace - strain[batch]) / dt;
      const Lanes closing = rate < 0 ? rate : zero;
      const Lanes viscous = scalars[2] * rate - scalars[3] * closing * closing;
      strain[batch] = trace;
      pressure += viscous;
      dissipated += viscous * rate;
    }
    if constexpr (has_energy && has_stress) {
      stored += lambda * volume * trace * trace;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) stored += 0.5 * two_mu * volume * g[i][j] * (g[i][j] + g[j][i]);
    }
    Lanes s[3][3] = {};  // stress x volume, then less what the hourglass vectors take from it
    for (int i = 0; i < 3; ++i) {
      s[i][i] = pressure;
      if (has_stress)
        for (int j = 0; j < 3; ++j) s[i][j] += volume * (0.5 * two_mu) * (g[i][j] + g[j][i]);
    }
    Lanes h[n][3] = {};
    if constexpr (Hourglass<Cell>::n_modes > 0 && has_stress) {
      const Lanes energy = Hourglass<Cell>::resist(v, g, scalars[1], x_h, s, h);
      if (has_energy) hourglass += energy;
    }
    for (int a = 0; a < n; ++a)
      for (int i = 0; i < 3; ++i) {
        Lanes force = h[a][i] + s[i][i] * b[3 * a + i];
        if (has_stress)
          force += s[i][(i + 1) % 3] * b[3 * a + (i + 1) % 3] + s[i][(i + 2) % 3] * b[3 * a + (i + 2) % 3];
        for (int lane = 0; lane < n_lanes; ++lane) f[dofs[a * n_lanes + lane] + i] += force[lane];
      }
  }
  CellEnergy energy;
  for (int lane = 0; lane < n_lanes; ++lane)
    energy += {0.5 * stored[lane], 0.5 * hourglass[lane], dt * dissipated[lane]};
  return energy;
}

UniformStrainCells::UniformStrainCells(const Mesh& mesh, const CellBlock& block, const Elastic& material,
                                       const UniformStrainSettings& settings)
    : type_(block.type), settings_(settings), lambda_(material.tensor().lambda()), mu_(material.tensor().mu()) {
  CHECK(material.is_isotropic() || !settings.has_stress, "cells of uniform strain have a stress of lambda and mu");
  with_lumped_cell(type_, [&](auto cell) {
    using Cell = decltype(cell);
    static_assert((Cell::row.one_point == OnePoint::hourglass_control) == (Hourglass<Cell>::n_modes > 0),
                  "a type under hourglass control has its vectors above");
    Loop::fill<Cell>(*this, mesh, block, material);
  });
  strain_.assign(n_batches_, zero);
}

template <class Action>
CellEnergy UniformStrainCells::dispatch(Action&& action) const {
  return with_lumped_cell(type_, [&](auto cell) {
    return settings_.has_stress ? action(cell, std::true_type{}) : action(cell, std::false_type{});
  });
}

CellEnergy UniformStrainCells::add_elastic_force(const double* displacement, double* force) const {
  if (!settings_.has_stress) return {};
  return dispatch([&](auto cell, auto stress) {
    return Loop::run<decltype(cell), stress.value, false, true>(*this, displacement, 1.0, force, nullptr);
  });
}

CellEnergy UniformStrainCells::add_force(const double* displacement, double dt, bool has_energy, double* force) {
  const bool is_viscous = settings_.viscosity.linear > 0.0 || settings_.viscosity.quadratic > 0.0;
  if (!is_viscous && has_energy) return add_elastic_force(displacement, force);
  return dispatch([&](auto cell, auto stress) {
    using Cell = decltype(cell);
    if (!is_viscous) return Loop::run<Cell, stress.value, false, false>(*this, displacement, dt, force, nullptr);
    if (!has_energy) return Loop::run<Cell, stress.value, true, false>(*this, displacement, dt, force, strain_.data());
    return Loop::run<Cell, stress.value, true, true>(*this, displacement, dt, force, strain_.data());
  });
}

void UniformStrainCells::start_from(const double* displacement) {
  const int n = nodes_per_cell(type_);
  for (int batch = 0; batch < n_batches_; ++batch) {
    strain_[batch] = zero;
    for (int a = 0; a < n; ++a)
      for (int lane = 0; lane < n_lanes; ++lane)
        for (int d = 0; d < 3; ++d)
          strain_[batch][lane] += geometries_[geometry_of_[batch] + 3 * a + d][lane] *
                                  displacement[dofs_[(static_cast<size_t>(batch) * n + a) * n_lanes + lane] + d];
  }
}

double UniformStrainCells::bytes() const {
  return 4.0 * static_cast<double>(dofs_.size() + geometry_of_.size()) +
         sizeof(Lanes) * static_cast<double>(geometries_.size() + strain_.size());
}

}  // namespace dygita
