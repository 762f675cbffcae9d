#include "mesher/step_contacts.hpp"

#include <gmsh.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "mesh/box_grid.hpp"

namespace dygita {

namespace {

struct CadSurface {
  int tag = 0;
  bool is_plane = false, is_cylinder = false;
  Box box;
  Vec3 at, normal;  // of a point on it
  Vec3 axis;        // of a cylinder
  double radius = 0.0;
  Vec3 centres[2];  // of a cylinder: on its axis is one of them
};

Vec3 value_at(int tag, double u, double v) {
  std::vector<double> x;
  gmsh::model::getValue(2, tag, {u, v}, x);
  return {x[0], x[1], x[2]};
}

// A plane that the file does not call one: solids that were mirrored have splines for faces.
bool is_flat(int tag, const std::vector<double>& low, const std::vector<double>& high, double within) {
  std::vector<double> n;
  gmsh::model::getNormal(tag, {0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])}, n);
  const Vec3 normal(n[0], n[1], n[2]), first = value_at(tag, low[0], low[1]);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const Vec3 x = value_at(tag, low[0] + i * (high[0] - low[0]) / 3, low[1] + j * (high[1] - low[1]) / 3);
      if (std::abs(normal.dot(x - first)) > 0.1 * within) return false;
    }
  return true;
}

CadSurface cad_surface(int tag, double within) {
  CadSurface surface;
  surface.tag = tag;
  std::string type;
  gmsh::model::getType(2, tag, type);
  surface.is_plane = type == "Plane";
  surface.is_cylinder = type == "Cylinder";
  Box& box = surface.box;
  gmsh::model::getBoundingBox(2, tag, box.low[0], box.low[1], box.low[2], box.high[0], box.high[1], box.high[2]);
  box = box.grown(within);
  std::vector<double> low, high, x, n;
  gmsh::model::getParametrizationBounds(2, tag, low, high);
  if (!surface.is_plane && !surface.is_cylinder) surface.is_plane = is_flat(tag, low, high, within);
  if (!surface.is_plane && !surface.is_cylinder) return surface;
  const std::vector<double> middle = {0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])};
  gmsh::model::getValue(2, tag, middle, x);
  gmsh::model::getNormal(tag, middle, n);
  surface.at = Vec3(x[0], x[1], x[2]);
  surface.normal = Vec3(n[0], n[1], n[2]);
  if (!surface.is_cylinder) return surface;
  std::vector<double> largest, smallest, along_largest, along_smallest;
  gmsh::model::getPrincipalCurvatures(tag, middle, largest, smallest, along_largest, along_smallest);
  const bool bends_least = std::abs(smallest[0]) > std::abs(largest[0]);
  surface.radius = 1.0 / std::abs(bends_least ? smallest[0] : largest[0]);
  const Vec3 round = bends_least ? Vec3(along_smallest[0], along_smallest[1], along_smallest[2])
                                 : Vec3(along_largest[0], along_largest[1], along_largest[2]);
  surface.axis = round.cross(surface.normal).normalized();
  surface.centres[0] = surface.at + surface.radius * surface.normal;
  surface.centres[1] = surface.at - surface.radius * surface.normal;
  return surface;
}

// Boxes grown by `within`: of faces that lie side by side these have no more than an edge in common.
bool have_area_in_common(const Box& a, const Box& b, double within) {
  return (a.common(b).size().array() > 4.0 * within).count() >= 2;
}

bool touch(const CadSurface& a, const CadSurface& b, double within) {
  if (!a.box.meets(b.box)) return false;
  // Which side of a surface its normal is on is not known: coplanar faces that have an area in common are of solids on
  // either side.
  if (a.is_plane && b.is_plane)
    return std::abs(a.normal.dot(b.normal)) > 0.999 && std::abs(a.normal.dot(b.at - a.at)) <= within &&
           have_area_in_common(a.box, b.box, within);
  if (!a.is_cylinder || !b.is_cylinder || std::abs(a.radius - b.radius) > within) return false;
  if (std::abs(a.axis.dot(b.axis)) < 0.999) return false;
  // The axis is through one of two points.
  for (const Vec3& c : a.centres)
    for (const Vec3& d : b.centres)
      if (a.axis.cross(d - c).norm() <= within) return true;
  return false;
}

}  // namespace

StepContacts step_contacts(const std::map<int, std::vector<int>>& surfaces_of, double within) {
  std::vector<std::pair<int, CadSurface>> all;  // volume, surface
  for (const auto& [volume, tags] : surfaces_of)
    for (const int tag : tags) all.emplace_back(volume, cad_surface(tag, within));
  std::set<int> surfaces, curves;
  for (size_t i = 0; i < all.size(); ++i)
    for (size_t j = 0; j < i; ++j)
      if (all[i].first != all[j].first && touch(all[i].second, all[j].second, within)) {
        surfaces.insert(all[i].second.tag);
        surfaces.insert(all[j].second.tag);
      }
  for (const int tag : surfaces) {
    gmsh::vectorpair boundary;
    gmsh::model::getBoundary({{2, tag}}, boundary, false, false);
    for (const auto& curve : boundary) curves.insert(curve.second);
  }
  return {{surfaces.begin(), surfaces.end()}, {curves.begin(), curves.end()}};
}

}  // namespace dygita
