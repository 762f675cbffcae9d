// The types of elements of an .inp that are cells here: how their nodes and faces are numbered.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "mesh/cell_types.hpp"

namespace dygita {

struct AbaqusCell {
  const char* name;  // "C3D15"; with R, I, H or M behind it, too
  CellType type;
  std::vector<int> order;               // for each node of the type, which of the file's it is
  std::vector<std::vector<int>> faces;  // S1, S2, ...: corners by the nodes of the type
};

// Null where the type, in capitals, is no cell here. `suffix`: the letters behind the name.
const AbaqusCell* abaqus_cell(const std::string& type, std::string& suffix);
// "C3D4, C3D6, ...".
std::string abaqus_cell_names();
const AbaqusCell& abaqus_cell_of(CellType type);

// Is it an element between points, as a spring or a mass, which carries no cell?
bool is_between_points(const std::string& type);

}  // namespace dygita
