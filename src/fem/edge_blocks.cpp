#include "fem/edge_blocks.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "numerics/panel_choice.hpp"

namespace dygita {

namespace {

// What a unit in entry (i, j) of the block of an edge adds to these: forces e_i d_j on one node, -e_j d_i on the other.
EdgeBlocks::TurnSums of_entry(const Vec3& one, const Vec3& other, int i, int j) {
  EdgeBlocks::TurnSums sums;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 d = Vec3::Unit(axis).cross(other - one);
    const Vec3 on_one = d[j] * Vec3::Unit(i), on_other = -d[i] * Vec3::Unit(j);
    sums.segment<3>(3 * axis) = on_one + on_other;
    sums.segment<3>(9 + 3 * axis) = one.cross(on_one) + other.cross(on_other);
  }
  return sums;
}

}  // namespace

EdgeBlocks::EdgeBlocks(const SparseMatrix& stiffness, const Points& places) {
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
  balance_turns(places);
}

EdgeBlocks::TurnSums EdgeBlocks::sums_of_turns(const Points& arms) const {
  TurnSums sums = TurnSums::Zero();
  std::vector<double> x(4 * static_cast<size_t>(n_nodes()), 0.0), y(x.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::fill(y.begin(), y.end(), 0.0);
    for (Eigen::Index i = 0; i < arms.cols(); ++i)
      Eigen::Map<Vec3>(x.data() + 4 * i) = Vec3::Unit(axis).cross(arms.col(i));
    add_product(x.data(), y.data());
    for (Eigen::Index i = 0; i < arms.cols(); ++i) {
      const Vec3 force = Eigen::Map<const Vec3>(y.data() + 4 * i);
      sums.segment<3>(3 * axis) += force;
      sums.segment<3>(9 + 3 * axis) += arms.col(i).cross(force);
    }
  }
  return sums;
}

// The sums that rounding has left, some 1e-7 of a stiffness, are a spring about where the step began, and a free piece
// that spins stores energy in it. Entries of some edges, evenly spread, change by as much as each is rounded by until
// none is left; those on the diagonals alone where the whole is symmetric to the bit, as of regular hexahedra: it stays
// so.
void EdgeBlocks::balance_turns(const Points& places) {
  constexpr size_t n_passes = 3, most_edges = 20000;
  constexpr double rounding = 6e-8;  // of an entry
  if (others_.empty()) return;
  const Vec3 centre = places.rowwise().mean();
  const Points arms =
      (places.colwise() - centre) / std::sqrt((places.colwise() - centre).colwise().squaredNorm().maxCoeff());
  TurnSums sums = sums_of_turns(arms);
  double largest = 0.0;
  for (const float entry : blocks_) largest = std::max(largest, static_cast<double>(std::abs(entry)));
  const double size = largest * std::sqrt(static_cast<double>(others_.size()));
  const bool is_symmetric = sums.head<9>().norm() < 1e-12 * size;
  const auto change = [&](float& entry, const TurnSums& own) {
    if (own.isZero(1e-6) || (is_symmetric && !own.head<9>().isZero(0.0))) return;
    const double wanted = -sums.dot(own) / own.squaredNorm(), most = rounding * std::abs(entry);
    const auto changed = static_cast<float>(entry + std::clamp(wanted, -most, most));
    sums += (static_cast<double>(changed) - static_cast<double>(entry)) * own;
    entry = changed;
  };
  const size_t stride = 1 + others_.size() / most_edges;
  for (size_t pass = 0; pass < n_passes; ++pass)
    for (int a = 0; a < n_nodes(); ++a)
      for (auto e = static_cast<size_t>(starts_[a]); e < static_cast<size_t>(starts_[a + 1]); ++e) {
        if (e % stride != pass % stride || sums.norm() < 1e-13 * size) continue;
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            if (float& entry = blocks_[9 * e + static_cast<size_t>(3 * i + j)]; entry != 0.0F)
              change(entry, of_entry(arms.col(a), arms.col(others_[e]), i, j));
      }
}

void EdgeBlocks::add_product(const double* x, double* y) const {
  panel_kernels().add_edge_product({starts_.data(), others_.data(), blocks_.data(), n_nodes()}, x, y);
}

}  // namespace dygita
