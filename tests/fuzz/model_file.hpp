// What must hold of a model of another program that has been read.
#pragma once

#include "foreign/foreign_meshes.hpp"
#include "fuzz/target.hpp"

namespace dygita::fuzz {

inline void check_model(const ForeignMeshes& read) {
  for (const StepPart& part : read.parts()) {
    demand(part.mesh->nodes.allFinite() && volume(*part.mesh) > 0.0, "a part has a volume");
    const auto* regions = read.regions(part.mesh);
    demand(regions != nullptr, "a part has its regions");
    for (const auto& [name, nodes] : *regions)
      for (const int node : nodes) demand(node >= 0 && node < part.mesh->n_nodes(), "regions have nodes of the part");
  }
  for (const char* name : {"STEEL", "M", "MAT1 1", "MAT9 2"}) attempt([&] { read.material(name); });
}

}  // namespace dygita::fuzz
