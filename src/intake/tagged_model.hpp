// A mesh as a file has it, its nodes known by tags, and the body of one volume made from it.
#pragma once

#include <unordered_map>

#include "mesh/mesh.hpp"

namespace dygita {

struct TaggedVolume {
  std::string name;
  std::map<CellType, std::vector<size_t>> cells;  // node tags in the order of CellType, cell after cell
};

struct TaggedFacet {
  std::array<size_t, most_facet_corners> corners;
  int n_corners;
};

struct TaggedSurface {
  std::string name;
  std::vector<TaggedFacet> facets;
};

struct TaggedModel {
  std::string file;
  std::unordered_map<size_t, Vec3> nodes;  // metres
  std::vector<TaggedVolume> volumes;
  std::vector<TaggedSurface> surfaces;
};

// The body of one volume: its own nodes, cells turned right side out, faces named as GmshMeshes says, facets outward.
// Throws InputError when a surface named after the volume does not lie on its boundary, and what check_mesh throws.
MeshPtr build_mesh(const TaggedModel& model, const TaggedVolume& volume);

}  // namespace dygita
