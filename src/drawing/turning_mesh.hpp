// The boundary of an assembly small enough to travel inside a page: nodes merged part by part, corners and edges kept.
#pragma once

#include <array>
#include <unordered_map>
#include <vector>

#include "mesh/mesh.hpp"
#include "model/model.hpp"

namespace dygita {

// What a facet belongs to, by its key; a facet that is not there has label 0.
using FacetLabels = std::unordered_map<FacetKey, int, FacetKeyHash>;

struct TurningMesh {
  struct Part {
    int n_nodes = 0, n_triangles = 0;
    std::vector<int> nodes;   // of the mesh: corners of its boundary facets, increasing
    std::vector<int> to;      // of each of them the node here that stands for it, counted from the assembly's first
    std::vector<char> leads;  // whether it is one of those whose place and motion that node has
  };
  std::vector<Part> parts;
  Points nodes;                               // 3 x n, m, part after part
  std::vector<std::array<int, 3>> triangles;  // part after part, normals outward
  std::vector<int> label;                     // of each triangle
  std::vector<std::array<int, 2>> edges;      // sharp ones and borders between labels
};

// `labels`: one for each part, or none at all. At most about `most_nodes` nodes (InputError beyond 65535, which a page
// cannot number), shared out by the parts' areas.
TurningMesh make_turning_mesh(const std::vector<SubstructurePtr>& parts, const std::vector<FacetLabels>& labels,
                              int most_nodes);

}  // namespace dygita
