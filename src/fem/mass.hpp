// Mass matrices: the consistent one, of cells whose lumped mass would not converge as their stiffness does; and the one
// whose waves keep their speed, between lumped and consistent, chosen so that mesh and time step undo each other's
// error.
#pragma once

#include "fem/assembly.hpp"
#include "fem/wave_tuning.hpp"

namespace dygita {

// n x n, kg, symmetric, the same for the three directions; row sums are the lumped masses. `keeps_lumped` (one entry a
// node, or empty): cells with such a node stay lumped. Manual, eq. S6; the rule is that of B. Yue, M. N.
// Guddati (J. Acoust. Soc. Am. 118, 2005).
SparseMatrix tuned_mass(const Mesh& mesh, const Elastic& material, const WaveTuning& tuning,
                        const std::vector<char>& keeps_lumped);

// n x n, kg: consistent in cells whose row says so, lumped in others.
SparseMatrix consistent_mass(const Mesh& mesh, const Elastic& material);

// J, of the cells of each block: by what the kinetic energy of their lumped masses is above that of the material, whose
// velocity is the interpolated one (3 x n_nodes, m/s); none in cells whose mass is consistent.
std::vector<Vec> lumping_energies(const Mesh& mesh, double density, const Points& velocity);

// Does the mesh have cells of consistent mass, or a mass matrix of its own?
bool has_consistent_mass(const Mesh& mesh);

// Has it cells of order two without nodes in the middle of quadrangles, whose scaled diagonal is three times as far off
// as that of tetrahedra? At equal cost their consistent mass is more accurate in implicit increments (manual, explicit
// substructures).
bool loses_by_diagonal(const Mesh& mesh);

}  // namespace dygita
