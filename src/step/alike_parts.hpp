// Substructures that can be explicit together alone.
#pragma once

#include <string>
#include <vector>

#include "interfaces/surfaces.hpp"

namespace dygita {

// A point between meshes that do not match is solved in closed form or not at all for an explicit side: what is linked
// to it through nodes, as all of an interface is, must be explicit too.
struct AlikeParts {
  std::vector<int> group;               // of each substructure
  std::vector<std::string> interfaces;  // of each substructure, one that binds it; empty: none does

  bool are_bound(size_t i, size_t j) const { return i != j && group[i] == group[j]; }
};
AlikeParts find_alike(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces);

}  // namespace dygita
