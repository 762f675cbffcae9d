#include "mesh/condensed_body.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/fnv1a.hpp"
#include "numerics/dense.hpp"

namespace dygita {

namespace {

Eigen::Map<const Vec> flat(const Points& nodal) { return {nodal.data(), nodal.size()}; }

// R A R^T with R the rotation of each node.
SparseMatrix turned(const SparseMatrix& a, const Mat3& turn) {
  SparseMatrix result = a;
  const int* starts = a.outerIndexPtr();
  for (int node = 0; 3 * node < a.rows(); ++node) {
    const int first = starts[3 * node], n = starts[3 * node + 1] - first;
    for (int e = 0; e < n; e += 3) {
      Mat3 block;
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) block(r, c) = a.valuePtr()[starts[3 * node + r] + e + c];
      block = (turn * block * turn.transpose()).eval();
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) result.valuePtr()[starts[3 * node + r] + e + c] = block(r, c);
    }
  }
  return result;
}

}  // namespace

int CondensedBody::n_rows() const {
  const auto n = 3 * (kinds.size() - followers.size()) - held.size() - absent.size();
  return static_cast<int>(n);
}

int CondensedBody::n_places() const {
  int n = 0;
  for (int node = 0; node < n_nodes(); ++node) n += followers.empty() ? is_place(node) : follower(node) != nullptr;
  return n;
}

Points CondensedBody::rigid_motion(const Points& x, const Vec3& about, const Vec3& at_point,
                                   const Vec3& rotation) const {
  const Vec3 translation = at_point - rotation.cross(about);  // at the origin
  Points motion = Points::Zero(3, n_nodes());
  for (int node = 0; node < n_nodes(); ++node)
    if (is_place(node)) motion.col(node) = translation + rotation.cross(x.col(node));
  for (const Follower& own : followers)
    if (own.turn >= 0) motion.col(own.turn) = own.size * rotation;
  if (carried.size() == 0) return motion;
  Eigen::Matrix<double, 6, 1> whole;
  whole << translation, rotation;
  motion.reshaped() += carried * whole;
  return motion;
}

// Of a field a + G (x - c) about the centre of mass c, the force is m a, and the moment that of G S, S the integral of
// (x - c)(x - c)^T over the mass: tr(J)/2 - J.
Points CondensedBody::acceleration(const Points& x, const std::function<Vec3(const Vec3&)>& at) const {
  const Vec3 near = x.col(0);
  Mat motions(3 * n_nodes(), 6);
  for (int m = 0; m < 3; ++m) {
    motions.col(m) = flat(rigid_motion(x, near, Vec3::Unit(m), Vec3::Zero()));
    motions.col(3 + m) = flat(rigid_motion(x, near, Vec3::Zero(), Vec3::Unit(m)));
  }
  const Eigen::Matrix<double, 6, 6> inertia = motions.transpose() * (mass_matrix * motions);
  const double mass = inertia.topLeftCorner<3, 3>().trace() / 3.0;
  if (mass <= 0.0) return rigid_motion(x, near, at(near), Vec3::Zero());
  const Vec3 arm = Vec3(inertia(1, 5), inertia(2, 3), inertia(0, 4)) / mass;
  const Mat3 about_centre =
      inertia.bottomRightCorner<3, 3>() - mass * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
  const Vec3 centre = near + arm, uniform = at(centre);
  const double length = std::max(x.colwise().norm().maxCoeff(), 1e-3);
  Mat3 gradient;
  for (int i = 0; i < 3; ++i) gradient.col(i) = (at(centre + length * Vec3::Unit(i)) - uniform) / length;
  if (gradient.norm() * length <= 1e-12 * uniform.norm()) return rigid_motion(x, centre, uniform, Vec3::Zero());
  const Mat3 moved = gradient * (0.5 * about_centre.trace() * Mat3::Identity() - about_centre);
  const Vec3 moment(moved(2, 1) - moved(1, 2), moved(0, 2) - moved(2, 0), moved(1, 0) - moved(0, 1));
  return rigid_motion(x, centre, uniform, about_centre.completeOrthogonalDecomposition().solve(moment));
}

void CondensedBody::find_carried(const Points& x) {
  carried.resize(0, 0);
  std::vector<int> own;
  // An axis of the last node that has no amplitude has no stiffness either: least norm leaves it alone.
  for (int row = 0; row < 3 * n_nodes(); ++row)
    if (kinds[row / 3] == NodeKind::amplitude) own.push_back(row);
  if (own.empty()) return;
  Mat places(3 * n_nodes(), 6);
  for (int m = 0; m < 3; ++m) {
    places.col(m) = flat(rigid_motion(x, Vec3::Unit(m), Vec3::Zero()));
    places.col(3 + m) = flat(rigid_motion(x, Vec3::Zero(), Vec3::Unit(m)));
  }
  const Mat pull = (stiffness * places)(own, Eigen::all);
  const auto own_stiffness = [&] {
    Mat k(static_cast<Eigen::Index>(own.size()), static_cast<Eigen::Index>(own.size()));
    for (size_t i = 0; i < own.size(); ++i)
      for (size_t j = 0; j < own.size(); ++j)
        k(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = stiffness.coeff(own[i], own[j]);
    return k;
  };
  carried = Mat::Zero(3 * n_nodes(), 6);
  if (pull.isZero(0.0)) return;
  carried(own, Eigen::all) = solve_least_norm(own_stiffness(), -pull, 1e-12).x;
}

Vec CondensedBody::node_masses() const {
  const Vec diagonal = mass_matrix.diagonal();
  Vec masses = Vec::Zero(n_nodes());
  for (int node = 0; node < n_nodes(); ++node)
    if (kinds[node] == NodeKind::point) masses[node] = std::max(0.0, diagonal.segment<3>(3 * node).mean());
  if (masses.sum() <= 0.0)
    for (int node = 0; node < n_nodes(); ++node) masses[node] = kinds[node] == NodeKind::point;
  return mass_of_parts / masses.sum() * masses;
}

ResistedMotions CondensedBody::resisted_motions(const Points& x) const {
  constexpr double nothing = 1e-7;  // of what the same motion without signs would meet
  using Mat6 = Eigen::Matrix<double, 6, 6>;
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (int node = 0; node < n_nodes(); ++node)
    if (is_place(node)) {
      low = low.cwiseMin(x.col(node));
      high = high.cwiseMax(x.col(node));
    }
  // Rotations about the middle, times the size, so that all six are lengths.
  const Vec3 centre = 0.5 * (low + high);
  const double size = std::max((high - low).norm(), std::numeric_limits<double>::min());
  Mat motions(3 * n_nodes(), 6);
  for (int m = 0; m < 3; ++m) {
    const Vec3 rotation = Vec3::Unit(m) / size;
    motions.col(m) = flat(rigid_motion(x, Vec3::Unit(m), Vec3::Zero()));
    motions.col(3 + m) = flat(rigid_motion(x, -rotation.cross(centre), rotation));
  }
  Mat6 gram = motions.transpose() * (stiffness * motions);
  const double most =
      (motions.cwiseAbs().transpose() * (stiffness.cwiseAbs() * motions.cwiseAbs())).diagonal().maxCoeff();
  gram /= std::max(most, std::numeric_limits<double>::min());
  for (const auto* list : {&held, &absent})
    for (const auto& [node, direction] : *list) {
      if (kinds[node] == NodeKind::amplitude) continue;
      const Eigen::Matrix<double, 6, 1> row = motions.middleRows<3>(3 * node).transpose() * direction;
      if (row.norm() > 0.0) gram += row * row.transpose();
    }
  const EigenPairs eigen = symmetric_eigen(gram);
  ResistedMotions resisted(6, 0);
  for (int i = 0; i < 6; ++i) {
    if (eigen.values[i] < nothing) continue;
    // a . t_centre + b . (rotation size), with t_centre = t_origin + rotation x centre.
    const Vec3 a = eigen.vectors.col(i).head<3>(), b = eigen.vectors.col(i).tail<3>();
    resisted.conservativeResize(6, resisted.cols() + 1);
    resisted.rightCols(1) << a, centre.cross(a) + size * b;
  }
  return resisted;
}

double CondensedBody::modulus(const Points& x) const {
  const Vec diagonal = stiffness.diagonal();
  std::vector<int> points;
  for (int node = 0; node < n_nodes(); ++node)
    if (kinds[node] == NodeKind::point) points.push_back(node);
  std::vector<double> moduli;
  const size_t step = 1 + points.size() / 200;
  for (size_t i = 0; i < points.size(); i += step) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const int other : points)
      if (const double d = (x.col(other) - x.col(points[i])).norm(); d > 0.0) nearest = std::min(nearest, d);
    for (const Follower& own : followers)
      if (own.point == points[i]) nearest = std::min(nearest, own.size);
    const double stiff = diagonal.segment<3>(3 * points[i]).maxCoeff();
    if (std::isfinite(nearest) && stiff > 0.0) moduli.push_back(stiff / nearest);
  }
  if (moduli.empty()) return std::max(diagonal.maxCoeff(), std::numeric_limits<double>::min());
  std::nth_element(moduli.begin(), moduli.begin() + static_cast<long>(moduli.size() / 2), moduli.end());
  return moduli[moduli.size() / 2];
}

std::shared_ptr<const Interior> CondensedBody::turned(const Mat3& turn, const Points& x) const {
  auto copy = std::make_shared<CondensedBody>(*this);
  for (SparseMatrix* matrix : {&copy->stiffness, &copy->mass_matrix, &copy->damping})
    if (matrix->size() > 0) *matrix = dygita::turned(*matrix, turn);
  for (Follower& own : copy->followers) own.arm = turn * own.arm;
  for (auto* list : {&copy->held, &copy->absent})
    for (auto& [node, direction] : *list) direction = turn * direction;
  copy->find_carried(x);
  return copy;
}

void CondensedBody::add_to(Fnv1a& digest) const {
  for (const SparseMatrix* matrix : {&stiffness, &mass_matrix, &damping})
    digest.add(matrix->valuePtr(), sizeof(double) * static_cast<size_t>(matrix->nonZeros()));
}

}  // namespace dygita
