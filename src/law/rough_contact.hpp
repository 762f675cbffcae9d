// Contact of rough faces, whose asperities give way (manual, eq. L12-L15).
#pragma once

#include <string>
#include <vector>

#include "law/law_fwd.hpp"

namespace dygita {

// What `interface.contact` takes beside friction and gap where its faces are rough, as an entry of the table of laws
// names it. One of: `normal` (Pa/m); `approach[i]` (m) and `pressure[i]` (Pa) of a curve; `coefficient` (Pa/m^2.5) and
// `height` (m) of asperities. And one of: `tangential` (Pa/m), `ratio` to the slope of the normal.
const std::vector<std::string>& compliance_arguments();

bool is_rough(const LawArguments& arguments);
LawPtr make_rough_contact(const LawArguments& arguments);

// Asperities with tips of this radius (m), so many per area (1/m^2), their heights evenly spread over `height` (m), on
// faces of this E* (Pa): the coefficient.
double coefficient_of_asperities(double radius, double density, double contact_modulus, double height);

}  // namespace dygita
