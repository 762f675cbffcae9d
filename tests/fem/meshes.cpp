#include "fem/meshes.hpp"

#include <Eigen/SparseCholesky>
#include <random>

namespace dygita::test {

Elastic material_of(double young, double poisson, double density) { return {"", young, poisson, density}; }

std::vector<int> split(CellType type, const int* hex) {
  static const std::map<CellType, std::vector<int>> local = {{CellType::hex8, {0, 1, 2, 3, 4, 5, 6, 7}},
                                                             {CellType::prism6, {0, 2, 1, 4, 6, 5, 0, 3, 2, 4, 7, 6}}};
  std::vector<int> nodes;
  for (const int a : local.at(type)) nodes.push_back(hex[a]);
  return nodes;
}

Mesh box_of(CellType type, const Vec3& size, const std::array<int, 3>& cells) {
  return *box_mesh(Vec3::Zero(), size, cells, type);
}

Mesh mixed_box(const Vec3& size, const std::array<int, 3>& cells) {
  Mesh mesh = *box_mesh(Vec3::Zero(), size, cells);
  const CellBlock hexahedra = mesh.blocks[0];
  mesh.blocks = {{CellType::hex8, {}}, {CellType::prism6, {}}};
  for (int i = 0; i < hexahedra.n_cells(); ++i) {
    const int* cell = hexahedra.cell(i);
    CellBlock& block = mesh.blocks[mesh.nodes(0, cell[0]) + 1e-9 < size[0] / 2 ? 0 : 1];
    for (const int node : split(block.type, cell)) block.nodes.push_back(node);
  }
  return mesh;
}

bool is_on_boundary(const Vec3& x, const Vec3& size) {
  return (x.array().abs() < 1e-9).any() || ((x - size).array().abs() < 1e-9).any();
}

void distort(Mesh& mesh, const Vec3& size, double amplitude) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> shift(-amplitude, amplitude);
  for (int a = 0; a < mesh.n_nodes(); ++a) {
    const Vec3 move(shift(generator), shift(generator), shift(generator));
    if (!is_on_boundary(mesh.nodes.col(a), size)) mesh.nodes.col(a) += move;
  }
}

Mesh distorted_mixed_box() {
  const Vec3 size(1.0, 1.2, 0.9);
  Mesh mesh = mixed_box(size, {4, 3, 3});
  distort(mesh, size, 0.05);
  return mesh;
}

CellNodes nodes_of_cell(const Mesh& mesh, const CellBlock& block, int i_cell) {
  CellNodes x(3, nodes_per_cell(block.type));
  for (int a = 0; a < x.cols(); ++a) x.col(a) = mesh.nodes.col(block.cell(i_cell)[a]);
  return x;
}

Vec flat(const Points& field) { return Eigen::Map<const Vec>(field.data(), field.size()); }

Points solve(const SparseMatrix& stiffness, const Points& forces, const std::map<int, double>& prescribed) {
  const auto n = static_cast<int>(stiffness.rows());
  std::vector<int> position(n, -1);
  int n_free = 0;
  for (int i = 0; i < n; ++i)
    if (!prescribed.contains(i)) position[i] = n_free++;

  Vec rhs(n_free);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    if (position[i] < 0) continue;
    rhs[position[i]] = forces.data()[i];
    for (SparseMatrix::InnerIterator entry(stiffness, i); entry; ++entry) {
      const auto j = static_cast<int>(entry.col());
      if (position[j] >= 0)
        entries.emplace_back(position[i], position[j], entry.value());
      else
        rhs[position[i]] -= entry.value() * prescribed.at(j);
    }
  }
  Eigen::SparseMatrix<double> free(n_free, n_free);
  free.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(free);
  Vec solution = factor.solve(rhs);
  solution += factor.solve(rhs - free * solution);

  Points displacement(3, n / 3);
  for (int i = 0; i < n; ++i) displacement.data()[i] = position[i] < 0 ? prescribed.at(i) : solution[position[i]];
  return displacement;
}

Points pressure_forces(const Mesh& mesh, const std::function<bool(const Vec3&)>& is_loaded) {
  Points forces = Points::Zero(3, mesh.n_nodes());
  const double signs[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (const Facet& facet : boundary_facets(mesh.blocks)) {
    Eigen::Matrix<double, 3, 4> x;
    for (int a = 0; a < 4; ++a) x.col(a) = mesh.nodes.col(facet.nodes()[a]);
    if (!is_loaded(x.rowwise().mean())) continue;
    for (const auto& point : signs) {
      Eigen::Vector4d shape;
      Eigen::Matrix<double, 4, 2> slope;
      for (int a = 0; a < 4; ++a) {
        const double r = 1 + signs[a][0] * point[0] / std::sqrt(3.0), s = 1 + signs[a][1] * point[1] / std::sqrt(3.0);
        shape[a] = r * s / 4;
        slope.row(a) << signs[a][0] * s / 4, signs[a][1] * r / 4;
      }
      const Vec3 along_r = x * slope.col(0), along_s = x * slope.col(1), area = along_r.cross(along_s);
      for (int a = 0; a < 4; ++a) forces.col(facet.nodes()[a]) -= shape[a] * area;
    }
  }
  return forces;
}

}  // namespace dygita::test
