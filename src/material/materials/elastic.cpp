// The same in all directions (manual, eq. Y1).
#include "material/material.hpp"

namespace dygita::materials {

MaterialEntry elastic() {
  return {"elastic", {"young", "poisson"}, [](const MaterialNumbers& a) {
            return Elastic("", a.at("young"), a.at("poisson"), a.at("density"));
          }};
}

}  // namespace dygita::materials
