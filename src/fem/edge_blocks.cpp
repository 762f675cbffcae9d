#include "fem/edge_blocks.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>

#include "numerics/panel_choice.hpp"

namespace dygita {

EdgeBlocks::EdgeBlocks(const SparseMatrix& stiffness, const Points& nodes) {
  const int n = static_cast<int>(stiffness.rows()) / 3;
  const size_t n_edges = (static_cast<size_t>(stiffness.nonZeros()) / 9 - static_cast<size_t>(n)) / 2;
  starts_.reserve(static_cast<size_t>(n) + 1);
  others_.reserve(n_edges);
  blocks_.reserve(9 * n_edges + 2);
  starts_.push_back(0);
  for (int a = 0; a < n; ++a) {
    const int begin = stiffness.outerIndexPtr()[3 * a], count = stiffness.outerIndexPtr()[3 * a + 1] - begin;
    for (int e = 0; e < count; e += 3) {
      const int b = stiffness.innerIndexPtr()[begin + e] / 3;
      if (b <= a) continue;
      others_.push_back(b);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          blocks_.push_back(static_cast<float>(stiffness.valuePtr()[begin + i * count + e + j]));
    }
    starts_.push_back(static_cast<int>(others_.size()));
  }
  blocks_.insert(blocks_.end(), 2, 0.0F);
  find_rigid(nodes);
}

// The skew part of the diagonal block of each node, as a vector.
Points EdgeBlocks::skew_diagonal() const {
  Points skew = Points::Zero(3, n_nodes());
  for (int a = 0; a < n_nodes(); ++a)
    for (int e = starts_[a]; e < starts_[a + 1]; ++e) {
      const Mat3 block =
          Eigen::Map<const Eigen::Matrix<float, 3, 3, Eigen::RowMajor>>(&blocks_[9 * static_cast<size_t>(e)])
              .cast<double>();
      const Vec3 own = 0.5 * Vec3(block(2, 1) - block(1, 2), block(0, 2) - block(2, 0), block(1, 0) - block(0, 1));
      skew.col(a) -= own;
      skew.col(others_[e]) += own;
    }
  return skew;
}

void EdgeBlocks::find_rigid(const Points& nodes) {
  const Eigen::Index n = nodes.cols();
  const Points arms = nodes.colwise() - nodes.rowwise().mean(), skew = skew_diagonal();
  rigid_.assign(15 * static_cast<size_t>(n) + 1, 0.0F);
  Eigen::Map<Eigen::Matrix<float, 15, Eigen::Dynamic>> of_nodes(rigid_.data(), 15, n);
  of_nodes.topRows<3>() = arms.cast<float>();
  of_nodes.bottomRows<3>() = skew.cast<float>();
  std::array<Eigen::Matrix4Xd, 3> motions;
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Matrix4Xd force = Eigen::Matrix4Xd::Zero(4, n), &motion = motions[axis] = force;
    for (Eigen::Index i = 0; i < n; ++i) motion.col(i).head<3>() = Vec3::Unit(axis).cross(arms.col(i));
    add_product_of_blocks(motion.data(), force.data());
    for (Eigen::Index i = 0; i < n; ++i)
      force.col(i).head<3>() -= Vec3(skew.col(i)).cross(Vec3(motion.col(i).head<3>()));
    of_nodes.middleRows<3>(3 * (axis + 1)) = force.topRows<3>().cast<float>();
  }
  Eigen::Matrix<double, 12, 3> sums;
  for (int axis = 0; axis < 3; ++axis) panel_kernels().sum_rigid(rigid(), motions[axis].data(), sums.col(axis).data());
  turn_of_sum_ = sums.middleRows<3>(3).inverse();
  force_of_turn_ = sums.bottomRows<3>();
  work_of_turn_ = sums.middleRows<3>(6) - force_of_turn_.transpose() * sums.topRows<3>() / static_cast<double>(n);
}

// P^T S P, where S is K with a symmetric diagonal and P = 1 - Q Q^+ leaves out the rigid motion Q that fits x best.
void EdgeBlocks::add_product(const double* x, double* y) const {
  Eigen::Matrix<double, 12, 1> sums;
  panel_kernels().sum_rigid(rigid(), x, sums.data());
  const Vec3 mean = sums.head<3>() / static_cast<double>(n_nodes());
  const Vec3 turn = turn_of_sum_ * sums.segment<3>(3);
  const Vec3 moment = sums.segment<3>(6) - force_of_turn_.transpose() * mean - work_of_turn_ * turn;
  const Vec3 force = sums.tail<3>() - force_of_turn_ * turn;
  RigidTerms terms{};
  Eigen::Map<Vec3>(terms.middle) = Eigen::Map<const Vec3>(x) + mean;
  Eigen::Map<Vec3>(terms.turn) = turn;
  Eigen::Map<Vec3>(terms.push) = force / static_cast<double>(n_nodes());
  Eigen::Map<Vec3>(terms.pull) = turn_of_sum_.transpose() * moment;
  add_product_of_blocks(x, y);
  panel_kernels().subtract_rigid(rigid(), terms, x, y);
}

void EdgeBlocks::add_product_of_blocks(const double* x, double* y) const {
  panel_kernels().add_edge_product({starts_.data(), others_.data(), blocks_.data(), n_nodes()}, x, y);
}

}  // namespace dygita
