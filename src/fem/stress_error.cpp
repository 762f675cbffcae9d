#include "fem/stress_error.hpp"

#include "fem/cell_loop.hpp"

namespace dygita {

namespace {

// 1/2 s : C^-1 : s, J/m^3.
double energy_density(const Elastic& material, const Eigen::Matrix<double, 6, 1>& s) {
  const double trace = s[0] + s[1] + s[2];
  const double norm2 = s.head<3>().squaredNorm() + 2 * s.tail<3>().squaredNorm();
  return 0.5 * ((1 + material.poisson) * norm2 - material.poisson * trace * trace) / material.young;
}

template <class Cell>
struct ErrorKernel {
  static constexpr int n = Cell::n_nodes;

  const Mesh& mesh;
  const Elastic& material;
  const Points& displacement;
  const Tensors& smooth;
  Vec& energy;    // of each node's share
  Vec& at_nodes;  // von Mises

  CornerStress<n> difference;
  double share = 0.0;
  Vec corner;

  void compute(const int* nodes, int) {
    const Nodes<n> x = gather<n>(mesh.nodes, nodes);
    difference = -Cell::stress(x, material, gather<n>(displacement, nodes));
    for (int a = 0; a < n; ++a) difference.col(a) += smooth.col(nodes[a]);
    const auto& shapes = Cell::shapes();
    share = 0.0;
    if constexpr (n == 4) {  // the mean of a quadratic on a tetrahedron: one point would not see the corners
      const double volume = point_in_cell(shapes, x, 0).volume;
      const Eigen::Matrix<double, 6, 1> sum = difference.rowwise().sum();
      share = energy_density(material, sum);
      for (int a = 0; a < n; ++a) share += energy_density(material, difference.col(a));
      share *= volume / 20.0;
    } else {
      for (int i = 0; i < shapes.n_points; ++i)
        share += point_in_cell(shapes, x, i).volume * energy_density(material, difference * shapes.values.col(i));
    }
    share /= n;
    corner = von_mises(difference);
  }
  void add(const int* nodes, int a) {
    energy[nodes[a]] += share;
    at_nodes[nodes[a]] = std::max(at_nodes[nodes[a]], corner[a]);
  }
  void finish() {}
};

}  // namespace

StressError stress_error(const Mesh& mesh, const Elastic& material, const Points& displacement) {
  const Tensors smooth = nodal_stress(mesh, material, displacement);
  const NodeOwners owners = node_owners(mesh);
  StressError error{0.0, Vec::Zero(mesh.n_nodes())};
  Vec energy = Vec::Zero(mesh.n_nodes());
  for (const CellBlock& block : mesh.blocks)
    with_cell(block.type, [&](auto cell) {
      sum_at_nodes(
          block, owners,
          ErrorKernel<decltype(cell)>{mesh, material, displacement, smooth, energy, error.at_nodes, {}, 0.0, {}});
    });
  error.energy = energy.sum();
  return error;
}

}  // namespace dygita
