// How fast plane waves travel through infinite lattices of cells of order two, with their consistent mass, with its
// scaled diagonal, and in explicit increments (Bloch's theorem on one cube of cells).
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <complex>
#include <iostream>
#include <map>
#include <numbers>
#include <random>

#include "fem/mass.hpp"
#include "fem/meshes.hpp"
#include "mesh/raise_order.hpp"

namespace dygita::test {
namespace {

using Waves = Eigen::MatrixXcd;

enum class MassOf { consistent, diagonal, pairs };

struct PhaseError {
  double p = 0.0, s = 0.0;  // rms over directions, relative
};

// A cube of edge 1 in an infinite lattice: two nodes along an edge.
class Lattice {
 public:
  explicit Lattice(CellType type)
      : material_(material_of(1.0, 0.3)),
        mesh_(*box_mesh(Vec3::Zero(), Vec3::Ones(), {1, 1, 1}, type)),
        body_(assemble(mesh_, material_)),
        consistent_(consistent_mass(mesh_, material_)) {
    std::map<std::array<long, 3>, int> known;
    for (int i = 0; i < mesh_.n_nodes(); ++i) {
      std::array<long, 3> key;
      for (int d = 0; d < 3; ++d) key[static_cast<size_t>(d)] = std::lround(2.0 * mesh_.nodes(d, i)) % 2;
      class_.push_back(known.emplace(key, static_cast<int>(known.size())).first->second);
    }
    n_ = static_cast<int>(known.size());
    lumped_ = Vec::Zero(n_);
    for (int i = 0; i < mesh_.n_nodes(); ++i) lumped_[class_[static_cast<size_t>(i)]] += body_.mass[i];
    const CellBlock& block = mesh_.blocks.front();
    const std::vector<std::vector<int>> ends = middle_corners(type);
    const int n_corners = cell_shape(type).n_corners;
    pairs_ = Mat::Zero(mesh_.n_nodes(), mesh_.n_nodes());
    for (int cell = 0; cell < block.n_cells(); ++cell)
      for (size_t m = 0; m < ends.size(); ++m)
        if (ends[m].size() == 2)
          for (const int end : ends[m]) tie(block.cell(cell)[end], block.cell(cell)[n_corners + static_cast<int>(m)]);
    pairs_ /= block.n_cells();  // times the volume of a cell
  }

  double p_speed() const { return material_.p_wave_speed(); }

  // share: of the pairs of a corner and a middle, in kg per kg of the cell (MassOf::pairs).
  double longest_step(MassOf mass, double share = 0.0) const {
    double largest = 0.0;
    for (int i = 0; i < 27; ++i) {
      const Vec3 k = std::numbers::pi / 2.0 * Vec3(i % 3, i / 3 % 3, i / 9);
      largest = std::max(largest, frequencies2(k, mass, share).first.maxCoeff());
    }
    return 2.0 / std::sqrt(largest);
  }

  // dt: of explicit increments, 0: none.
  PhaseError phase_error(double nodes_per_wave, MassOf mass, double dt, double share = 0.0) const {
    constexpr int n_directions = 12;
    const double size = 4.0 * std::numbers::pi / nodes_per_wave;
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    PhaseError error;
    for (int i = 0; i < n_directions; ++i) {
      const Vec3 along = Vec3(normal(random), normal(random), normal(random)).normalized(),
                 across = along.unitOrthogonal();
      const auto [squares, motions] = frequencies2(size * along, mass, share);
      for (const Vec3& way : {along, across, Vec3(along.cross(across))}) {
        const bool is_p = way.dot(along) > 0.5;
        double frequency = 0.0, all = 0.0;  // of the three branches that begin at zero, as far as each moves that way
        for (int j = 0; j < 3; ++j) {
          const double part = std::norm(motions.col(j).dot(even(way)));
          frequency += part * std::sqrt(std::max(0.0, squares[j]));
          all += part;
        }
        frequency /= all;
        if (dt > 0.0) frequency = 2.0 / dt * std::asin(std::min(1.0, 0.5 * frequency * dt));
        const double off = frequency / (size * (is_p ? material_.p_wave_speed() : material_.s_wave_speed())) - 1.0;
        (is_p ? error.p : error.s) += off * off / (is_p ? n_directions : 2 * n_directions);
      }
    }
    return {std::sqrt(error.p), std::sqrt(error.s)};
  }

 private:
  void tie(int a, int b) {
    pairs_(a, a) += 1.0;
    pairs_(b, b) += 1.0;
    pairs_(a, b) -= 1.0;
    pairs_(b, a) -= 1.0;
  }
  // A uniform motion, as the eigenvectors are scaled.
  Eigen::VectorXcd even(const Vec3& way) const {
    Eigen::VectorXcd field(3 * n_);
    for (int i = 0; i < n_; ++i) field.segment<3>(3 * i) = (std::sqrt(lumped_[i]) * way).cast<std::complex<double>>();
    return field;
  }
  // The matrix of the endless lattice for fields that turn by k over a unit length.
  template <class Matrix>
  Waves folded(const Matrix& matrix, const Vec3& k, int dim) const {
    Waves turn = Waves::Zero(dim * mesh_.n_nodes(), dim * n_);
    for (int i = 0; i < mesh_.n_nodes(); ++i)
      for (int d = 0; d < dim; ++d)
        turn(dim * i + d, dim * class_[static_cast<size_t>(i)] + d) = std::polar(1.0, k.dot(mesh_.nodes.col(i)));
    return turn.adjoint() * Mat(matrix).cast<std::complex<double>>() * turn;
  }
  Waves inverse_mass(const Vec3& k, MassOf mass, double share) const {
    if (mass == MassOf::consistent) return folded(consistent_, k, 1).inverse();
    const Waves inverse = lumped_.cwiseInverse().cast<std::complex<double>>().asDiagonal();
    if (mass == MassOf::diagonal) return inverse;
    return inverse + share * inverse * folded(pairs_, k, 1) * inverse;
  }
  // Squares, increasing, and motions times the root of the lumped mass.
  std::pair<Vec, Waves> frequencies2(const Vec3& k, MassOf mass, double share) const {
    const Waves scalar = inverse_mass(k, mass, share);
    Waves inverse = Waves::Zero(3 * n_, 3 * n_);
    for (int a = 0; a < n_; ++a)
      for (int b = 0; b < n_; ++b)
        for (int d = 0; d < 3; ++d) inverse(3 * a + d, 3 * b + d) = 0.5 * (scalar(a, b) + std::conj(scalar(b, a)));
    const Waves root = Eigen::LLT<Waves>(inverse).matrixL();
    const Waves stiffness = folded(body_.stiffness, k, 3);
    const Eigen::SelfAdjointEigenSolver<Waves> solved(root.adjoint() * stiffness * root);
    Waves motions = root * solved.eigenvectors();
    for (int a = 0; a < n_; ++a) motions.middleRows<3>(3 * a) *= std::sqrt(lumped_[a]);
    for (int j = 0; j < motions.cols(); ++j) motions.col(j).normalize();
    return {solved.eigenvalues(), motions};
  }

  Elastic material_;
  Mesh mesh_;
  BodyMatrices body_;
  SparseMatrix consistent_;
  std::vector<int> class_;  // of the nodes, those that are one in the lattice
  int n_ = 0;
  Vec lumped_;
  Mat pairs_;
};

void print(const char* what, const PhaseError& of_20, const PhaseError& of_10) {
  std::cout << "    " << what << ": P " << 100 * of_20.p << ", S " << 100 * of_20.s << " %; 10 nodes: P "
            << 100 * of_10.p << ", S " << 100 * of_10.s << " %\n";
}

TEST(Dispersion, of_the_scaled_diagonal_goes_by_frequency_and_that_of_the_consistent_mass_by_the_fourth_power) {
  for (const CellShape& cell : cell_shapes) {
    if (cell.inertia != Inertia::consistent) continue;
    const Lattice lattice(cell.type);
    const double dt = lattice.longest_step(MassOf::diagonal),
                 dt_of_consistent = lattice.longest_step(MassOf::consistent);
    std::cout << "  " << cell.name << ": longest step x c_P / distance of nodes " << 2.0 * dt * lattice.p_speed()
              << " (consistent mass " << 2.0 * dt_of_consistent * lattice.p_speed()
              << "); phase off at 20 nodes a wavelength\n";
    const auto at = [&](double nodes, MassOf mass, double step) { return lattice.phase_error(nodes, mass, step); };
    const PhaseError consistent = at(20, MassOf::consistent, 0), diagonal = at(20, MassOf::diagonal, 0);
    const PhaseError consistent_10 = at(10, MassOf::consistent, 0), diagonal_10 = at(10, MassOf::diagonal, 0);
    print("consistent mass", consistent, consistent_10);
    print("diagonal mass  ", diagonal, diagonal_10);
    print("explicit       ", at(20, MassOf::diagonal, 0.98 * dt), at(10, MassOf::diagonal, 0.98 * dt));
    EXPECT_GT(std::log2(consistent_10.s / consistent.s), 3.5) << cell.name;
    EXPECT_GT(dt, dt_of_consistent) << cell.name;
    if (cell.type == CellType::hex27) {
      EXPECT_LT(diagonal.s, 1.1 * consistent.s);
      continue;
    }
    EXPECT_NEAR(std::log2(diagonal_10.s / diagonal.s), 2.0, 0.15) << cell.name;
    const double ratio = std::pow(lattice.p_speed(), 2) / std::pow(material_of(1.0, 0.3).s_wave_speed(), 2);
    EXPECT_NEAR(diagonal.p / diagonal.s, ratio, 0.15 * ratio) << cell.name;  // at one frequency P and S are off alike
  }
}

TEST(Dispersion, pairs_of_nodes_take_off_of_shear_waves_what_they_cost_in_time_step) {
  const Lattice lattice(CellType::tet10);
  const double dt = lattice.longest_step(MassOf::diagonal);
  for (const double share : {0.005, 0.01, 0.02}) {
    const double step = lattice.longest_step(MassOf::pairs, share);
    const PhaseError error = lattice.phase_error(20, MassOf::pairs, 0.98 * step, share);
    std::cout << "  tet10, share " << share << ": step x " << step / dt << ", P " << 100 * error.p << ", S "
              << 100 * error.s << " %\n";
    EXPECT_LT(step, 0.95 * dt);
  }
}

}  // namespace
}  // namespace dygita::test
