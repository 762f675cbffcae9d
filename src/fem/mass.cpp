#include "fem/mass.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "fem/cell_loop.hpp"
#include "fem/node_pattern.hpp"

namespace dygita {

namespace {

// Share of the consistent mass along a length h: linear cells with lumped mass turn a wave by (k h)^2 / 24 too little
// and those with consistent mass by as much too much; a trapezoidal step turns it by (w dt)^2 / 12 too little.
double consistent_share(double speed, double dt, double h) { return std::min(1.0, 0.5 + std::pow(speed * dt / h, 2)); }

// Integrals of rho N_a N_b of a hexahedron by two points a direction, at +-s: s = 1 is lumped, s^2 = 1/3 consistent.
Eigen::Matrix<double, 8, 8> cell_mass(const Nodes<8>& x, const Elastic& material, double dt, Hex8) {
  const auto& shapes = Hex8::shapes();
  Mat3 jacobian = Mat3::Zero();
  for (int i = 0; i < 8; ++i) jacobian += x * shapes.slopes[i] / 8.0;  // at the centre
  Vec3 s;
  for (int d = 0; d < 3; ++d)
    s[d] = std::sqrt(1.0 - 2.0 / 3.0 * consistent_share(material.p_wave_speed(), dt, 2.0 * jacobian.col(d).norm()));
  Eigen::Matrix<double, 8, 8> mass = Eigen::Matrix<double, 8, 8>::Zero();
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner = shapes.points.col(i).cwiseSign();
    Eigen::Matrix<double, 8, 1> values;
    for (int a = 0; a < 8; ++a)
      values[a] = (Vec3::Ones() + shapes.points.col(a).cwiseSign().cwiseProduct(corner).cwiseProduct(s)).prod() / 8.0;
    const double volume = (x * shapes.slopes[i]).eval().determinant() * shapes.weights[i];
    mass += material.density * volume * values * values.transpose();
  }
  return mass;
}

template <class Cell>
Eigen::Matrix<double, Cell::n_nodes, Cell::n_nodes> cell_mass(const Nodes<Cell::n_nodes>& x, const Elastic& material,
                                                              double dt, Cell) {
  constexpr int n = Cell::n_nodes;
  const auto& shapes = Cell::shapes();
  double volume = 0.0;
  Eigen::Matrix<double, n, n> mass = Eigen::Matrix<double, n, n>::Zero();
  for (int i = 0; i < shapes.n_points; ++i) {
    const double share = (x * shapes.slopes[i]).eval().determinant() * shapes.weights[i];
    volume += share;
    mass += material.density * share * shapes.values.col(i) * shapes.values.col(i).transpose();
  }
  if constexpr (n == 4) mass.setConstant(material.density * volume / 20.0);  // the diagonal comes from the row sums
  return consistent_share(material.p_wave_speed(), dt, std::cbrt(volume * (n == 4 ? 6.0 : 2.0))) * mass;
}

template <class Cell>
struct MassKernel {
  static constexpr int n = Cell::n_nodes;

  const Mesh& mesh;
  const Elastic& material;
  double dt;
  const std::vector<char>& keeps_lumped;
  const NodePattern& pattern;
  double* values;  // of the pattern's entries

  Eigen::Matrix<double, n, n> mass;
  Eigen::Matrix<double, n, 1> lumped;

  void compute(const int* nodes, int) {
    const Nodes<n> x = gather<n>(mesh.nodes, nodes);
    lumped = material.density * node_volumes<Cell>(x);
    mass.setZero();
    if (keeps_lumped.empty() || std::none_of(nodes, nodes + n, [&](int node) { return keeps_lumped[node]; }))
      mass = cell_mass(x, material, dt, Cell{});
  }
  void add(const int* nodes, int a) {
    const int first = pattern.starts[nodes[a]], end = pattern.starts[nodes[a] + 1];
    const auto entry = [&](int node) -> double& {
      return values[std::lower_bound(pattern.neighbours.begin() + first, pattern.neighbours.begin() + end, node) -
                    pattern.neighbours.begin()];
    };
    double rest = lumped[a];
    for (int b = 0; b < n; ++b) {
      if (b == a) continue;
      entry(nodes[b]) += mass(a, b);
      rest -= mass(a, b);
    }
    entry(nodes[a]) += rest;
  }
  void finish() {}
};

}  // namespace

SparseMatrix tuned_mass(const Mesh& mesh, const Elastic& material, double dt, const std::vector<char>& keeps_lumped) {
  const NodePattern pattern = node_pattern(mesh);
  const NodeOwners owners = node_owners(mesh);
  SparseMatrix matrix(mesh.n_nodes(), mesh.n_nodes());
  matrix.resizeNonZeros(static_cast<Eigen::Index>(pattern.neighbours.size()));
  std::copy(pattern.starts.begin(), pattern.starts.end(), matrix.outerIndexPtr());
  std::copy(pattern.neighbours.begin(), pattern.neighbours.end(), matrix.innerIndexPtr());
  std::fill_n(matrix.valuePtr(), matrix.nonZeros(), 0.0);
  for (const CellBlock& block : mesh.blocks)
    with_cell(block.type, [&](auto cell) {
      sum_at_nodes(block, owners,
                   MassKernel<decltype(cell)>{mesh, material, dt, keeps_lumped, pattern, matrix.valuePtr(), {}, {}});
    });
  return matrix;
}

}  // namespace dygita
