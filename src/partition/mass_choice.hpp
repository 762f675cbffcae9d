// Whether the mass of an explicit substructure is tuned to its waves, where the deck leaves that to the program
// (manual, eq. S15).
#pragma once

#include <string>
#include <vector>

#include "model/model.hpp"

namespace dygita {

// Hz, the highest that the loads of each step bring; 0 in static ones.
std::vector<double> brought_frequencies(const Problem& problem);

// Rad, at the end of the dynamic steps: by how much a lumped mass keeps back shear waves of the highest frequency that
// the loads bring, or that the mesh carries.
double phase_of_lumped_mass(const Problem& problem, const std::vector<double>& brought, const Substructure& part);

// Is that worth a tuned mass? Not where most nodes have laws, whose cells stay lumped, nor in cells that are no bricks.
// interface_share: of its nodes.
bool wants_tuned_mass(const Substructure& part, double phase, double interface_share);
// What keeps it lumped though the phase is large: "half of its nodes have laws"; empty: nothing.
std::string why_lumped(const Substructure& part, double phase, double interface_share);

// May it have a tuned mass in explicit steps, as far as is known before any surface is made?
bool may_be_tuned(const Problem& problem, const std::vector<double>& brought, const Substructure& part);
// Names of those that may, where the deck leaves it to the program; none where it does not.
std::vector<std::string> tuned_by_choice(const Problem& problem);

}  // namespace dygita
