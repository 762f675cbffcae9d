#include "mesh/mesh_limits.hpp"

#include <algorithm>
#include <filesystem>

#include "base/memory.hpp"

namespace dygita {

namespace {

MeshLimits& limits() {
  static MeshLimits limits;
  return limits;
}

}  // namespace

void set_mesh_limits(const MeshLimits& given) { limits() = given; }

const MeshLimits& mesh_limits() { return limits(); }

bool is_trusted_mesh(const std::string& file) {
  std::error_code ignored;
  return std::any_of(limits().trusted.begin(), limits().trusted.end(),
                     [&](const std::string& trusted) { return std::filesystem::equivalent(trusted, file, ignored); });
}

double box_memory_limit() { return limits().box_memory > 0.0 ? limits().box_memory : memory_of_machine(); }

}  // namespace dygita
