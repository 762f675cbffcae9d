#include "model/cyclic.hpp"

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <numbers>

#include "mesh/face_nodes.hpp"

namespace dygita {

namespace {

// m, from the axis to the middle of a face.
Vec3 arm_of(const Face& face, const Vec3& through, const Vec3& along) {
  if (!face.part->mesh->has_cells())
    throw InputError(fmt::format("'{}' is a face of a part of matrices, which has no cut face", face.label()));
  const FaceNodes nodes = face_nodes(*face.part->mesh, face.facets());
  Vec3 middle = face.part->place - through;
  double largest = 0.0;
  for (size_t i = 0; i < nodes.nodes.size(); ++i) {
    const Vec3 x = face.part->mesh->nodes.col(nodes.nodes[i]);
    middle += nodes.weights[static_cast<Eigen::Index>(i)] / nodes.weights.sum() * x;
    largest = std::max(largest, along.cross(x + face.part->place - through).norm());
  }
  const Vec3 arm = middle - along.dot(middle) * along;
  constexpr double least = 0.01;
  if (arm.norm() < least * largest)
    throw InputError(
        fmt::format("the middle of '{}' is on the axis: a cut face reaches from the axis outwards", face.label()));
  return arm;
}

}  // namespace

CyclicSymmetry cyclic_symmetry(const Face& side_1, const Face& side_2, const Vec3& through, const Vec3& along, int n) {
  const Vec3 to = arm_of(side_1, through, along), from = arm_of(side_2, through, along);
  const double angle = std::atan2(along.dot(from.cross(to)), from.dot(to)), sector = 2.0 * std::numbers::pi / n;
  const double deg = 180.0 / std::numbers::pi;
  if (std::abs(std::abs(angle) - sector) > std::min(0.01, 0.3 / n) * sector) {
    const double sectors = 2.0 * std::numbers::pi / std::abs(angle), nearest = std::round(sectors);
    const bool is_whole = std::abs(sectors - nearest) < 0.01 * sectors && nearest > 1.0 && nearest <= 10000.0;
    throw InputError(
        fmt::format("'{}' and '{}' are {:.4g} degrees apart around the axis, and n = {} makes it {:.4g}\n    {}",
                    side_1.label(), side_2.label(), deg * std::abs(angle), n, deg * sector,
                    is_whole ? fmt::format("a ring of such sectors has n = {:.0f}", nearest)
                             : std::string("check the faces, 'axis' and 'through'")));
  }
  CyclicSymmetry cyclic{through, along, n, Mat3(Eigen::AngleAxisd(std::copysign(sector, angle), along)), {}};
  cyclic.turned =
      turned_mesh(*side_2.part->mesh, cyclic.turn, through + cyclic.turn * Vec3(side_2.part->place - through));
  return cyclic;
}

}  // namespace dygita
