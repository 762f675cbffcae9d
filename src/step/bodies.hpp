// The matrices of a problem's substructures.
#pragma once

#include "interfaces/surfaces.hpp"
#include "partition/cut.hpp"
#include "pieces/body.hpp"

namespace dygita {

// Matrices of every piece of the cut, with the mass that the problem's solver asks for; equal mesh and material share
// one. Of pieces that another rank has, the mass alone.
std::vector<Body> make_bodies(const Problem& problem, const std::vector<Surface>& surfaces, const Cut& cut);
// Nobody will ask for a matrix that the pieces of a step do not hold: what bodies hold of them goes.
void give_up_matrices(const std::vector<Body>& bodies);
// The same with the matrices of pieces elsewhere as well.
std::vector<Body> with_all_matrices(std::vector<Body> bodies);
// Those of every substructure in one piece.
std::vector<Body> make_bodies(const Problem& problem, const std::vector<Surface>& surfaces);

}  // namespace dygita
