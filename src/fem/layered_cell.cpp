#include "fem/layered_cell.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "fem/hex8_modes.hpp"
#include "fem/isoparametric.hpp"
#include "mesh/shape_functions.hpp"

namespace dygita {

namespace {

struct Rule {
  std::vector<double> at, weight;
};

Rule gauss(int n) {
  if (n == 2) return {{-std::sqrt(1.0 / 3.0), std::sqrt(1.0 / 3.0)}, {1.0, 1.0}};
  return {{-std::sqrt(0.6), 0.0, std::sqrt(0.6)}, {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0}};
}

bool is_linear(CellType type) { return type == CellType::hex8; }

// Of the stresses across: constant, and linear through the thickness.
Eigen::Matrix<double, 3, 6> shapes_across(double t) {
  Eigen::Matrix<double, 3, 6> shapes;
  shapes << Mat3::Identity(), t * Mat3::Identity();
  return shapes;
}

// Of a level, the volume there and what the strains below, in the middle and above count for in it: volume times strain
// is a quadratic, since the inverse of the Jacobian is a polynomial over its determinant.
struct Level {
  double volume;
  std::array<double, 3> shares;
};
Level level_at(double t, const std::array<double, 3>& volumes) {
  Level level{0.0, {0.5 * t * (t - 1.0), 1.0 - t * t, 0.5 * t * (t + 1.0)}};
  for (size_t m = 0; m < 3; ++m) level.volume += level.shares[m] *= volumes[m];
  for (double& share : level.shares) share /= level.volume;
  return level;
}

// Points through the thickness: a ply, the level, and the share of the weight.
template <class Visit>
void each_point(const Layup& layup, int points_per_ply, Visit&& visit) {
  const Rule rule = gauss(points_per_ply);
  for (int i = 0; i < layup.n_plies(); ++i) {
    const double middle = 0.5 * (layup.bound(i) + layup.bound(i + 1)),
                 half = 0.5 * (layup.bound(i + 1) - layup.bound(i));
    for (size_t k = 0; k < rule.at.size(); ++k) visit(layup.law(i), middle + half * rule.at[k], half * rule.weight[k]);
  }
}

}  // namespace

LayeredCell::LayeredCell(CellType type, const CellNodes& x, const Mat3& axes, const Layup& layup)
    : type_(type), x_(axes.transpose() * x), axes_(axes), layup_(layup), n_modes_(is_linear(type) ? n_hex8_modes : 0) {
  centre_ = x_ * shape_functions(type).slopes(Vec3::Zero());
  through_ = through(centre_);
}

double LayeredCell::level(int node) const {
  return through_.sign *
         cell_shape(type_).shape.nodes[static_cast<size_t>(node)][static_cast<size_t>(through_.direction)];
}

Vec3 LayeredCell::place(double a, double b, double t) const {
  Vec3 xi;
  xi[through_.direction] = through_.sign * t;
  xi[(through_.direction + 1) % 3] = a;
  xi[(through_.direction + 2) % 3] = b;
  return xi;
}

// The modes of a hex8 as in hex8.cpp.
Mat LayeredCell::strain(const Vec3& xi, double& volume) const {
  const auto slopes = shape_functions(type_).slopes(xi);
  const Mat3 jacobian = x_ * slopes;
  volume = jacobian.determinant();
  check_point_volume(volume);
  const Eigen::Matrix<double, Eigen::Dynamic, 3> gradients = slopes * jacobian.inverse();
  Mat strain(6, n_dofs());
  const int n = static_cast<int>(x_.cols());
  for (int a = 0; a < n; ++a) strain.middleCols<3>(3 * a) = strain_of_node(gradients.row(a));
  if (n_modes_ == 0) return strain;
  const Mat3 centre = centre_.inverse().transpose();
  const double scale = centre_.determinant() / volume;
  for (int j = 0; j < 3; ++j) strain.middleCols<3>(3 * (n + j)) = strain_of_node(scale * xi[j] * centre.col(j));
  for (int k = 0; k < 3; ++k)
    strain.col(3 * (n + 3) + k) = strain_of(scale * xi[(k + 1) % 3] * xi[(k + 2) % 3] * Mat3::Identity());
  return strain;
}

LayeredCell::Column LayeredCell::column(double a, double b, int points_per_ply) const {
  Column column;
  for (size_t m = 0; m < n_levels; ++m)
    column.strains[m] = strain(place(a, b, static_cast<double>(m) - 1.0), column.volumes[m]);
  using Half = Eigen::Matrix<double, 6, 3>;
  std::array<Half, n_levels> of_across, of_plane;
  of_across.fill(Half::Zero());
  of_plane.fill(Half::Zero());
  each_point(layup_, points_per_ply, [&](const PlyLaw& law, double t, double share) {
    const auto [volume, shares] = level_at(t, column.volumes);
    const double w = share * volume;
    const auto shapes = shapes_across(t);
    column.soft += w * shapes.transpose() * law.s * shapes;
    for (size_t m = 0; m < n_levels; ++m) {
      of_across[m] += w * shares[m] * shapes.transpose();
      of_plane[m] += w * shares[m] * shapes.transpose() * law.h.transpose();
    }
  });
  column.across = Mat::Zero(6, n_dofs());
  for (size_t m = 0; m < n_levels; ++m)
    column.across += of_across[m] * column.strains[m](across_rows, Eigen::all) +
                     of_plane[m] * column.strains[m](plane_rows, Eigen::all);
  return column;
}

Mat LayeredCell::stiffness_of(const Column& column, int points_per_ply) const {
  std::array<std::array<Mat3, n_levels>, n_levels> plane;
  for (auto& row : plane) row.fill(Mat3::Zero());
  each_point(layup_, points_per_ply, [&](const PlyLaw& law, double t, double share) {
    const auto [volume, shares] = level_at(t, column.volumes);
    const double w = share * volume;
    for (size_t m = 0; m < n_levels; ++m)
      for (size_t l = 0; l < n_levels; ++l) plane[m][l] += w * shares[m] * shares[l] * law.q;
  });
  Mat stiffness = column.across.transpose() * column.soft.llt().solve(column.across);
  for (size_t m = 0; m < n_levels; ++m) {
    Mat stress = Mat::Zero(3, n_dofs());
    for (size_t l = 0; l < n_levels; ++l) stress += plane[m][l] * column.strains[l](plane_rows, Eigen::all);
    const Mat strains = column.strains[m](plane_rows, Eigen::all);
    stiffness.noalias() += strains.transpose() * stress;
  }
  return stiffness;
}

Mat LayeredCell::whole_stiffness() const {
  const Rule rule = gauss(points_per_ply());
  Mat stiffness = Mat::Zero(n_dofs(), n_dofs());
  for (size_t i = 0; i < rule.at.size(); ++i)
    for (size_t j = 0; j < rule.at.size(); ++j)
      stiffness += rule.weight[i] * rule.weight[j] *
                   stiffness_of(column(rule.at[i], rule.at[j], points_per_ply()), points_per_ply());
  return stiffness;
}

CellMatrix LayeredCell::stiffness() const {
  const int n = n_dofs() - n_modes_;
  const Mat whole = whole_stiffness();
  Mat own = whole.topLeftCorner(n, n);
  if (n_modes_ > 0)
    own -= whole.topRightCorner(n, n_modes_) *
           whole.bottomRightCorner(n_modes_, n_modes_).llt().solve(whole.bottomLeftCorner(n_modes_, n));
  CellMatrix stiffness(n, n);
  for (int a = 0; a < n; a += 3)
    for (int b = a; b < n; b += 3) stiffness.block<3, 3>(a, b) = axes_ * own.block<3, 3>(a, b) * axes_.transpose();
  stiffness.triangularView<Eigen::StrictlyLower>() = stiffness.transpose();
  return stiffness;
}

void LayeredCell::move(const CellNodes& displacement) {
  const int n = n_dofs() - n_modes_;
  Vec motion = Vec::Zero(n_dofs());
  const CellNodes own = axes_.transpose() * displacement;
  motion.head(n) = own.reshaped();
  if (n_modes_ > 0) {
    const Mat whole = whole_stiffness();
    motion.tail(n_modes_) =
        -whole.bottomRightCorner(n_modes_, n_modes_).llt().solve(whole.bottomLeftCorner(n_modes_, n) * motion.head(n));
  }
  const Rule rule = gauss(2);
  for (size_t k = 0; k < 4; ++k) {
    const Column at = column(rule.at[k / 2], rule.at[k % 2], points_per_ply());
    for (size_t m = 0; m < n_levels; ++m) strains_[k][m] = at.strains[m] * motion;
    volumes_[k] = at.volumes;
    amplitudes_[k] = at.soft.llt().solve(at.across * motion);
  }
}

Tensors LayeredCell::stress(int ply, double at) const {
  const PlyLaw& law = layup_.law(ply);
  const double t = layup_.bound(ply) + 0.5 * (1.0 + at) * (layup_.bound(ply + 1) - layup_.bound(ply));
  const Rule rule = gauss(2);
  Eigen::Matrix<double, 6, 4> at_places;
  for (size_t k = 0; k < 4; ++k) {
    const std::array<double, n_levels> shares = level_at(t, volumes_[k]).shares;
    const Vec6 e = shares[0] * strains_[k][0] + shares[1] * strains_[k][1] + shares[2] * strains_[k][2];
    const Vec3 across = shapes_across(t) * amplitudes_[k];
    at_places(plane_rows, static_cast<Eigen::Index>(k)) = law.q * e(plane_rows) + law.h * across;
    at_places(across_rows, static_cast<Eigen::Index>(k)) = across;
  }
  const int n = static_cast<int>(x_.cols());
  Tensors at_nodes = Tensors::Zero(6, n);
  for (int node = 0; node < n; ++node) {
    const Vec3 xi = vector_of(cell_shape(type_).shape.nodes[static_cast<size_t>(node)]);
    const double a = xi[(through_.direction + 1) % 3], b = xi[(through_.direction + 2) % 3];
    for (int k = 0; k < 4; ++k)
      at_nodes.col(node) += 0.25 * (1.0 + a / rule.at[static_cast<size_t>(k / 2)]) *
                            (1.0 + b / rule.at[static_cast<size_t>(k % 2)]) * at_places.col(k);
  }
  return at_nodes;
}

}  // namespace dygita
