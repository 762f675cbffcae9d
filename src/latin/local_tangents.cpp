// The tangents of the local stage (manual, eq. U1-U3).
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "latin/local_stage.hpp"
#include "law/law.hpp"

namespace dygita {

namespace {

// d force / d s by differences. Where the law has a kink the stiffer side counts: what just touches is closed.
template <class Force>
Mat3 slope_of(const Force& law_force, const Trial& trial, double least) {
  const Vec3 force = law_force(trial);
  const double reach =
      std::max({trial.s.cwiseAbs().maxCoeff(), trial.y.cwiseProduct(force).cwiseAbs().maxCoeff(), least});
  const double h = 1e-6 * reach;
  Mat3 slope = Mat3::Zero();
  for (int d = 0; d < 3; ++d) {
    if (trial.y[d] <= 0.0) continue;
    Trial moved = trial;
    moved.s[d] = trial.s[d] + h;
    const Vec3 up = (law_force(moved) - force) / h;
    moved.s[d] = trial.s[d] - h;
    const Vec3 down = (force - law_force(moved)) / h;
    slope.col(d) = up.norm() > down.norm() ? up : down;
  }
  return slope;
}

// From d force / d s at fixed F + s/y to d force / d rate, its eigenvalues between the bounds. sticks: what carries a
// normal force holds the tangents too.
Mat3 stiffness_of(const Mat3& slope, const Vec3& y, bool sticks, const TangentBounds& bounds) {
  const Vec3 root = y.cwiseMax(0.0).cwiseSqrt();
  Mat3 scaled = root.asDiagonal() * slope * root.asDiagonal();
  scaled = (0.5 * (scaled + scaled.transpose())).eval();
  if (sticks && scaled(0, 0) > 0.5)
    for (const int d : {1, 2}) {
      scaled.row(d).setZero();
      scaled.col(d).setZero();
      scaled(d, d) = y[d] > 0.0 ? 1.0 : 0.0;
    }
  const Eigen::SelfAdjointEigenSolver<Mat3> modes(scaled);
  Vec3 stiffness;
  for (int i = 0; i < 3; ++i) {
    const double g = modes.eigenvalues()[i];
    stiffness[i] =
        g >= bounds.stiffest / (1.0 + bounds.stiffest) ? bounds.stiffest : std::max(bounds.softest, g / (1.0 - g));
  }
  Vec3 inverse_root = Vec3::Zero();
  for (int d = 0; d < 3; ++d)
    if (root[d] > 0.0) inverse_root[d] = 1.0 / root[d];
  const Mat3 half = inverse_root.asDiagonal() * modes.eigenvectors();
  return half * stiffness.asDiagonal() * half.transpose();
}

}  // namespace

Mat3 LocalStage::law_tangent(size_t i_point, bool sticks, double least, const TangentBounds& bounds) const {
  const Point& point = model_->exchange.points[i_point];
  const PointRecord& record = points_[i_point];
  if (!point.law || record.is_released) return Mat3::Zero();
  const Mat3 slope = slope_of([&](const Trial& trial) { return law_force(i_point, trial); }, record.trial, least);
  return stiffness_of(slope, record.trial.y, sticks, bounds);
}

std::vector<LocalStage::PortRow> LocalStage::port_rows(const Point& point) const {
  std::vector<PortRow> rows;
  for (int p = point.first_port; p < point.end_port; ++p) {
    const bool is_first = p < point.first_port_2;
    const int first = is_first ? point.first_port : point.first_port_2;
    const int end = is_first ? point.first_port_2 : point.end_port;
    for (int d = 0; d < 3; ++d) {
      const int unknown = model_->unknown(model_->exchange.ports[p], d);
      if (unknown < 0) continue;
      double sum = 0.0;
      bool is_held = false;
      for (int other = first; other < end; ++other) {
        const Port& port = model_->exchange.ports[other];
        is_held = is_held || port.is_held[d];
        if (const int i = model_->unknown(port, d); i >= 0) sum += k_[i];
      }
      rows.push_back({unknown, d, is_held ? 0.0 : k_[unknown] / sum, is_first ? -1.0 : 1.0});
    }
  }
  return rows;
}

// The law between the means of both sides, and the ties of each side to its mean.
PointTangent LocalStage::point_tangent(const Point& point, const Mat3& of_law, double tie) const {
  const std::vector<PortRow> rows = port_rows(point);
  const auto n = static_cast<Eigen::Index>(rows.size());
  PointTangent tangent{{}, Mat::Zero(n, n)};
  for (Eigen::Index r = 0; r < n; ++r) {
    const PortRow& a = rows[r];
    tangent.unknowns.push_back(a.unknown);
    for (Eigen::Index c = 0; c < n; ++c) {
      const PortRow& b = rows[c];
      tangent.matrix(r, c) = a.sign * b.sign * a.share * b.share * of_law(a.direction, b.direction);
      if (a.direction != b.direction || a.sign != b.sign || a.share == 1.0) continue;
      tangent.matrix(r, c) += tie * ((r == c ? k_[a.unknown] : 0.0) - a.share * k_[b.unknown]);
    }
  }
  return tangent;
}

PreloadTangent LocalStage::preload_tangent(const Preload& preload, const std::vector<Mat3>& of_law) const {
  PreloadTangent tangent;
  for (const int i : preload.points) {
    tangent.stiffness += of_law[i](0, 0);
    for (const PortRow& row : port_rows(model_->exchange.points[i]))
      if (row.share > 0.0) tangent.column.emplace_back(row.unknown, row.sign * row.share * of_law[i](row.direction, 0));
  }
  return tangent;
}

Tangents LocalStage::tangents(bool sticks, double least, const TangentBounds& bounds) const {
  const std::vector<Point>& points = model_->exchange.points;
  Tangents tangents;
  std::vector<Mat3> of_law(points.size(), Mat3::Zero());
  for (size_t i = 0; i < points.size(); ++i) {
    of_law[i] = law_tangent(i, sticks, least, bounds);
    tangents.points.push_back(point_tangent(points[i], of_law[i], bounds.stiffest));
  }
  if (prescribed_.size() > 0) return tangents;
  for (const Preload& preload : preloads_)
    if (PreloadTangent own = preload_tangent(preload, of_law); own.stiffness > 0.0)
      tangents.preloads.push_back(std::move(own));
  return tangents;
}

}  // namespace dygita
