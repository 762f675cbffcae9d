// What the user allows the mesher, and what the machine allows meshes of boxes.
#pragma once

#include <string>
#include <vector>

namespace dygita {

struct MeshLimits {
  double time = 1800.0;              // s, elapsed, for each file
  double box_memory = 0.0;           // bytes, for each box; 0: all that the machine has
  double cache = 0.0;                // bytes that meshes of CAD may take beside a deck; 0: none is kept there
  std::vector<std::string> trusted;  // files that may run programs and write files
};

// For all meshes from now on.
void set_mesh_limits(const MeshLimits& limits);
const MeshLimits& mesh_limits();
bool is_trusted_mesh(const std::string& file);
double box_memory_limit();  // bytes; 0: not known

}  // namespace dygita
