// The tangents of the local stage (manual, eq. U1-U3).
#include "latin/local_stage.hpp"
#include "law/law.hpp"
#include "law/law_slope.hpp"

namespace dygita {

LocalStage::LawTangent LocalStage::law_tangent(size_t i_point, bool sticks, bool follows, double least,
                                               const TangentBounds& bounds) const {
  const Point& point = model_->exchange.points[i_point];
  const PointRecord& record = points_[i_point];
  if (!point.law || record.is_released) return {};
  const auto slope = [&](const double* limit) {
    return slope_of(*point.law, record.trial, increment_at(point), record.law, limit, least);
  };
  const double* limit = follows ? &record.trial.s[0] : limit_at(i_point);
  LawTangent tangent;
  tangent.stiffness = stiffness_of(slope(limit), record.trial.y, sticks, bounds);
  if (follows) tangent.following = following_of(slope(nullptr), tangent.stiffness, record.trial.y);
  return tangent;
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
PointTangent LocalStage::point_tangent(const Point& point, const Mat3& of_law, const Vec3& following,
                                       double tie) const {
  const std::vector<PortRow> rows = port_rows(point);
  const auto n = static_cast<Eigen::Index>(rows.size());
  PointTangent tangent{{}, Mat::Zero(n, n), {}, {}, of_law(0, 0)};
  if (!following.isZero()) tangent.normal = tangent.following = Vec::Zero(n);
  for (Eigen::Index r = 0; r < n; ++r) {
    const PortRow& a = rows[r];
    tangent.unknowns.push_back(a.unknown);
    if (tangent.following.size() > 0) {
      tangent.normal[r] = a.sign * a.share * of_law(0, a.direction);
      tangent.following[r] = a.sign * a.share * following[a.direction];
    }
    for (Eigen::Index c = 0; c < n; ++c) {
      const PortRow& b = rows[c];
      tangent.matrix(r, c) = a.sign * b.sign * a.share * b.share * of_law(a.direction, b.direction);
      if (a.direction != b.direction || a.sign != b.sign || a.share == 1.0) continue;
      tangent.matrix(r, c) += tie * ((r == c ? k_[a.unknown] : 0.0) - a.share * k_[b.unknown]);
    }
  }
  return tangent;
}

PreloadTangent LocalStage::preload_tangent(const Preload& preload, const std::vector<LawTangent>& of_law) const {
  PreloadTangent tangent;
  tangent.points = preload.points;
  for (const int i : preload.points) {
    tangent.stiffness += of_law[i].stiffness(0, 0);
    for (const PortRow& row : port_rows(model_->exchange.points[i]))
      if (row.share > 0.0)
        tangent.column.emplace_back(row.unknown, row.sign * row.share * of_law[i].stiffness(row.direction, 0));
  }
  return tangent;
}

Tangents LocalStage::tangents(bool sticks, bool follows, double least, const TangentBounds& bounds) const {
  const std::vector<Point>& points = model_->exchange.points;
  Tangents tangents;
  std::vector<LawTangent> of_law(points.size());
  std::vector<bool> gives_way(points.size(), false);
  for (const Preload& preload : preloads_)
    for (const int i : preload.points) gives_way[static_cast<size_t>(i)] = true;
  for (size_t i = 0; i < points.size(); ++i) {
    TangentBounds own = bounds;
    if (points[i].law && points[i].law->is_tie() && !gives_way[i]) own.stiffest = bounds.tie;
    of_law[i] = law_tangent(i, sticks, follows, least, own);
    tangents.points.push_back(point_tangent(points[i], of_law[i].stiffness, of_law[i].following, bounds.tie));
  }
  if (prescribed_.size() > 0) return tangents;
  for (const Preload& preload : preloads_)
    if (PreloadTangent own = preload_tangent(preload, of_law); own.stiffness > 0.0)
      tangents.preloads.push_back(std::move(own));
  return tangents;
}

}  // namespace dygita
