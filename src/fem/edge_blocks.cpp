#include "fem/edge_blocks.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "numerics/panel_choice.hpp"

namespace dygita {

namespace {

// Sums of the forces and of their moments in turns about the three axes.
using TurnSums = Eigen::Matrix<double, 18, 1>;

// What a unit in entry (i, j) of the block of an edge adds to these: forces e_i d_j on one node, -e_j d_i on the other.
TurnSums of_entry(const Vec3& one, const Vec3& other, int i, int j) {
  TurnSums sums;
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

// The sums that rounding has left, some 1e-7 of a stiffness, are a spring about where the step began, and a free piece
// that spins stores energy in it. Entries change by as much as each is rounded by until none is left; those on the
// diagonals alone where the whole is symmetric to the bit, as of regular hexahedra: it stays so.
void EdgeBlocks::balance_turns(const Points& places) {
  constexpr int n_passes = 3;
  constexpr double rounding = 6e-8;  // of an entry
  constexpr double nothing = 1e-13;  // of the largest entry
  if (n_nodes() == 0) return;
  const Vec3 centre = places.rowwise().mean();
  const double size = std::sqrt((places.colwise() - centre).colwise().squaredNorm().maxCoeff());
  const auto place = [&](int node) { return Vec3((places.col(node) - centre) / size); };
  const auto for_each_entry = [&](auto&& visit) {
    float* entry = blocks_.data();
    for (int a = 0; a < n_nodes(); ++a)
      for (int e = starts_[a]; e < starts_[a + 1]; ++e)
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j, ++entry)
            if (*entry != 0.0F && !visit(*entry, of_entry(place(a), place(others_[e]), i, j))) return;
  };
  TurnSums sums = TurnSums::Zero();
  double largest = 0.0;
  for_each_entry([&](float entry, const TurnSums& own) {
    sums += static_cast<double>(entry) * own;
    largest = std::max(largest, static_cast<double>(std::abs(entry)));
    return true;
  });
  const bool is_symmetric = sums.head<9>().norm() < 1e-12 * largest;
  for (int pass = 0; pass < n_passes; ++pass)
    for_each_entry([&](float& entry, const TurnSums& own) {
      if (own.isZero(1e-6) || (is_symmetric && !own.head<9>().isZero(0.0))) return true;
      const double wanted = -sums.dot(own) / own.squaredNorm(), most = rounding * std::abs(entry);
      const auto changed = static_cast<float>(entry + std::clamp(wanted, -most, most));
      sums += (static_cast<double>(changed) - static_cast<double>(entry)) * own;
      entry = changed;
      return sums.norm() > nothing * largest;
    });
}

void EdgeBlocks::add_product(const double* x, double* y) const {
  panel_kernels().add_edge_product({starts_.data(), others_.data(), blocks_.data(), n_nodes()}, x, y);
}

}  // namespace dygita
