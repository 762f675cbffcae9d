// Boundary facets picked by their place and shape, where a mesh has no name for them.
#pragma once

#include <functional>
#include <optional>

#include "mesh/mesh.hpp"

namespace dygita {

// Facets that fit all that is given.
struct FacetPick {
  std::optional<Vec3> normal;                // outward, unit: within two degrees
  std::optional<double> at;                  // m, along the normal
  bool is_cylinder = false;                  // on a cylinder
  std::optional<double> radius;              // m, of it, within two per cent
  std::optional<Vec3> axis;                  // unit, of it, within two degrees
  std::optional<std::pair<Vec3, Vec3>> box;  // m, lowest and highest corner: every node lies in it
  std::function<bool(const Vec3&)> where;    // answers true at every node; empty: anywhere
};

// Those of the mesh at its place. Nodes count as on a plane or in a box within 1e-6 of the mesh's extent.
std::vector<Facet> pick_facets(const Mesh& mesh, const Vec3& place, const FacetPick& pick);

}  // namespace dygita
