#include "drawing/cut_plane.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/log.hpp"
#include "drawing/units.hpp"
#include "mesh/face_nodes.hpp"
#include "model/effects.hpp"
#include "model/load.hpp"

namespace dygita {

namespace {

constexpr double smallest_facing = 0.35;  // cosine between the plane's normal and the line of sight
constexpr double along = 0.1;             // sine between a bolt's axis and a plane that holds it
constexpr size_t most_pairs_of = 40;      // bolts: beyond them only planes along the axes are tried
constexpr size_t most_named = 4;

struct Bolt {
  std::string name;
  Vec3 centre = Vec3::Zero(), axis = Vec3::Zero();  // m, unit
  double radius = 0.0;                              // m
};

bool is_tightened(const Problem& problem, const Interface* interface) {
  for (const StepPtr& step : problem.steps)
    for (const LoadPtr& load : step->loads)
      for (const Effect& effect : load->effects())
        if (const Tightening* by = tightening(effect); by && by->on.get() == interface) return true;
  return false;
}

std::vector<Bolt> bolts_of(const Problem& problem) {
  std::vector<Bolt> bolts;
  for (const InterfacePtr& interface : problem.interfaces) {
    if (!is_tightened(problem, interface.get())) continue;
    const Substructure& part = *interface->side_1.part;
    Bolt bolt{interface->name};
    double area = 0.0;
    for (const Facet& facet : interface->side_1.facets()) {
      const Vec3 own = facet_area_vector(part.mesh->nodes, facet);
      Vec3 middle = Vec3::Zero();
      for (const int node : facet.corners())
        middle += part.mesh->nodes.col(node) / static_cast<double>(facet.corners().size());
      bolt.centre += own.norm() * (middle + part.place);
      bolt.axis += own;
      area += own.norm();
    }
    if (!(area > 0.0) || !(bolt.axis.norm() > 0.5 * area)) continue;
    bolt.centre /= area;
    bolt.axis.normalize();
    bolt.radius = std::sqrt(area / M_PI);
    bolts.push_back(bolt);
  }
  return bolts;
}

bool holds(const Vec3& normal, const Vec3& point, const Bolt& bolt) {
  return std::abs(normal.dot(bolt.axis)) < along && std::abs(normal.dot(bolt.centre - point)) < 0.2 * bolt.radius;
}

using Boxes = std::vector<std::array<Vec3, 8>>;

// Corners of each part's bounding box.
Boxes boxes_of(const Problem& problem) {
  Boxes boxes;
  for (const SubstructurePtr& part : problem.substructures) {
    if (part->mesh->n_nodes() == 0) continue;
    const Vec3 low = part->mesh->nodes.rowwise().minCoeff() + part->place,
               high = part->mesh->nodes.rowwise().maxCoeff() + part->place;
    boxes.emplace_back();
    for (unsigned i = 0; i < 8; ++i)
      boxes.back()[i] = {i & 1u ? high[0] : low[0], i & 2u ? high[1] : low[1], i & 4u ? high[2] : low[2]};
  }
  return boxes;
}

// Parts that lie on both sides of a plane.
size_t n_cut(const Boxes& boxes, const Vec3& normal, const Vec3& point) {
  return static_cast<size_t>(std::count_if(boxes.begin(), boxes.end(), [&](const std::array<Vec3, 8>& corners) {
    const auto is_above = [&](const Vec3& x) { return normal.dot(x - point) > 0.0; };
    return std::any_of(corners.begin(), corners.end(), is_above) &&
           !std::all_of(corners.begin(), corners.end(), is_above);
  }));
}

// Normals of planes that hold the axis of a bolt.
std::vector<Vec3> normals_at(const Bolt& bolt, const std::vector<Bolt>& bolts) {
  std::vector<Vec3> normals = {Vec3::UnitY(), Vec3::UnitX(), Vec3::UnitZ()};
  if (bolts.size() <= most_pairs_of)
    for (const Bolt& other : bolts) {
      const Vec3 across = bolt.axis.cross(other.centre - bolt.centre);
      if (across.norm() > bolt.radius) normals.push_back(across.normalized());
    }
  return normals;
}

}  // namespace

std::string plane_text(const Vec3& normal, const Vec3& point) {
  int axis = 0;
  if (normal.cwiseAbs().maxCoeff(&axis) < 1.0 - 1e-9) return "a plane";
  return fmt::format("the plane {} = {}", "xyz"[axis],
                     with_unit(std::abs(point[axis]) < 1e-9 ? 0.0 : point[axis], "m"));
}

std::optional<CutPlane> plane_through_bolts(const Problem& problem, const View& view) {
  const std::vector<Bolt> bolts = bolts_of(problem);
  const Vec3 sight = view.axes.row(2).transpose();
  std::optional<CutPlane> best;
  std::pair<size_t, size_t> most{0, 0};  // bolts, parts
  const Boxes boxes = boxes_of(problem);
  for (const Bolt& bolt : bolts)
    for (const Vec3& normal : normals_at(bolt, bolts)) {
      if (std::abs(normal.dot(sight)) < smallest_facing || !holds(normal, bolt.centre, bolt)) continue;
      std::vector<std::string> held;
      for (const Bolt& other : bolts)
        if (holds(normal, bolt.centre, other)) held.push_back("'" + other.name + "'");
      const std::pair own{held.size(), n_cut(boxes, normal, bolt.centre)};
      if (own <= most) continue;
      most = own;
      best = CutPlane{normal.dot(sight) > 0.0 ? normal : Vec3(-normal), bolt.centre, "through "};
      for (size_t i = 0; i < std::min(held.size(), most_named); ++i) best->text += (i > 0 ? ", " : "") + held[i];
      if (held.size() > most_named) best->text += fmt::format(" and {} more", held.size() - most_named);
      best->text += ", " + plane_text(normal, bolt.centre);
    }
  return best;
}

}  // namespace dygita
