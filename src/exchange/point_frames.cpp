#include "exchange/point_frames.hpp"

#include <cmath>
#include <map>
#include <set>

namespace dygita {

namespace {

// Places of copies agree but for rounding.
bool comes_first(const Vec3& a, const Vec3& b) {
  for (int i = 0; i < 3; ++i)
    if (std::abs(a[i] - b[i]) > 1e-9 * (a.norm() + b.norm())) return a[i] < b[i];
  return false;
}

}  // namespace

FrameAxes::FrameAxes(const Problem& problem) : problem_(problem) {
  std::map<std::string, const Mesh*> first;
  std::set<std::string> turning;
  for (const SubstructurePtr& part : problem.substructures) {
    const Mesh& mesh = *part->mesh;
    const auto [at, is_new] = first.try_emplace(mesh.shape_digest(), &mesh);
    if (!is_new && at->second->turn != mesh.turn) turning.insert(mesh.shape_digest());
  }
  for (const SubstructurePtr& part : problem.substructures)
    turns_.push_back(turning.contains(part->mesh->shape_digest()));
}

std::optional<Mat3> FrameAxes::at(const std::vector<int>& parts, const Vec3& place) const {
  const Mat3* axes = nullptr;
  Vec3 first = Vec3::Zero();
  for (const int i : parts) {
    if (!turns_[i]) continue;
    const Substructure& part = *problem_.substructures[i];
    const Vec3 own = part.mesh->turn.transpose() * (place - part.place - part.mesh->shift);
    if (axes && !comes_first(own, first)) continue;
    axes = &part.mesh->turn;
    first = own;
  }
  return axes ? std::optional(*axes) : std::nullopt;
}

Mat3 frame_of(const Vec3& n, Vec3 t, const std::optional<Mat3>& axes) {
  if (t.isZero()) {
    const Vec3 along = (axes ? Vec3(axes->transpose() * n) : n).cwiseAbs();
    int least = 0;
    const double smallest = along.minCoeff(&least);
    // Which of two that are alike may not depend on how a copy's normal has been rounded.
    for (int i = 2; i >= 0 && axes; --i)
      if (along[i] < smallest + 1e-6) least = i;
    t = axes ? Vec3(axes->col(least)) : Vec3::Unit(least);
  }
  Mat3 frame;
  frame.col(0) = n;
  frame.col(1) = (t - n.dot(t) * n).normalized();
  frame.col(2) = n.cross(frame.col(1));
  return frame;
}

void activate(const std::vector<Port>& ports, bool has_group, Point& point) {
  for (int d = 0; d < 3; ++d) {
    if (!has_group && !point.has_law[d]) continue;
    for (int p = point.first_port; p < point.end_port; ++p) point.is_active[d] |= !ports[p].is_held[d];
  }
}

}  // namespace dygita
