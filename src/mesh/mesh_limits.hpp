// What the user allows the mesher.
#pragma once

#include <string>
#include <vector>

namespace dygita {

struct MeshLimits {
  double time = 1800.0;              // s, elapsed, for each file
  std::vector<std::string> trusted;  // files that may run programs and write files
};

// For all meshes from now on.
void set_mesh_limits(const MeshLimits& limits);
bool is_trusted_mesh(const std::string& file);

}  // namespace dygita
