// Of every boundary facet of an assembly: its groups, the interface or the support it is in.
#pragma once

#include <string>
#include <vector>

#include "drawing/turning_mesh.hpp"

namespace dygita {

struct NamedFacets {
  struct Label {
    int part = -1;
    std::string groups;  // "zmax", "head, side"; empty: in none
    int joint = -1;      // index in `joints`
  };
  struct Joint {
    std::string name;  // "interface 'grip'", "support 'base'", "interface 'grip': NOT FOUND"
    bool is_interface = true, is_found = true;
  };
  std::vector<Label> labels;         // the first is of facets that have no name
  std::vector<FacetLabels> of_part;  // facets by their key, index in `labels`
  std::vector<Joint> joints;         // interfaces in the problem's order, then supports
};

// Interfaces are matched as a run would match them; where that fails, their declared faces stand for them.
NamedFacets named_facets(const Problem& problem);

}  // namespace dygita
