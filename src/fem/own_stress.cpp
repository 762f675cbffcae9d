#include "fem/own_stress.hpp"

#include <cmath>
#include <optional>

#include "fem/cell_loop.hpp"
#include "fem/cell_tensor.hpp"
#include "fem/layered_cell.hpp"

namespace dygita {

namespace {

// Of each cell some rows, a column a node.
template <class OfCell>
struct RowsKernel {
  const OfCell& of_cell;
  const CellBlock& block;
  Mat& sum;
  Mat rows = {};

  void compute(const int*, int i) { rows = of_cell(block, i); }
  void add(const int* nodes, int a) { sum.col(nodes[a]) += rows.col(a); }
  void finish() {}
};

template <class OfCell>
Mat mean_at_nodes(const Mesh& mesh, int n_rows, const OfCell& of_cell) {
  const NodeOwners owners = node_owners(mesh);
  Mat sum = Mat::Zero(n_rows, mesh.n_nodes());
  Vec n_cells = Vec::Zero(mesh.n_nodes());
  for (const CellBlock& block : mesh.blocks) {
    sum_at_nodes(block, owners, RowsKernel<OfCell>{of_cell, block, sum});
    for (const int node : block.nodes) n_cells[node] += 1;
  }
  return sum * n_cells.cwiseInverse().asDiagonal();
}

CellNodes nodes_of_cell(const Points& values, const CellBlock& block, int i) {
  const int n = nodes_per_cell(block.type);
  CellNodes gathered(3, n);
  for (int a = 0; a < n; ++a) gathered.col(a) = values.col(block.cell(i)[a]);
  return gathered;
}

Mat3 square_of(const Vec6& s) {
  Mat3 square;
  square << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return square;
}

Vec6 six_of(const Mat3& s) { return {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2)}; }

// Stresses along the columns of the axes.
Tensors along(const Tensors& stress, const Mat3& axes) {
  Tensors turned(6, stress.cols());
  for (Eigen::Index i = 0; i < stress.cols(); ++i)
    turned.col(i) = six_of(axes.transpose() * square_of(stress.col(i)) * axes);
  return turned;
}

Mat3 axes_in(const CellBlock& block, int i) {
  return block.axes.empty() ? Mat3::Identity() : block.axes[static_cast<size_t>(i)];
}

LayeredCell moved_cell(const Mesh& mesh, const CellBlock& block, int i, const Layup& layup,
                       const Points& displacement) {
  LayeredCell cell(block.type, nodes_of_cell(mesh.nodes, block, i), axes_in(block, i), layup);
  cell.move(nodes_of_cell(displacement, block, i));
  return cell;
}

// Where in a ply a level of the layup is, -1 below to 1 above; none: in another.
std::optional<double> place_in(const Layup& layup, int ply, double level) {
  constexpr double rounding = 1e-6;
  const double low = layup.bound(ply), high = layup.bound(ply + 1);
  if (level < low - rounding || level > high + rounding) return {};
  return 2.0 * (level - low) / (high - low) - 1.0;
}

// Of each node in the axes of the ply that it lies in.
Tensors stress_in_place(const LayeredCell& cell, const Layup& layup, int n_nodes) {
  Tensors stress(6, n_nodes);
  for (int k = layup.n_plies() - 1; k >= 0; --k)
    for (int a = 0; a < n_nodes; ++a)
      if (const auto at = place_in(layup, k, cell.level(a)))
        stress.col(a) = along(cell.stress(k, *at).col(a), layup.ply(k).axes);
  return stress;
}

NodalFailure of_one_material(const Tensors& stress, const Strength& strength) {
  NodalFailure found{Vec(stress.cols()), {}, std::vector<FailureMode>(static_cast<size_t>(stress.cols()))};
  for (Eigen::Index i = 0; i < stress.cols(); ++i) {
    const Failure failure = strength.failure(stress.col(i));
    found.index[i] = failure.index;
    found.mode[static_cast<size_t>(i)] = failure.mode;
  }
  return found;
}

}  // namespace

Tensors own_stress(const Mesh& mesh, const Elastic& material, const Points& displacement, int ply) {
  if (material.layup)
    return mean_at_nodes(mesh, 6, [&](const CellBlock& block, int i) -> Mat {
      const Layup& layup = *material.layup;
      const LayeredCell cell = moved_cell(mesh, block, i, layup, displacement);
      return ply == at_its_place ? stress_in_place(cell, layup, nodes_per_cell(block.type))
                                 : along(cell.stress(ply, 0.0), layup.ply(ply).axes);
    });
  return mean_at_nodes(mesh, 6, [&](const CellBlock& block, int i) -> Mat {
    return with_cell(block.type, [&](auto cell) -> Mat {
      constexpr int n = decltype(cell)::n_nodes;
      const Tensors stress = decltype(cell)::stress(gather<n>(mesh.nodes, block.cell(i)), tensor_in(material, block, i),
                                                    gather<n>(displacement, block.cell(i)));
      return along(stress, axes_in(block, i));
    });
  });
}

NodalFailure nodal_failure(const Mesh& mesh, const Elastic& material, const Points& displacement, int ply) {
  if (!material.layup) return of_one_material(own_stress(mesh, material, displacement), *material.strength);
  const Layup& layup = *material.layup;
  const int first = ply == of_all_plies ? 0 : ply, n_plies = ply == of_all_plies ? layup.n_plies() : 1;
  const Mat all = mean_at_nodes(mesh, 12 * n_plies, [&](const CellBlock& block, int i) -> Mat {
    const LayeredCell cell = moved_cell(mesh, block, i, layup, displacement);
    Mat rows(12 * n_plies, nodes_per_cell(block.type));
    for (int k = 0; k < n_plies; ++k)
      for (int side = 0; side < 2; ++side)
        rows.middleRows<6>(12 * k + 6 * side) =
            along(cell.stress(first + k, 2.0 * side - 1.0), layup.ply(first + k).axes);
    return rows;
  });
  NodalFailure found;
  for (int k = 0; k < n_plies; ++k)
    for (int side = 0; side < 2; ++side) {
      const NodalFailure one = of_one_material(all.middleRows<6>(12 * k + 6 * side), *layup.ply(first + k).strength);
      if (found.ply.empty()) {
        found = one;
        found.ply.assign(one.mode.size(), first);
        continue;
      }
      for (size_t i = 0; i < one.mode.size(); ++i) {
        const auto node = static_cast<Eigen::Index>(i);
        if (!(one.index[node] > found.index[node]) && !std::isnan(one.index[node])) continue;
        found.index[node] = one.index[node];
        found.ply[i] = first + k;
        found.mode[i] = one.mode[i];
      }
    }
  return found;
}

Tensors layered_stress(const Mesh& mesh, const Elastic& material, const Points& displacement) {
  const Layup& layup = *material.layup;
  return mean_at_nodes(mesh, 6, [&](const CellBlock& block, int i) -> Mat {
    const LayeredCell cell = moved_cell(mesh, block, i, layup, displacement);
    const int n = nodes_per_cell(block.type);
    Tensors stress = Tensors::Zero(6, n);
    Vec n_plies = Vec::Zero(n);
    for (int k = 0; k < layup.n_plies(); ++k)
      for (int a = 0; a < n; ++a) {
        const std::optional<double> at = place_in(layup, k, cell.level(a));
        if (!at) continue;
        stress.col(a) += cell.stress(k, *at).col(a);
        n_plies[a] += 1;
      }
    return along(stress * n_plies.cwiseInverse().asDiagonal(), axes_in(block, i).transpose());
  });
}

}  // namespace dygita
