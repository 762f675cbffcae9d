#include "model/extent.hpp"

#include <cmath>

namespace dygita {

Box extent_of(const Substructure& part) {
  Box box;
  box.add(part.mesh->nodes.rowwise().minCoeff() + part.place);
  box.add(part.mesh->nodes.rowwise().maxCoeff() + part.place);
  return box;
}

Box extent_of(const std::vector<SubstructurePtr>& parts) {
  Box box;
  for (const SubstructurePtr& part : parts) {
    const Box own = extent_of(*part);
    box.add(own.low);
    box.add(own.high);
  }
  return box;
}

double crossings(const Substructure& part, double dt) {
  return part.material.p_wave_speed() * dt / std::cbrt(extent_of(part).size().prod());
}

}  // namespace dygita
