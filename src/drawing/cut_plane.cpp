#include "drawing/cut_plane.hpp"

#include <Eigen/Geometry>
#include <algorithm>
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
  size_t most = 0;
  for (const Bolt& bolt : bolts)
    for (const Vec3& normal : normals_at(bolt, bolts)) {
      if (std::abs(normal.dot(sight)) < smallest_facing || !holds(normal, bolt.centre, bolt)) continue;
      std::vector<std::string> held;
      for (const Bolt& other : bolts)
        if (holds(normal, bolt.centre, other)) held.push_back("'" + other.name + "'");
      if (held.size() <= most) continue;
      most = held.size();
      best = CutPlane{normal.dot(sight) > 0.0 ? normal : Vec3(-normal), bolt.centre, "through "};
      for (size_t i = 0; i < std::min(held.size(), most_named); ++i) best->text += (i > 0 ? ", " : "") + held[i];
      if (held.size() > most_named) best->text += fmt::format(" and {} more", held.size() - most_named);
      best->text += ", " + plane_text(normal, bolt.centre);
    }
  return best;
}

}  // namespace dygita
